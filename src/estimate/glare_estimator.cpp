#include "estimate/glare_estimator.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/colorimetry.h"
#include "base/constants.h"
#include "base/even_sequence.h"
#include "estimate/tuning.h"
#include "glare/local_fits.h"
#include "glare/nearby_directions.h"

namespace rsphere {
namespace {

// The defaults of evalglare. Bright pixels within kSameSource of each other become one source; .1 rad is half
// of the opening angle of its option -r. Peaks above kPeak become separate sources (option -Y).
constexpr double kSameSource = .1;  // rad
constexpr double kPeak = 50000;     // cd/m2

// With a fixed threshold from here on, only light sources can be glare sources (the sun has 1.6e9 cd/m2). The
// indirect light of other directions then need not be separated, which takes most of the time.
constexpr double kAboveAll = 1e10;  // cd/m2

// Offsets of seeds: rays that are traced again, and rays to the task, are independent of rays that are traced
// first.
constexpr uint64_t kAgain = 0x676c617265, kTask = 0x7461736b;  // "glare", "task"

SphereOptions withDirections(SphereOptions options) {
  options.everyDirection = true;
  options.glare.wanted = true;  // a separate pool of light vertices for each set
  options.accuracy = 0;
  return options;
}

// Cap on the directions in one fit. It grows more slowly than the number of directions, so that both the
// noise and the bias of fits tend to 0.
size_t directionsOfFit(size_t directions) {
  return std::max<size_t>(16, static_cast<size_t>(std::sqrt(static_cast<double>(directions))));
}

// Standard error by the jackknife: from n estimates, each of which leaves out one set.
template <class Value>
double jackknifeError(size_t n, const Value& without) {
  double mean = 0, squares = 0;
  for (size_t k = 0; k < n; ++k) mean += without(k) / static_cast<double>(n);
  for (size_t k = 0; k < n; ++k) squares += (without(k) - mean) * (without(k) - mean);
  return std::sqrt(squares * static_cast<double>(n - 1) / static_cast<double>(n));
}

}  // namespace

// One direction in front of the eye.
struct GlareEstimator::Look {
  V3d direction{0, 0, 1};
  double solidAngle = 0;            // sr
  double direct = 0, indirect = 0;  // luminance, cd/m2: without indirect light; of indirect light
  double smooth = 0;                // luminance without the noise of indirect light
  SurfaceId surface = kNone;        // the surface seen, perhaps through panes
  bool toLamp = false;              // whether it is a directly visible light source with separate samples
  size_t set = 0;

  double luminance() const { return direct + indirect; }
  SeenGlare seen(const Gaze& gaze) const {
    const double light = luminance() * solidAngle;
    return {solidAngle, light, light * std::max(0., gaze.direction.dot(direction)), light * direction};
  }
};

// The sets of directions of an eye.
struct GlareEstimator::View {
  Gaze gaze;
  std::vector<Look> looks;
  struct Set {
    double illuminance = 0;    // at the eye, lx
    double taskLuminance = 0;  // 0 if it is not needed
  };
  std::array<Set, kSets> sets{};
  size_t leftOut = kSets;  // the set that the jackknife leaves out; kSets: none

  size_t count() const { return leftOut < kSets ? kSets - 1 : kSets; }
  double mean(double Set::*quantity) const {
    double sum = 0;
    for (size_t k = 0; k < kSets; ++k)
      if (k != leftOut) sum += sets[k].*quantity;
    return sum / static_cast<double>(count());
  }
  View without(size_t set) const {
    View view{gaze, {}, sets, set};
    std::ranges::copy_if(looks, std::back_inserter(view.looks),
                         [&](const Look& look) { return look.set != set; });
    return view;
  }
  // The mean luminance in the hemisphere in front of the eye.
  double luminance() const {
    double light = 0;
    for (const Look& look : looks) light += look.luminance() * look.solidAngle;
    return light / (2 * kPi * static_cast<double>(count()));
  }
  void smoothIndirect();
};

// A glare source, with its contribution in each set.
struct GlareEstimator::Source {
  SurfaceId surface;
  std::array<SeenGlare, kSets> seen{};
  size_t looks = 0;                      // in all sets
  double squares = 0, angleSquares = 0;  // sums over looks: of their light, cd2/m4 sr2; of their solid angles
  double lightAngles = 0;                // sum of light x solid angle
  double indirect = 0;                   // sum of indirect light, cd/m2 sr

