#include "transport/indirect_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/function_ref.h"
#include "light_paths/vertex_light.h"
#include "rays/ray_functions.h"
#include "transport/final_gather.h"
#include "transport/gather_directions.h"
#include "transport/ray_limits.h"
#include "transport/tuning.h"

namespace rsphere {
namespace {

// Whether interpolated light is valid at a side. Interpolated light was gathered in the complete scene,
// without antimatter, and in the global medium. For very tilted normals, its moments are less accurate.
bool isOrdinary(const RayEnd& end, const DiffuseSide& side, const Medium& medium) {
  const RaySpace& space = end.space();
  return !space.mist && !end.context.clips && !end.clipsBeyond && !space.scatterers.count &&
         space.medium.extinction == medium.extinction &&
         !(side.normal.dot(side.trueNormal) < tuning::Interpolation::kLeastUpright);
}

SurfacePlace placeOf(const RayEnd& end, const DiffuseSide& side) {
  return {side.point, side.trueNormal, end.hit.surface, &end.hit.path, end.hit.length};
}

// The result refers to `coefficient`.
DiffuseSide withCoefficient(const DiffuseSide& side, const Coefficient& coefficient) {
  return {side.point, side.normal, side.trueNormal, side.kind, coefficient};
}

// The number of diffuse bounces that the limits allow after the end of a ray.
int bouncesLeft(const RayOptions& o, const PathContext& ray) {
  int left = o.ambientBounces - ray.ambientLevel;
  if (o.reflectionLimit != 0) left = std::min(left, std::abs(o.reflectionLimit) - ray.level);
  if (o.reflectionLimit <= 0) return std::max(left, 0);
  int allowed = 0;
  for (double weight = ray.weight / 2; allowed < left && weight >= o.weightLimit; weight /= 2) ++allowed;
  return allowed;
}

// The noise of a gather, estimated from half of its rays, which are assigned to bins in turn.
class GatherNoise {
 public:
  static constexpr int kBins = 12;

  // The number of a ray, and the brightness of its part of the result.
  void add(int ray, double part) { bins_[ray % kBins] += part; }

  // The standard error of the whole gather relative to its result. An overestimate where light is smooth,
  // because the rays of a bin are less evenly distributed than the rays of the half.
  double ofWhole() const {
    double sum = 0, squares = 0;
    for (const double bin : bins_) {
      sum += bin;
      squares += bin * bin;
    }
    const double variance = std::max(0., squares - sum * sum / kBins) * kBins / (kBins - 1);
    return sum > 0 ? std::sqrt(variance / 2) / sum : 0;
  }

 private:
  std::array<double, kBins> bins_{};
};

// The aims of a gather. If paths from both ends estimate daylight, no rays are aimed at openings or spots,
// and at images of openings only where light that comes by mirrors is left to gathers.
Aims aimsAt(const RayEnd& end, const PathSettings& settings, const PathState& state) {
  Aims aims = settings.aims;
  if (end.known != Known::no && !state.request.vertexLight->surfaces().portals().empty()) {
    aims.leaveOut<Openings, BrightSpots>();
    if (end.known == Known::joined) aims.leaveOut<OpeningImages>();
  }
  return aims;
}

// The weight of a diffuse reflection where light is interpolated. It is one half, as in rtrace, unless
// nothing limits the bounces: there it is at least the reflectance. Russian roulette would otherwise end
// paths sooner than their light falls, and their variance would grow from bounce to bounce without a bound.
Coefficient weightOf(const RayOptions& options, const PathContext& ray, const Coefficient& reflectance) {
  if (ray.ambientLevel == 0 || options.ambientBounces < RayOptions::kAllBounces)
    return Coefficient(kMeanReflectance);
  return Coefficient(std::clamp(maxChannel(reflectance), kMeanReflectance, 1.));
}

// A place that sends rays over its hemisphere.
struct Gather {
  const PreparedScene& prepared;
  const PathSettings& settings;
  Aims aims;
  PathState& state;
  RayFollower& follower;
  const RayEnd& end;
  const DiffuseSide& side;

