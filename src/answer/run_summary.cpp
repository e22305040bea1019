#include "answer/run_summary.h"

#include <Imath/ImathBoxAlgo.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rsphere {
namespace {

// A point is far away from the scene at more than this many diagonals of the box around its surfaces. Points
// in millimetres are some 500 diagonals away from a room in metres, points in centimetres 50. Photometry of a
// luminaire needs 5 to 10.
constexpr double kFar = 30;

bool isFarAway(const V3d& point, const Box3d& scene) {
  if (scene.isEmpty()) return false;
  const V3d size = scene.max - scene.min;
  const double distance2 = (point - Imath::clip(point, scene)).length2();
  return size.length2() > 0 && distance2 > kFar * kFar * size.length2();
}

// The word for the records of a run, for messages.
std::string_view placesOf(const AnswerOptions& options) {
  if (options.sphereMode) return options.sphere.glare.wanted ? "eyes" : "points";
  return options.irradiance == IrradianceAt::point ? "sensors" : "rays";
}

// Whether all surfaces are light sources or goals. Photometry of a bare lamp has points far away from it.
bool hasSourcesAlone(const Scene& scene) {
  const SurfaceList::Beginning surfaces = scene.outermost();
  return std::none_of(surfaces.begin(), surfaces.end(),
                      [&](const Surface& surface) { return isBlack(sourceRadiance(scene, surface)); });
}

}  // namespace

void RunSummary::Some::add(uint64_t record, double value) {
  ++records;
  if (value < most || (value == most && record > worst)) return;
  worst = record;
  most = value;
}

void RunSummary::addPlace(uint64_t record, const V3d& point, bool unlit, const PreparedScene& prepared) {
  ++records_;
  if (unlit)
    unlit_.add(record);
  else if (isFarAway(point, prepared.tracer().bounds()))
    far_.add(record);
}

void RunSummary::add(uint64_t record, const PointAnswer& answer, const PreparedScene& prepared) {
  const std::lock_guard lock(mutex_);
  addPlace(record, answer.point, answer.isDark, prepared);
  if (!answer.isDark) addError(record, answer.relativeError, answer.reached);
}

void RunSummary::add(uint64_t record, const GlareAnswer& answer, const PreparedScene& prepared) {
  const std::lock_guard lock(mutex_);
  addPlace(record, answer.eye, !(answer.indices.illuminance > 0), prepared);
  if (std::isinf(answer.indices.ugr)) infinite_.add(record);
}

void RunSummary::add(uint64_t record, const RayEstimator::Estimate& estimate) {
  const std::lock_guard lock(mutex_);
  addError(record, estimate.relativeError, estimate.reached);
}

void RunSummary::addError(uint64_t record, double relativeError, bool reached) {
  estimated_.add(record, relativeError);
  if (!reached) missed_.add(record, relativeError);
}

void RunSummary::addSensor(uint64_t record, const V3d& point, const PreparedScene& prepared) {
  const std::lock_guard lock(mutex_);
  addPlace(record, point, false, prepared);
}

std::string RunSummary::accuracyText(const AnswerOptions& options) const {
  const double accuracy = options.sphere.accuracy, largest = estimated_.most;
  std::string text = fmt::format("-Sa: {} of {} {} are within {:.3g}%", estimated_.records - missed_.records,
                                 estimated_.records, placesOf(options), 100 * accuracy);
  if (estimated_.records == 0) return text;
  text += fmt::format("; the largest error is {:.3g}% (record {})", 100 * largest, estimated_.worst + 1);
  if (missed_.records == 0) return text;
  const double times = std::pow(largest / accuracy, 2);
  return text + fmt::format(": {:.{}f} times the {} would do", std::max(times, 1.1), times < 10 ? 1 : 0,
                            options.sphereMode ? "directions (-Sx)" : "rays (mean of runs with other -Sr)");
}

void RunSummary::tell(const Messages& messages, const AnswerOptions& options,
                      const PreparedScene& prepared) const {
  for (const std::string& text : warnings(options, prepared)) messages.warning(text);
  const std::lock_guard lock(mutex_);
  if (options.sphere.accuracy > 0 && missed_.records == 0 && isatty(messages.descriptor()) != 0)
    messages.report(accuracyText(options));
}

std::vector<std::string> RunSummary::warnings(const AnswerOptions& options,
                                              const PreparedScene& prepared) const {
  const std::lock_guard lock(mutex_);
  const bool importance = prepared.scene().importance;
  const std::string_view places = placesOf(options);
  std::vector<std::string> texts;
  if (unlit_.records > 0 && !isDark(prepared))
    texts.push_back(fmt::format(
        "no {} reaches {} of {} {}, or almost none; the first is record {}: check the units of the "
        "{}, and whether they lie inside of something{}",
        importance ? "importance" : "light", unlit_.records, records_, places, unlit_.worst + 1, places,
        importance ? ", or behind the goals, which emit from their front" : ""));
  if (far_.records > 0 && !hasSourcesAlone(prepared.scene())) {
    const Box3d& box = prepared.tracer().bounds();
    texts.push_back(fmt::format(
        "{} of {} {} {} far away from the scene, which reaches from {:.4g} {:.4g} {:.4g} to {:.4g} {:.4g} "
        "{:.4g}; the first is record {}: check the units of the {}",
        far_.records, records_, places, far_.records == 1 ? "is" : "are", box.min.x, box.min.y, box.min.z,
        box.max.x, box.max.y, box.max.z, far_.worst + 1, places));
  }
  if (infinite_.records > 0)
    texts.push_back(fmt::format(
        "UGR is infinite at {} of {} eyes; the first is record {}: all light there comes from glare sources, "
        "so that the background is black",
        infinite_.records, records_, infinite_.worst + 1));
  if (missed_.records > 0) texts.push_back(accuracyText(options));
  return texts;
}

AnswerRecord withSensors(AnswerRecord answer, const AnswerOptions& options, const PreparedScene& prepared,
                         RunSummary& summary) {
  if (options.irradiance != IrradianceAt::point) return answer;
  return [answer = std::move(answer), &prepared, &summary](const Record& record, unsigned worker,
                                                           std::string& bytes) {
    answer(record, worker, bytes);
    if (!record.bogus)
      summary.addSensor(record.index, {record.numbers[0], record.numbers[1], record.numbers[2]}, prepared);
  };
}

}  // namespace rsphere
