#include "answer/answer_points.h"

#include <memory>
#include <optional>

#include "answer/header.h"
#include "base/constants.h"
#include "base/spectral_sampling.h"
#include "base/stop_check.h"
#include "estimate/estimator.h"
#include "pictures/draw_point.h"
#include "process/threads.h"

namespace rsphere {
namespace {

// Makes the random numbers of a picture independent of those of the answer at the same point.
constexpr uint64_t kPictureSeed = 0x70696374757265;  // "picture"

// Draws the pictures of points, with separate options.
class PictureMaker {
 public:
  PictureMaker(const Transport& answers, const AnswerOptions& options, const PictureProgress::Report& report)
      : options_(options),
        transport_(answers, options.pictureRay),
        sources_(transport_.prepared()),
        report_(report) {}

  void write(PictureFile& file, const V3d& point) const;

 private:
  const AnswerOptions& options_;
  const Transport transport_;
  const SeenSources sources_;
  const PictureProgress::Report report_;
};

void PictureMaker::write(PictureFile& file, const V3d& point) const {
  const bool isRadiance = file.format() == PictureFormat::radiance;
  const Projection whole = isRadiance ? Projection::angularFisheye : Projection::latitudeLongitude;
  const PixelMap map(options_.pictureForm.viewAngle > 0 ? Projection::perspective : whole,
                     options_.pictureForm);
  const uint64_t seed = seedOf(std::initializer_list<double>{point.x, point.y, point.z},
                               kPictureSeed ^ rotationBits(options_.ray));
  PictureProgress progress(file.name(), report_,
                           options_.progressSeconds > 0 ? options_.progressSeconds : kReportSeconds);
  const auto onward = [&](double done) {
    StopCheck::here();
    progress.at(done);
  };
  const bool forScreen = file.format() == PictureFormat::screen;
  const double white = options_.pictureForm.white / kPhotopicEfficacy;
  file.write(drawPoint(point, map, transport_, sources_, seed, forScreen, white, onward),
             provenance(options_, transport_.prepared().scene().description.header) +
                 (isRadiance ? map.viewLine(point) : std::string()));
}

}  // namespace

void requirePictureNames(const AnswerOptions& options, RecordReader& reader) {
  const bool one = options.height == 1 && options.width <= 1;
  if (!options.picture.empty() && !one && reader.arrived(2) > 1) pictureName(options.picture, 1);
}

AnswerRecord answerPoints(const Transport& transport, const AnswerOptions& options,
                          const AnswerWriter& writer, const rad::Warn& warn, RunSummary& summary,
                          const PictureProgress::Report& pictureReport) {
  const auto estimator =
      std::make_shared<const SphereEstimator>(transport, options.sphere, haveErrors(options.outputs));
  const auto workspaces = forThreads(options.threads, [&] { return SphereEstimator::Workspace(*estimator); });
  if (isDark(transport.prepared())) warn("no light sources found");
  const auto pictures = options.picture.empty()
                            ? nullptr
                            : std::make_shared<const PictureMaker>(transport, options, pictureReport);
  return [&, estimator, workspaces, pictures](const Record& record, unsigned worker, std::string& bytes) {
    const V3d point(record.numbers[0], record.numbers[1], record.numbers[2]);
    // Opened before the answer is computed: a file that cannot be written ends the run at once, not after a
    // minute.
    std::optional<PictureFile> picture;
    if (pictures) picture.emplace(pictureName(options.picture, record.index));
    SphereEstimator::Workspace& workspace = (*workspaces)[worker];
    const PointAnswer answer = estimator->estimate(point, workspace);
    summary.add(record.index, answer, transport.prepared());
    if (pictures) pictures->write(*picture, point);
    if (!options.sphere.everyDirection) return writer.write(bytes, answer);
    for (size_t i = 0; i < workspace.samples.size(); ++i)
      writer.write(bytes,
                   directionAnswer(transport.prepared().scene(), workspace.samples[i], workspace.rays[i]),
                   record.index);
  };
}

}  // namespace rsphere
