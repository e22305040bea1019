#include "answer/answer_glare.h"

#include <fmt/format.h>

#include <memory>
#include <optional>

#include "estimate/glare_estimator.h"
#include "process/threads.h"

namespace rsphere {
namespace {

Gaze gazeOf(const Record& record) {
  const V3d along(record.numbers[3], record.numbers[4], record.numbers[5]);
  if (const std::optional<Gaze> gaze = Gaze::upright(along)) return *gaze;
  throw rad::Error(
      fmt::format("record {}: the gaze {:g} {:g} {:g} {}", record.index + 1, along.x, along.y, along.z,
                  along == V3d(0, 0, 0) ? "has no length: it is a direction, not a point"
                                        : "is vertical, so that the view has no upward direction: tilt it"));
}

}  // namespace

AnswerRecord answerGlare(const Transport& transport, const AnswerOptions& options, const AnswerWriter& writer,
                         const rad::Warn& warn, RunSummary& summary, const AnswerWriter* sources) {
  const auto estimator = std::make_shared<const GlareEstimator>(transport, options.sphere);
  const auto workspaces =
      forThreads(options.threads, [&] { return SphereEstimator::Workspace(estimator->means()); });
  if (isDark(transport.prepared())) warn("no light sources found");
  const bool indices = !options.sphere.everyDirection;
  const AnswerWriter* const list = indices ? sources : &writer;
  return
      [&, estimator, workspaces, indices, list](const Record& record, unsigned worker, std::string& bytes) {
        const V3d eye(record.numbers[0], record.numbers[1], record.numbers[2]);
        const GlareAnswer answer = estimator->estimate(eye, gazeOf(record), (*workspaces)[worker]);
        summary.add(record.index, answer, transport.prepared());
        if (indices) writer.write(bytes, answer);
        if (list == nullptr) return;
        for (const GlareSource& source : answer.sources)
          list->write(bytes, source, answer, transport.prepared().scene(), record.index);
      };
}

}  // namespace rsphere
