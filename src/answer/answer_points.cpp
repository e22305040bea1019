#include "answer/answer_points.h"

#include <fmt/format.h>

#include <memory>

#include "answer/header.h"
#include "answer/threads.h"
#include "base/spectral_sampling.h"
#include "importance/point_picture.h"

namespace rsphere {
namespace {

// Makes the random numbers of a picture differ from those of the answer to the same point.
constexpr uint64_t kPictureSeed = 0x70696374757265;  // "picture"

void writePicture(const std::string& name, const V3d& point, const Transport& transport,
                  const AnswerOptions& options, const SphereEstimator& estimator,
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

PointWorkers::PointWorkers(const Transport& transport, const AnswerOptions& options, bool standardError,
                           const std::function<void()>& checkStop)
    : estimator_(transport, options.sphere, standardError) {
  for (unsigned i = 0; i < threadCount(options.threads); ++i) {
    workspaces_.emplace_back(estimator_);
    workspaces_.back().checkStop = checkStop;
  }
}

void Unreached::add(uint64_t record, const PointAnswer& answer, const SpectralSampling* sampling) {
  const std::lock_guard lock(mutex_);
  ++points_;
  if (answer.reached) return;
  ++missed_;
  const double mean = photopicOf(answer.mean.color, sampling),
               error = mean > 0 ? answer.brightnessError / mean : 1e30;
  // Of equal errors the first record in the input is kept, whichever thread computed it.
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

AnswerRecord answerPoints(const Transport& transport, const AnswerOptions& options,
                          const AnswerWriter& writer, const rad::Warn& warn, Unreached& unreached,
                          const std::function<void()>& checkStop) {
  const bool standardError = options.outputs.find('e') != std::string::npos;
  const auto workers = std::make_shared<PointWorkers>(transport, options, standardError, checkStop);
  if (transport.isDark()) warn("no light sources found");
  return [&, workers](const Record& record, unsigned worker, std::string& bytes) {
    const V3d point(record.numbers[0], record.numbers[1], record.numbers[2]);
    const PointAnswer answer = workers->answer(point, worker);
    unreached.add(record.index, answer, options.ray.sampling);
    SphereEstimator::Workspace& workspace = workers->workspace(worker);
    if (!options.picture.empty())
      writePicture(pictureName(options.picture, record.index), point, transport, options,
                   workers->estimator(), workspace);
    if (!options.sphere.everyDirection) return writer.write(bytes, answer);
    for (size_t i = 0; i < workspace.samples.size(); ++i)
      writer.write(bytes, directionAnswer(transport.scene(), workspace.samples[i], workspace.rays[i]),
                   record.index);
  };
}

}  // namespace rsphere
