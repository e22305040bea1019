#include "answer/answer_glare.h"

#include <fmt/format.h>

#include <memory>

#include "process/threads.h"

namespace rsphere {

GlareWorkers::GlareWorkers(const Transport& transport, const AnswerOptions& options)
    : estimator_(transport, options.sphere) {
  for (unsigned i = 0; i < threadCount(options.threads); ++i) workspaces_.emplace_back(estimator_.means());
}

GlareAnswer GlareWorkers::answer(const Record& record, unsigned worker) {
  const V3d eye(record.numbers[0], record.numbers[1], record.numbers[2]);
  const V3d along(record.numbers[3], record.numbers[4], record.numbers[5]);
  const std::optional<Gaze> gaze = Gaze::upright(along);
  if (!gaze)
    throw rad::Error(fmt::format(
        "record {}: the gaze {:g} {:g} {:g} {}", record.index + 1, along.x, along.y, along.z,
        along == V3d(0, 0, 0) ? "has no length: it is a direction, not a point"
                              : "is vertical, so that the view has no upward direction: tilt it"));
  return estimator_.estimate(eye, *gaze, workspaces_[worker]);
}

AnswerRecord answerGlare(const Transport& transport, const AnswerOptions& options, const AnswerWriter& writer,
                         const rad::Warn& warn, RunSummary& summary) {
  const auto workers = std::make_shared<GlareWorkers>(transport, options);
  if (isDark(transport.prepared())) warn("no light sources found");
  return [&, workers](const Record& record, unsigned worker, std::string& bytes) {
    const GlareAnswer answer = workers->answer(record, worker);
    summary.add(record.index, answer, transport.prepared());
    if (!options.sphere.everyDirection) return writer.write(bytes, answer);
    for (const GlareSource& source : answer.sources)
      writer.write(bytes, source, answer, transport.prepared().scene(), record.index);
  };
}

}  // namespace rsphere
