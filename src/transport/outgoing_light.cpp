// The light that leaves a surface towards the origin of a ray is a sum. L: radiance that arrives from a
// direction. f: its fraction that is scattered towards the ray's origin, per sr, including the cosine. p:
// density of the n directions that are sampled (1/sr). w: solid angle of a source (sr).
//
//   term         integrand       directions                            estimate of the integral
//   emission     -               -                                     the radiance of the surface
//   sharp paths  coefficient L   of each path                          coefficient L
//   highlight    f L of a lobe   n samples of the lobe                 f L / (n p), times A from sources
//   indirect     f L, diffuse    a gather: p is cosine / pi, or aimed  f L / (n p), or interpolated
//   of sources   f L             to n points of each source            f L w / n, times B where A is used
//
// A = p w / (1 + p w) and B = 1 / (1 + p w) are the weights of the balance heuristic (shared_highlights.h).
// Where paths from both ends are used, they bring the last three terms of known light (VertexLight): its
// direct light by one shadow ray, indirect light by light vertices, weighted among themselves. owners.h says
// who estimates which term. The light that is then left to gathers and shadow rays is followed with a
// probability, and divided by it (Russian roulette).
#include "transport/outgoing_light.h"

#include "rays/shared_highlights.h"
#include "transport/ray_limits.h"
#include "transport/tuning.h"