  // Calls found() for each ray with its part of the light. The rays estimate the fraction `share` of the
  // light; each has the weight of one ray among `weighedAs`.
  void send(int rays, int weighedAs, double share, FunctionRef<void(const Radiance& part)> found) const {
    const GatherDirections directions(aims, side.point, side.normal, side.trueNormal, rays);
    const Coefficient weight = settings.caches.field
                                   ? weightOf(prepared.options(), end.context, side.coefficient)
                                   : side.coefficient / weighedAs;
    sendOverHemisphere(prepared, directions, state, end, side.point, side.kind, directionSet(rays),
                       side.coefficient * share, weight, [&](const NextRay& next) {
                         if (next.context.ambientLevel == 1) countDescendants(settings, state, next.context);
                         found(follower.follow(next.query, next.context).value * next.coefficient);
                       });
  }

  DirectionSet directionSet(int rays) const {
    const auto& interleaved = state.request.interleaved;
    if (!interleaved || end.context.ambientLevel > 0) return {rays, state.random};
    Random common(interleaved->lattice);
    return DirectionSet::interleaved(rays, interleaved->number, common);
  }
};

// Whether a gather may send more rays than -ad plus -as. It may at sensors (-I), whose noise is not averaged
// with the noise of other gathers, unless -as 0 disables supersampling. Behind blinds and below shafts this
// noise is most of the error, while most of the time goes into patches, which all sensors share.
bool mayAddRays(const Gather& from, int rays) {
  return from.settings.caches.field && isRayMode(from.settings.mode) && from.end.hit.surface == kNone &&
         from.state.request.rays == 0 && from.end.context.ambientLevel == 0 &&
         from.prepared.options().ambientSuperSamples > 0 && rays >= 4 * GatherNoise::kBins;
}

// Half of the rays of a gather that may add more.
struct Half {
  Random random{0};  // as before its first ray
  GatherNoise noise;
  Radiance value{};
  int added = 0;     // number of rays that are added
  double share = 1;  // weight of its first rays in its light; added rays have the remaining weight
};

// Repeats the first rays of each half, with their random numbers, to show them to the observer. Their
// coefficients were not known when they were first sent.
void showFirstRays(const Gather& from, const std::array<Half, 2>& halves, int ofHalf, int weighedAs) {
  const Random after = from.state.random;
  for (const Half& half : halves) {
    from.state.random = half.random;
    from.send(ofHalf, weighedAs, half.share / 2, [](const Radiance&) {});
  }
  from.state.random = after;
}

// Gathers by two independent halves and adds rays where they are noisy. The noise of each half decides how
// many rays are added to the other half, so that both remain unbiased: a half that happens to miss bright
// places seems less noisy than it is, and would get too few rays by its own noise. Therefore each half is
// stratified separately, too: of two halves that share their strata, one hits the places that the other
// misses.
void gatherAccurately(const Gather& from, int rays, Radiance& value) {
  const RayOptions& o = from.prepared.options();
  const int ofHalf = rays / 2;
  const double allowed = o.ambientAccuracy / tuning::SensorNoise::kAccuracy;
  std::array<Half, 2> halves;
  const RayObserver* const observer = std::exchange(from.state.request.observer, nullptr);
  for (Half& half : halves) {
    int sent = 0;
    half.random = from.state.random;
    from.send(ofHalf, rays, .5, [&](const Radiance& part) {
      half.value += part;
      half.noise.add(sent++, brightness(part));
    });
  }
  for (const int k : {0, 1}) {
    Half& half = halves[k];
    const double ratio = halves[1 - k].noise.ofWhole() / allowed;
    const double asked = std::min((ratio * ratio - 1) * ofHalf, mostAddedAtSensors(o) / 2);
    if (!(asked >= ofHalf / tuning::SensorNoise::kFewestAdded)) continue;  // also if it is not a number
    half.added = static_cast<int>(asked);
    half.share = ofHalf / static_cast<double>(ofHalf + half.added);
  }
  from.state.request.observer = observer;
  if (observer) showFirstRays(from, halves, ofHalf, rays);
  for (const Half& half : halves) {
    value += half.value * half.share;
    if (half.added > 0)
      from.send(half.added, rays, (1 - half.share) / 2, [&](const Radiance& part) { value += part; });
  }
}

}  // namespace

int IndirectLight::add(const RayEnd& end, const DiffuseSide& side, Radiance& value) {
  const RayOptions& o = t_.options();
  const PathContext& ray = end.context;
  if (o.ambientDivisions <= 0 || ray.ambientLevel >= o.ambientBounces || !t_.isAmbient(end.hit.surface)) {
    value += side.coefficient * o.ambientValue;
    return 0;
  }
  if (ray.depth == 0 && state_.request.leavesOutIndirect) {
    state_.leftOut.indirect = true;
    return 0;
  }
  if (state_.links) {
    link(end, side);
    return 0;
  }
  const FirstBounce first = settings_.mode.firstBounce;
  if (ray.ambientLevel > 0 || first == FirstBounce::fromPatches ||
      (first == FirstBounce::gathered && (ray.kinds & kSpecular))) {
    Coefficient asked = side.coefficient;
    if (settings_.caches.coarse && !asksForPatch(state_, ray, asked)) return 0;
    const DiffuseSide chosen = withCoefficient(side, asked);
    if (settings_.caches.coarse && addFromPatch(end, chosen, value)) return 0;
    return gather(end, chosen, value);
  }
  if (first == FirstBounce::interpolated && settings_.mode.interpolates && settings_.caches.field &&
      addInterpolated(end, side, value))
    return 0;
  return gather(end, side, value);
}

// Adds light from the irradiance cache. Returns false, and adds nothing, if the cache cannot be used here.
bool IndirectLight::addInterpolated(const RayEnd& end, const DiffuseSide& side, Radiance& value) {
  // Illuminance at a sensor (-I) is not interpolated, because no other ray needs it.
  if (end.hit.surface == kNone || !isOrdinary(end, side, t_.options().medium())) return false;
  TracedFieldRays rays(t_, follower_, end.context.depth);
  GatheredLight light;
  if (!settings_.caches.field->find(placeOf(end, side), reader_, rays, light)) return false;
  value += side.coefficient * light.meanOfTilted(side.trueNormal, side.normal);
  return true;
}

// Adds light from the coarse solution. Returns false, and adds nothing, if it has no patch here.
bool IndirectLight::addFromPatch(const RayEnd& end, const DiffuseSide& side, Radiance& value) {
  const PatchPlace place = patchAt(end, side);
  if (!place.patch) return false;
  TracedFieldRays rays(t_, follower_, end.context.depth);
  value += side.coefficient *
           Radiance(settings_.caches.coarse->light(place, bouncesLeft(t_.options(), end.context), rays));
  return true;
}

// The patch of the coarse solution that gives the light of a side; null if there is none.
PatchPlace IndirectLight::patchAt(const RayEnd& end, const DiffuseSide& side) {
  if (!isOrdinary(end, side, t_.options().medium())) return {};
  TracedFieldRays rays(t_, follower_, end.context.depth);
  const auto asker = state_.links ? CoarseSolution::Asker::patch : CoarseSolution::Asker::path;
  return settings_.caches.coarse->find(placeOf(end, side), rays, asker, settings_.mode.solution);
}

void IndirectLight::endPath() {
  if (settings_.caches.field) settings_.caches.field->leave(reader_);
}

// The number of directions of a gather. Without interpolation it is RADIANCE's number at every bounce: a
// square number, proportional to the weight. With interpolation, a path continues with one ray at later
// bounces.
int IndirectLight::raysOf(const PathContext& ray, const Coefficient& coefficient) const {
  if (state_.glimpses) return 1;
  const RayOptions& o = t_.options();
  const int requested = state_.request.rays;
  const double divisions = requested > 0 ? requested : o.ambientDivisions,
               asked = requested > 0 ? requested : o.ambientDivisions + o.ambientSuperSamples,
               weighted = asked * std::min(ray.weight, 1.);
  if (settings_.caches.field) return ray.ambientLevel > 0 ? 1 : std::max(1, static_cast<int>(weighted + .5));
  // With more directions than this, each would be below the weight limit, and most would end. The factor .8
  // is RADIANCE's.
  const double most = asked * .8 * maxChannel(coefficient) * ray.weight / (divisions * o.weightLimit + 1e-20);
  const int side = std::max(1, static_cast<int>(std::sqrt(std::min(weighted, most)) + .5));
  return side * side;
}

// With -Sh, the first gather of a path sends this number of times as many rays as continue from their first
// surface. The light at the end of these rays, such as parts of the sky seen through windows, causes most of
// the variance of contributions by bin, but later bounces take most of the time. Not used if there are light
// sources, because each ray would then sample them.
int IndirectLight::firstRays() const {
  // The number of rays is at most 2^kMostDoublings = 8 times as large. This was measured in a classroom, with
  // the sky divided into 2306 bins (-ab 5). With 8 times as many rays, the product of variance and time is
  // .13 times that without more rays; with 4 times as many, .19. With 16 times as many, it is .13, too, but
  // the run takes longer than in the original RADIANCE.
  constexpr int kMostDoublings = 3;
  const RayOptions& o = t_.options();
  const bool daylit = settings_.aims.of<Openings>() && t_.lights().all().empty();
  if (settings_.caches.field || !daylit || o.ambientBounces < 2) return 1;
  return o.firstRays > 0 ? o.firstRays : 1 << std::min(o.ambientBounces - 1, kMostDoublings);
}

int IndirectLight::gather(const RayEnd& end, const DiffuseSide& side, Radiance& value) {
  const int rays = raysOf(end.context, side.coefficient), level = end.context.ambientLevel;
  if (level == 0) state_.gathers = true;
  const Gather from{t_, settings_, aimsAt(end, settings_, state_), state_, follower_, end, side};
  const auto send = [&](int count, int weighedAs, double share) {
    from.send(count, weighedAs, share, [&](const Radiance& part) { value += part; });
  };
  const int times = level <= 1 ? firstRays() : 1;
  if (mayAddRays(from, rays)) {
    gatherAccurately(from, rays, value);
  } else if (times == 1) {
    send(rays, rays, 1);
  } else if (level == 1) {
    if (!looksOnly_) send(rays, rays, times);
  } else {
    // Sent separately, so that the rays that continue are as well stratified as without the additional rays.
    looksOnly_ = false;
    send(rays, rays, 1. / times);
    looksOnly_ = true;
    send(rays * (times - 1), rays, 1 - 1. / times);
    looksOnly_ = false;
  }
  return rays;
}

// Links the patch that sent a ray to the patch at the diffuse surface where the ray ended. If there is no
// patch there, the path continues in one direction, unless this is the last bounce.
void IndirectLight::link(const RayEnd& end, const DiffuseSide& at) {
  Coefficient asked = at.coefficient;
  if (!asksForPatch(state_, end.context, asked)) return;
  const DiffuseSide side = withCoefficient(at, asked);
  PatchLinks& links = *state_.links;
  const int level = end.context.ambientLevel;
  const bool isLast = level >= bouncesBeyondPatches(t_.options());
  const PatchPlace to = isLast ? PatchPlace() : patchAt(end, side);
  const Coefficient whole = side.coefficient * end.context.contribution * passedBy(end);
  if (to.patch) return links.addLink(to, whole, level - 1);
  links.addEnd(level - 1, whole);
  if (isLast) return;
  const GatherDirections directions(settings_.aims, side.point, side.normal, side.trueNormal, 1);
  sendOverHemisphere(t_, directions, state_, end, side.point, side.kind, DirectionSet(1, state_.random),
                     side.coefficient, weightOf(t_.options(), end.context, side.coefficient),
                     [&](const NextRay& next) {
                       const Radiance found = follower_.follow(next.query, next.context).value;
                       links.addLight(level, found * next.context.contribution);
                     });
}

}  // namespace rsphere
