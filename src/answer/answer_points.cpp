#include "answer/answer_points.h"

#include <fmt/format.h>

#include <memory>
#include <vector>

#include "answer/header.h"
#include "answer/threads.h"
#include "importance/point_picture.h"

namespace rsphere {
namespace {

// Makes the random numbers of a picture independent of those of the answer.
constexpr uint64_t kPictureSeed = 0x70696374757265;  // "picture"

void writePicture(const std::string& name, const V3d& point, const SphereEstimator& estimator,
                  const Transport& transport, const AnswerOptions& options,
                  SphereEstimator::Workspace& workspace) {
  PictureFile file(name);
  const PixelMap map(file.format() == PictureFormat::radiance ? Projection::angularFisheye
                                                              : Projection::latitudeLongitude);
  const uint64_t seed = seedOf(std::initializer_list<double>{point.x, point.y, point.z},
                               kPictureSeed ^ rotationBits(options.ray));
  Raster raster =
      drawPoint(point, map, transport, estimator.sources(), workspace.tracer, seed, workspace.checkStop);
  if (file.format() == PictureFormat::screen) expose(raster, map);
  file.write(raster, provenance(options, transport.scene().description.header) + viewLine(point));
}

}  // namespace

void Unreached::add(uint64_t record, const PointAnswer& answer) {
  const std::lock_guard lock(mutex_);
  ++points_;
  if (answer.reached) return;
  ++missed_;
  const double mean = brightness(answer.mean), error = mean > 0 ? answer.brightnessError / mean : 1e30;
  // Of equal errors the first in the input is kept, whichever thread answered it.
  if (error < worstError_ || (error == worstError_ && record > worst_)) return;
  worst_ = record;
  worstError_ = error;
}

std::string Unreached::summary(const SphereOptions& options) const {
  const std::lock_guard lock(mutex_);
  if (missed_ == 0) return "";
  return fmt::format(
      "-Sa {:g} was not reached at {} of {} points with at most {} directions; the worst is record {}: "
      "{:.3g}%",
      options.accuracy, missed_, points_, options.mostOfAllSets(), worst_ + 1, 100 * worstError_);
}

AnswerRecord answerPoints(const SphereEstimator& estimator, const Transport& transport,
                          const AnswerOptions& options, const AnswerWriter& writer, const rad::Warn& warn,
                          Unreached& unreached, std::function<void()> checkStop) {
  if (transport.isDark()) warn("no light sources found");
  auto workspaces = std::make_shared<std::vector<SphereEstimator::Workspace>>();
  for (unsigned i = 0; i < threadCount(options.threads); ++i) {
    workspaces->emplace_back(estimator);
    workspaces->back().checkStop = checkStop;
  }
  return [&, workspaces](const Record& record, unsigned worker, std::string& bytes) {
    SphereEstimator::Workspace& workspace = (*workspaces)[worker];
    const V3d point(record.numbers[0], record.numbers[1], record.numbers[2]);
    const PointAnswer answer = estimator.estimate(point, workspace);
    unreached.add(record.index, answer);
    if (!options.sphere.picture.empty())
      writePicture(pictureName(options.sphere.picture, record.index), point, estimator, transport, options,
                   workspace);
    if (!options.sphere.everyDirection) return writer.write(bytes, answer);
    for (size_t i = 0; i < workspace.samples.size(); ++i)
      writer.write(bytes, directionAnswer(transport.scene(), workspace.samples[i], workspace.rays[i]),
                   record.index);
  };
}

}  // namespace rsphere
