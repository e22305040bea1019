#include "importance/answer_points.h"

#include <fmt/format.h>

#include <memory>
#include <vector>

#include "importance/distribution.h"

namespace rsphere {

AnswerRecord answerPoints(const SphereEstimator& estimator, const Transport& transport,
                          const Options& options, const AnswerWriter& writer, const rad::Warn& warn) {
  if (transport.isDark()) warn("no light sources found");
  auto workspaces = std::make_shared<std::vector<SphereEstimator::Workspace>>();
  for (unsigned i = 0; i < threadCount(options); ++i) workspaces->emplace_back(estimator);
  return [&, workspaces](const Record& record, unsigned worker, std::string& bytes) {
    SphereEstimator::Workspace& workspace = (*workspaces)[worker];
    const V3d point(record.numbers[0], record.numbers[1], record.numbers[2]);
    const PointAnswer answer = estimator.estimate(point, workspace);
    if (!answer.reached) warn(fmt::format("record {}: -Sa not reached within -Sx", record.index + 1));
    writeDistribution(options.sphere.picture, record.index, workspace.samples);
    if (!options.sphere.everyDirection) return writer.write(bytes, answer);
    for (size_t i = 0; i < workspace.samples.size(); ++i)
      writer.write(bytes, directionAnswer(transport.scene(), workspace.samples[i], workspace.rays[i]),
                   record.index);
  };
}

}  // namespace rsphere