  void add(const Look& look, const Gaze& gaze);

  // The mean over all sets except `leftOut`; kSets: over all sets.
  SeenGlare mean(size_t leftOut = kSets) const {
    SeenGlare sum;
    for (size_t k = 0; k < kSets; ++k)
      if (k != leftOut) sum += seen[k];
    return sum * (1. / static_cast<double>(leftOut < kSets ? kSets - 1 : kSets));
  }
  double luminanceError() const;
  GlareSource answer(const Gaze& gaze) const;
};

void GlareEstimator::Source::add(const Look& look, const Gaze& gaze) {
  const SeenGlare one = look.seen(gaze);
  seen[look.set] += one;
  ++looks;
  squares += one.light * one.light;
  angleSquares += one.solidAngle * one.solidAngle;
  lightAngles += one.light * one.solidAngle;
  indirect += look.indirect * one.solidAngle;
}

// Standard error of the luminance. If only one set sees the source, leaving out that set leaves no luminance,
// so that the error follows from the spread of the directions of that set. The light of a single direction is
// exact except for the indirect light of one path, whose error is about as large as this indirect light.
double GlareEstimator::Source::luminanceError() const {
  const auto sees = [](const SeenGlare& one) { return one.solidAngle > 0; };
  if (std::ranges::count_if(seen, sees) != 1)
    return jackknifeError(kSets, [&](size_t k) { return mean(k).luminance(); });
  const double solidAngle = std::ranges::find_if(seen, sees)->solidAngle;
  if (looks == 1) return indirect / solidAngle;
  const double luminance = mean().luminance(), n = static_cast<double>(looks);
  const double spread = squares - 2 * luminance * lightAngles + luminance * luminance * angleSquares;
  return std::sqrt(std::max(0., spread) * n / (n - 1)) / solidAngle;
}

GlareSource GlareEstimator::Source::answer(const Gaze& gaze) const {
  const SeenGlare all = mean();
  GlareSource source;
  source.surface = surface;
  source.direction = all.direction();
  source.luminance = all.luminance();
  source.luminanceError = luminanceError();
  source.solidAngle = all.solidAngle;
  source.solidAngleError = jackknifeError(kSets, [&](size_t k) { return mean(k).solidAngle; });
  source.positionIndex = all.positionIndex(gaze);
  source.weight = all.weight(gaze);
  return source;
}

// Sets `smooth` of each look, replacing its indirect light by a fit to the surrounding looks that see the
// same surface.
void GlareEstimator::View::smoothIndirect() {
  std::map<SurfaceId, std::vector<Look*>> bySurface;
  for (Look& look : looks) {
    look.smooth = look.luminance();
    if (!look.toLamp && look.surface != kNone) bySurface[look.surface].push_back(&look);
  }
  std::vector<V3d> directions;
  std::vector<double> own;
  for (const auto& [surface, members] : bySurface) {
    directions.clear();
    own.clear();
    for (const Look* look : members) {
      directions.push_back(look->direction);
      own.push_back(look->indirect);
    }
    const std::vector<double> fits = fitsOfOthers(directions, own, directionsOfFit(looks.size()));
    for (size_t i = 0; i < members.size(); ++i) members[i]->smooth = members[i]->direct + fits[i];
  }
}

GlareEstimator::GlareEstimator(const Transport& transport, const SphereOptions& options)
    : prepared_(transport.prepared()),
      options_(withDirections(options)),
      means_(transport, options_),
      separates_(!hasMedia(prepared_)) {}

double GlareEstimator::luminance(const Radiance& radiance) const {
  return kPhotopicEfficacy * photopicOf(radiance.color, prepared_.options().sampling);
}

bool GlareEstimator::isLamp(SurfaceId surface) const {
  return surface != kNone && !prepared_.scene().surfaces[surface].shape.as<Distant>();
}

void GlareEstimator::addSet(const SetAtPoint& set, SphereEstimator::Workspace& workspace, View& view) const {
  const SampledSet sampled = means_.sampleSet(set, workspace);
  View::Set& kept = view.sets[set.number()];
  kept.illuminance = luminance(Radiance(means_.momentsOf(sampled, set).atEye.color));
  if (options_.glare.taskOpening > 0 && !options_.glare.isFixed())
    kept.taskLuminance = taskLuminance(set, view.gaze, workspace.tracer);
  for (size_t i = 0; i < sampled.samples.size(); ++i) {
    const DirectionSample& sample = sampled.samples[i];
    if (sample.solidAngle > 0 && sample.direction.dot(view.gaze.direction) > 0)
      view.looks.push_back(lookAlong(set, i, sample, sampled.rays[i], workspace.tracer));
  }
}

GlareEstimator::Look GlareEstimator::lookAlong(const SetAtPoint& set, size_t number,
                                               const DirectionSample& sample, const TracedRay& ray,
                                               PathTracer& tracer) const {
  Look look{sample.direction, sample.solidAngle};
  look.set = set.number();
  if (sample.toSource || ray.firstHit.surface == kNone || options_.glare.threshold >= kAboveAll) {
    look.direct = luminance(sample.value);
    look.surface = ray.shown.source;
    look.toLamp = sample.toSource && ray.shown.mirror == kNone;
    return look;
  }
  retrace(set.point(), mixBits(set.seed() + kAgain + number), tracer, look);
  return look;
}

// Traces the direction again, to separate indirect light from all other light.
void GlareEstimator::retrace(const V3d& eye, uint64_t seed, PathTracer& tracer, Look& look) const {
  Radiance indirect;
  int depth = -1;
  const RayObserver observer = [&](const RayEnd& end, const RayResult& result) {
    const PathContext& ray = end.context;
    if ((ray.kind & kAmbient) && ray.ambientLevel == 1) indirect += result.value * ray.contribution;
    if ((ray.kinds & ~(kPrimary | kTransmitted)) != 0 || ray.depth <= depth) return;
    depth = ray.depth;
    look.surface = end.hit.surface;
  };
  const TracedRay ray = tracer.trace(eye, look.direction, 0, seed, {.observer = &observer});
  if (!separates_) indirect = {};
  look.indirect = luminance(indirect);
  look.direct = luminance(ray.value - indirect);
}

// The mean luminance of the task, from rays that are spread evenly over it.
double GlareEstimator::taskLuminance(const SetAtPoint& set, const Gaze& gaze, PathTracer& tracer) const {
  const double below = options_.glare.taskBelow * kPi / 180, half = options_.glare.taskOpening * kPi / 360;
  const V3d axis = std::cos(below) * gaze.direction - std::sin(below) * gaze.up;
  const V3d aside = gaze.direction.cross(gaze.up), above = aside.cross(axis);
  Random random(mixBits(set.seed() + kTask));
  const double shift1 = random.uniform(), shift2 = random.uniform();
  double sum = 0;
  for (size_t i = 0; i < tuning::Glare::kTaskRays; ++i) {
    const Imath::V2d u = evenly(i, shift1, shift2);
    const double ahead = 1 - u.x * (1 - std::cos(half)), off = std::sqrt(std::max(0., 1 - ahead * ahead));
    const V3d direction =
        ahead * axis + off * (std::cos(2 * kPi * u.y) * aside + std::sin(2 * kPi * u.y) * above);
    sum += luminance(tracer.trace(set.point(), direction.normalized(), 0, random.bits()).value);
  }
  return sum / tuning::Glare::kTaskRays;
}

double GlareEstimator::threshold(const View& view) const {
  const GlareOptions& glare = options_.glare;
  if (glare.isFixed()) return glare.threshold;
  return glare.threshold * (glare.taskOpening > 0 ? view.mean(&View::Set::taskLuminance) : view.luminance());
}

void GlareEstimator::addLamps(const View& view, Sources& sources) const {
  std::map<SurfaceId, Source> lamps;
  for (const Look& look : view.looks) {
    if (!look.toLamp || !isLamp(look.surface)) continue;
    Source& lamp = lamps.try_emplace(look.surface, Source{look.surface}).first->second;
    lamp.add(look, view.gaze);
  }
  for (const auto& [surface, lamp] : lamps) sources.push_back(lamp);
}

// Adds the sources formed by directions above the threshold. Peaks become sources separate from their
// surroundings.
void GlareEstimator::addBright(const View& view, double threshold, Sources& sources) const {
  std::array<std::vector<const Look*>, 2> bright;
  for (const Look& look : view.looks)
    if (!(look.toLamp && isLamp(look.surface)) && look.smooth > threshold)
      bright[look.smooth > kPeak].push_back(&look);
  for (const std::vector<const Look*>& looks : bright) {
    std::vector<V3d> directions;
    for (const Look* look : looks) directions.push_back(look->direction);
    const std::vector<size_t> groups = connectedGroups(directions, kSameSource);
    std::vector<Source> found;
    std::vector<std::map<SurfaceId, double>> shares;
    for (size_t i = 0; i < looks.size(); ++i) {
      if (groups[i] >= found.size()) {
        found.push_back({kNone});
        shares.emplace_back();
      }
      found[groups[i]].add(*looks[i], view.gaze);
      shares[groups[i]][looks[i]->surface] += looks[i]->luminance() * looks[i]->solidAngle;
    }
    for (size_t g = 0; g < found.size(); ++g) {
      found[g].surface =
          std::ranges::max_element(shares[g], {}, [](const auto& share) { return share.second; })->first;
      sources.push_back(found[g]);
    }
  }
}

GlareEstimator::Found GlareEstimator::find(View view) const {
  view.smoothIndirect();
  Found found;
  found.threshold = threshold(view);
  addLamps(view, found.sources);
  addBright(view, found.threshold, found.sources);
  std::vector<SeenGlare> seen;
  for (const Source& source : found.sources) seen.push_back(source.mean(view.leftOut));
  const double illuminance = view.mean(&View::Set::illuminance);
  found.indices = glareIndices(illuminance, seen, view.gaze);
  found.shifted = glareIndices(illuminance * (1 + means_.sharedError()), seen, view.gaze);
  return found;
}

GlareAnswer GlareEstimator::estimate(const V3d& eye, const Gaze& gaze,
                                     SphereEstimator::Workspace& workspace) const {
  View view;
  view.gaze = gaze;
  for (size_t k = 0; k < kSets; ++k)
    addSet(SetAtPoint(eye, k, options_.rotation, gaze.direction), workspace, view);
  const Found found = find(view);
  std::vector<GlareIndices> without;
  for (size_t k = 0; k < kSets; ++k) without.push_back(find(view.without(k)).indices);

  GlareAnswer answer{eye, gaze.direction, found.indices, {}, found.threshold, {}};
  for (double GlareIndices::*const index :
       {&GlareIndices::ugr, &GlareIndices::illuminance, &GlareIndices::background, &GlareIndices::dgp}) {
    const double own = jackknifeError(kSets, [&](size_t k) { return without[k].*index; });
    answer.errors.*index = std::hypot(own, found.shifted.*index - found.indices.*index);
  }
  for (const Source& source : found.sources) answer.sources.push_back(source.answer(gaze));
  std::ranges::stable_sort(answer.sources, std::greater(), &GlareSource::weight);
  return answer;
}

}  // namespace rsphere