namespace rsphere {
namespace {

// A ray through panes is straight if its direction (unit) differs by less than this from the first direction.
constexpr double kStraight = 1e-9;

// Whether a ray continues the primary ray in a straight line, except for a reflection by PathContext::mirror,
// and has passed no surface that blocks shadow rays. Shadow rays can then reach the source by this path.
bool isStraight(const PreparedScene& t, const RayEnd& end, const V3d& primaryDirection) {
  const SurfaceId mirror = end.context.mirror;
  for (const RayEnd* before = end.context.parent; before; before = before->context.parent) {
    const SurfaceHit& hit = before->hit;
    if (hit.surface != kNone && hit.surface != mirror && t.tracer().stopsShadows(hit.surface, hit.cosine > 0))
      return false;
  }
  V3d direction = primaryDirection;
  if (mirror != kNone) {
    const V3d& normal = *planeNormal(t.scene().surfaces[mirror].shape);
    direction -= 2 * normal.dot(direction) * normal;
  }
  return (end.ray.direction - direction).length2() < kStraight * kStraight;
}

// Records a light source that a ray shows (TracedRay::shown) in the state of its path, if the ray satisfies
// the conditions of TracedRay::shown. REQUIRES that the ray hit a surface that emits light towards it.
void noteShown(const PreparedScene& t, const RayEnd& end, PathState& state) {
  const SurfaceId surface = end.hit.surface, mirror = end.context.mirror;
  if (t.lights().of(surface) == kNone) return;
  // The ray shows this source only if it is straight or was mirrored once. A slab, such as thick glass,
  // displaces the ray by refraction, which does not matter for a distant source.
  const bool isDistant = t.scene().surfaces[surface].shape.as<Distant>();
  const unsigned others = end.context.kinds & ~(kPrimary | kTransmitted | (isDistant ? kRefracted : 0u));
  if (others != (mirror == kNone ? 0u : kReflected)) return;
  if (state.shown.source != kNone && (state.shown.mirror == kNone || mirror != kNone)) return;
  if (isStraight(t, end, state.primaryDirection)) state.shown = {surface, mirror};
}

// Whether the path from the eye, or from the last diffuse surface, to the end of a ray contains a reflection.
bool isMirrored(const PathContext& context) {
  for (const PathContext* ray = &context; !(ray->kind & kAmbient) && ray->parent; ray = &ray->parent->context)
    if (ray->kind & (kReflected | kReflectedSpecular)) return true;
  return false;
}

// The light of the source that a sample of the reflected lobe has hit, with the weight of the lobe.
template <ScattersLight S>
Radiance lobesPart(const PreparedScene& t, const S& scattering, const RayEnd& sample) {
  const Radiance seen = sourceSeenBy(t, sample);
  if (isBlack(seen)) return {};
  const LightSource& light = t.lights().all()[t.lights().of(sample.hit.surface)];
  return seen * shareOfLobe(light, sample.hit.length, std::abs(sample.hit.cosine),
                            scattering.lobeDensity(Component::reflected, sample.ray.direction));
}

// The part of the coefficient of a shadow ray that is left to samples of the reflected lobe.
template <ScattersLight S>
Coefficient lobesCoefficient(const PreparedScene& t, const S& scattering, const SourceSample& sample) {
  const double density = scattering.lobeDensity(Component::reflected, sample.direction);
  if (!(density > 0) || !sharesHighlights(t, sample.source)) return {};
  const double share = shareOfLobe(t.lights().all()[sample.source], sample.distance, sample.cosine, density);
  return Coefficient(scattering.lobeShare(Component::reflected) * (share * density * sample.solidAngle));
}

}  // namespace

OutgoingLight::OutgoingLight(const PathPart& path)
    : PathPart(path), direct(path), specular(path), indirect(path) {}

// Returns whether samples of the lobe estimate a part of the light of sources. mayShare: whether they may.
template <ScattersLight S>
[[gnu::always_inline]] inline bool OutgoingLight::addLobe(const RayEnd& end, S& scattering, Component c,
                                                          bool mayShare, RayResult& result) {
  std::optional<Lobe> lobe = scattering.lobe(c, state_.random);
  if (!lobe) return false;
  if (end.context.depth == 0 && state_.request.leavesOutLobes) {
    state_.leftOut.lobes = true;
    return false;
  }
  if (end.context.depth == 0 && !isRayMode(settings_.mode) &&
      maxChannel(scattering.lobeShare(c)) >= tuning::VertexLight::kStrong)
    lobe->leastSamples = std::max(lobe->leastSamples, tuning::SpecularLight::kOfPoint);
  const auto draw = [&](int i, int n) { return scattering.draw(c, i, n, state_.random); };
  const auto ofSource = [&](const RayEnd& sample) { return lobesPart(t_, scattering, sample); };
  const LobeShare share(ofSource);
  specular.addLobe(end, c == Component::reflected ? kReflectedSpecular : kTransmittedSpecular, *lobe, draw,
                   mayShare ? &share : nullptr, result);
  return mayShare;
}

// The number of times that the direct light of a surface is drawn. Jittered shadow rays to light sources are
// noisy. A gather at the surface sends so many rays that drawing this light several times takes no time
// beside them; few sources are drawn more often than many. Ray trees (-ot) show each source once. gathered:
// rays of the gather.
int OutgoingLight::drawsOfDirect(const RayEnd& end, int gathered) const {
  const size_t sources = t_.lights().all().size();
  if (end.context.ambientLevel > 0 || !(t_.options().directJitter > 0) || sources == 0) return 1;
  if (state_.request.observer && state_.request.shadows != ShownShadows::thatArrive) return 1;
  using Tuned = tuning::DirectLight;
  return std::max(
      1, gathered / (Tuned::kRaysForShadowRay * static_cast<int>(std::min(sources, Tuned::kFewDrawn))));
}

// Light of sources by shadow rays from a point on one side. shares: whether samples of a lobe estimate a part
// of it. gathered: rays of the gather at that point; 0: none.
template <ScattersLight S>
[[gnu::always_inline]] inline void OutgoingLight::addDirect(const RayEnd& end, const V3d& point,
                                                            S& scattering, Component side,
                                                            const Owners& owners, bool shares, int gathered,
                                                            Radiance& value) {
  const PlainSurfaces* const known =
      owners.ofSources == Owner::eye ? nullptr : &state_.request.vertexLight->surfaces();
  if (known && (known->coverage().allDirect || !(owners.rest > 0))) return;
  const bool chosen = t_.options().chosenSources > 0 && scattering.isEven();
  const int draws = shares ? 1 : drawsOfDirect(end, gathered);
  const double factor = (known && !chosen ? owners.rest : 1) / draws;
  const auto coefficient = [&](const V3d& toSource, double solidAngle) {
    return scattering.coefficient(side, toSource, solidAngle, state_.random) * factor;
  };
  const auto partOfLobe = [&](const SourceSample& sample) {
    return lobesCoefficient(t_, scattering, sample);
  };
  const PartOfLobe part(partOfLobe);
  const auto draw = [&](Radiance& to) {
    if (chosen)
      direct.addOfChosen({end, point}, coefficient, scattering.front(), to);
    else
      direct.add({end, point, known}, coefficient, scattering.front(), shares ? &part : nullptr, to);
  };
  if (draws == 1) return draw(value);
  Radiance sum;
  for (int i = 0; i < draws; ++i) {
    Radiance drawn = value / draws;  // the light so far, with which -dt compares
    draw(drawn);
    sum += drawn;
  }
  value = sum;
}

void OutgoingLight::addEmitted(const RayEnd& end, const Emits& emits, RayResult& result) {
  const bool isShadow = (end.context.kinds & kShadow) != 0;
  if (ownerOf(LightPart::emitted, {.known = end.context.known, .isShadow = isShadow}) != Owner::eye) return;
  result.value = emits.radiance;
  // Not for shadow rays, which are the most frequent.
  if (!isShadow) noteShown(t_, end, state_);
}

template <ScattersLight S>
void OutgoingLight::addScattered(RayEnd& end, S& scattering, RayResult& result) {
  // Sharp paths.
  specular.add(end, scattering.sharp(), result);
  if (end.context.kinds & kShadow) return;
  const Owners owners = ownersAt(end);

  // Light of sources by paths from both ends: all of it, or the highlight.
  if (owners.highlight == Owner::here)
    addFromSource(end, scattering.trueNormal(),
                  owners.ofSources == Owner::here ? Shown::all : Shown::highlight, result.value);

  // Highlights, by samples of lobes.
  const bool shares =
      owners.ofSources == Owner::eye && settings_.mode.sharesHighlights && goesOn(t_, end.context);
  bool shared = false;
  for (const Component c : scattering.components())
    shared |= addLobe(end, scattering, c, shares && c == Component::reflected, result);

  // On each side, indirect light, then light of sources.
  if (owners.indirect != Owner::eye) end.known = knownAfter(owners.indirect);
  for (const Component side : scattering.components()) {
    const V3d point = end.hit.point + scattering.offset(side);
    int gathered = 0;  // number of rays
    if (const Coefficient diffuse = scattering.indirect(side); maxChannel(diffuse) > kNegligible) {
      const V3d &normal = scattering.normal(side), &trueNormal = scattering.trueNormal();
      if (owners.indirect == Owner::here) addFromVertices(end, normal, diffuse, result.value);
      const Coefficient followed = diffuse * owners.rest;
      if (owners.rest > 0)
        gathered = indirect.add(end,
                                side == Component::reflected
                                    ? DiffuseSide{point, normal, trueNormal, kReflectedAmbient, followed}
                                    : DiffuseSide{point, -normal, -trueNormal, kTransmittedAmbient, followed},
                                result.value);
    }
    if (scattering.takesDirect(side))
      addDirect(end, point, scattering, side, owners, shared, gathered, result.value);
  }
}

template void OutgoingLight::addScattered(RayEnd&, RoundScattering&, RayResult&);
template void OutgoingLight::addScattered(RayEnd&, EllipticScattering&, RayResult&);
template void OutgoingLight::addScattered(RayEnd&, AshikhminLobeScattering&, RayResult&);
template void OutgoingLight::addScattered(RayEnd&, ProgrammedScattering&, RayResult&);
template void OutgoingLight::addScattered(RayEnd&, BsdfScattering&, RayResult&);

// ---- who estimates what

bool OutgoingLight::leavesThroughPortal(const RayEnd& end) const {
  return state_.request.vertexLight->surfaces().portals().lineLeaves(end.ray.origin, end.ray.direction,
                                                                     end.hit.length);
}

bool OutgoingLight::endsAtPortal(const RayEnd& end) const {
  const PathContext& ray = end.context;
  return ownerOf(LightPart::throughPortal, {.known = ray.known,
                                            .isShadow = (ray.kinds & kShadow) != 0,
                                            .ambientLevel = ray.ambientLevel,
                                            .isMirrored = isMirrored(ray)}) != Owner::eye &&
         leavesThroughPortal(end);
}

OutgoingLight::Owners OutgoingLight::ownersAt(const RayEnd& end) {
  if (end.known == Known::no) return {};
  const Opaque* const material = state_.request.vertexLight->surfaces().finishOf(end.hit.surface).opaque;
  if (!material) return {};
  const OwnedRay ray{.known = end.known,
                     .ambientLevel = end.context.ambientLevel,
                     .isMirrored = isMirrored(end.context),
                     .hasHighlight = hasRoughHighlight(*material),
                     .isStrong = material->specularity >= tuning::VertexLight::kStrong};
  const Owner indirect = ownerOf(LightPart::indirect, ray);
  return {ownerOf(LightPart::ofSources, ray), ownerOf(LightPart::highlight, ray), indirect,
          restOf(end, indirect)};
}

// Russian roulette: paths from both ends leave little light to paths from the eye, so that only some of these
// are followed.
double OutgoingLight::restOf(const RayEnd& end, Owner indirect) {
  const VertexLight& light = *state_.request.vertexLight;
  const bool here = indirect == Owner::here;
  if (!here && light.surfaces().coverage().all) return 0;
  const double probability = here                            ? tuning::VertexLight::kFollowed
                             : end.context.ambientLevel == 0 ? light.vertices().shareOfRest()
                                                             : 1;
  if (probability >= 1) return 1;
  return state_.random.uniform() < probability ? 1 / probability : 0;
}

// ---- paths from both ends

void OutgoingLight::addFromSource(const RayEnd& end, const V3d& normal, Shown shown, Radiance& value) {
  const VertexLight& light = *state_.request.vertexLight;
  const PlainSurfaces& known = light.surfaces();
  const SurfaceId hit = end.hit.surface;
  const PlainPlace at{
      end.hit.point,  normal, known.finishOf(hit).opaque, hit, isFlat(t_.scene().surfaces[hit].shape),
      end.hit.pattern};
  value += light.directOf(at, {.view = end.ray.direction, .shown = shown}, state_.random, scratch_);
}

void OutgoingLight::addFromVertices(const RayEnd& end, const V3d& normal, const Coefficient& coefficient,
                                    Radiance& value) {
  const VertexLight& light = *state_.request.vertexLight;
  const SurfaceId surface = end.hit.surface;
  const PlainPlace at{end.hit.point, normal, light.surfaces().finishOf(surface).opaque, surface};
  const auto beyond = [&](const V3d& origin, const V3d& direction, int bounces, Random&) {
    const RayQuery ray{.origin = origin, .direction = direction};
    PathContext context{.kind = kReflectedAmbient,
                        .kinds = end.context.kinds | kReflectedAmbient,
                        .weight = end.context.weight * kMeanReflectance * kMeanReflectance,
                        .level = end.context.level + 1,
                        .depth = end.context.depth + 1,
                        .ambientLevel = bounces};
    context.space = end.space();
    return follower_.follow(ray, context).value;
  };
  const OutdoorRadiance outdoors(beyond);
  const VertexLight::Indirect how{.bounces = t_.options().ambientBounces - end.context.ambientLevel,
                                  .outdoors = &outdoors};
  value += coefficient * light.indirectAt(at, how, state_.random, scratch_);
}

}  // namespace rsphere
