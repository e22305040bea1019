// Shading of the surface that a ray hit.
#include "transport/surface_shading.h"

#include "rays/ray_functions.h"
#include "rays/ray_interaction.h"
#include "rays/shared_highlights.h"
#include "rays/volume_boundaries.h"
#include "transport/ray_limits.h"
#include "transport/tuning.h"

namespace rsphere {
namespace {

MaterialOptions materialOptions(const PreparedScene& prepared) {
  const RayOptions& o = prepared.options();
  return {.backFacesVisible = o.backFacesVisible,
          .sourcesVisible = o.sourcesVisible,
          .specularThreshold = o.specularThreshold,
          .specularSampling = o.specularSampling,
          .directJitter = o.directJitter,
          .basicRadiance = prepared.basicRadiance(),
          .medium = prepared.options().medium()};
}

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

}  // namespace

SurfaceShading::SurfaceShading(const PathPart& path)
    : PathPart(path),
      light_{DirectLight(path), SpecularLight(path), IndirectLight(path)},
      context_{t_.scene(), t_.functions(), materialOptions(t_)} {}

// Gives the material access to the end of a ray.
class SurfaceShading::Seen final : public MaterialHit {
 public:
  Seen(SurfaceShading& shading, RayEnd& end, ModifierId behind)
      : MaterialHit(arrivalOf(shading.t_, end), behind, shading.context_), shading_(shading), end_(end) {}

  Interaction interaction() const override { return interactionOf(scene(), end_); }
  const Color& pattern() const override { return end_.hit.pattern; }
  Interaction interactionAfter(ModifierId modifiers) const override {
    RayEnd own = end_;
    shading_.applyModifiers(own, modifiers);
    return interactionOf(scene(), own);
  }
  FunctionPoint point() const override { return pointOf(end_); }
  const Medium& medium() const override { return end_.medium(); }
  V3d towardsSource() const override {
    const auto& lights = shading_.t_.lights().all();
    const LightSource& source = lights[lights[end_.ray.aimedAt].relayed];
    return (source.isDistant() ? source.center : source.center - end_.hit.point).normalized();
  }
  int samplesOf(double wanted) const override {
    return rsphere::samplesOf(shading_.settings_, end_.context, wanted);
  }

 private:
  void applyModifiers() override { shading_.applyModifiers(end_, modifiers()); }
  void turnToFront() override { rsphere::turnRound(end_.hit); }

  SurfaceShading& shading_;
  RayEnd& end_;
};

// ---- surfaces and their modifiers

// For a surface that is an importance goal, adds its emission.
bool SurfaceShading::shade(RayEnd& end, RayResult& result) {
  const Surface& surface = t_.scene().surfaces[end.hit.surface];
  if (surface.clip & end.context.clips) return false;
  // A shadow ray may leave through a portal and remain known, because light paths carry sunlight that passes
  // only panes on its way to the portal. Other rays end at the portal, and new paths find the light beyond
  // it.
  if (end.context.known != Known::no && end.hit.perturbation == V3d(0, 0, 0) &&
      state_.request.vertexLight->surfaces().knows(end.hit.surface) &&
      ((end.context.kinds & kShadow) || !leavesThroughPortal(end)))
    end.known = end.context.known;
  if (!surface.goal || end.hit.cosine < 0) return shadeChain(end, surface.modifier, result);
  RayEnd ofGoal = end;
  RayResult emitted;
  Seen seen(*this, ofGoal, kNone);
  const LightId light = t_.lights().of(end.hit.surface);
  const SourceResponse emission = goalResponse(surface.finish.importance, light != kNone, seen);
  std::visit([&](const auto& outcome) { estimate(ofGoal, outcome, emitted); }, emission);
  const bool shaded = surface.finish.sensor || ((end.context.kinds & kShadow) && end.ray.aimedAt == light) ||
                      shadeChain(end, surface.modifier, result);
  result.value += emitted.value;
  return shaded;
}

bool SurfaceShading::shadeChain(RayEnd& end, ModifierId modifier, RayResult& result) {
  const bool meters =
      t_.irradiance() == IrradianceAt::surface && !(end.context.kinds & ~(kPrimary | kTransmitted));
  for (; modifier != kNone; modifier = t_.scene().modifiers[modifier].next) {
    const Modifier& m = t_.scene().modifiers[modifier];
    const auto* material = std::get_if<Material>(&m.content);
    if (!material) {
      if (applyModifier(end, modifier, result)) {
        // A mixture of materials must be the last modifier in a chain.
        if (m.next != kNone) throw rad::Error(t_.scene().place(m.primitive) + ": inappropriate modifier");
        return true;
      }
      continue;
    }
    if (meters && isTransparent(*material)) return estimate(end, Passes{}, result);
    if (meters && !isLightSource(*material) && !std::holds_alternative<Antimatter>(*material)) {
      end.hit.pattern = Color(1, 1, 1);
      meter(end, result);
      return true;
    }
    if (std::visit([&](const auto& kind) { return shadeMaterial(end, kind, m.next, result); }, *material))
      return true;
  }
  return false;
}

// Applies a pattern, texture or mixture to the hit. Returns whether a mixture has shaded the hit with a
// material.
inline bool SurfaceShading::applyModifier(RayEnd& end, ModifierId modifier, RayResult& result) {
  const Content& content = t_.scene().modifiers[modifier].content;
  SurfaceHit& hit = end.hit;
  if (const auto* mixture = std::get_if<Mixture>(&content)) {
    const Mixed mixed = mix(end, modifier, *mixture, result);
    hit.perturbation = mixed.perturbation;
    hit.pattern = mixed.pattern;
    if (mixed.light) result = *mixed.light;
    return mixed.light.has_value();
  }
  const FunctionPoint at = pointOf(end);
  if (std::holds_alternative<Pattern>(content))
    hit.pattern *= t_.functions().pattern(modifier, at, context_.scratch);
  else
    hit.perturbation += t_.functions().texture(modifier, at, context_.scratch);
  return false;
}

// Applies the modifiers of a material: patterns, textures, and mixtures of these.
inline void SurfaceShading::applyModifiers(RayEnd& end, ModifierId modifier) {
  for (; modifier != kNone; modifier = t_.scene().modifiers[modifier].next) {
    const Modifier& m = t_.scene().modifiers[modifier];
    RayResult none;
    if (std::holds_alternative<Material>(m.content) || applyModifier(end, modifier, none))
      throw rad::Error(t_.scene().place(m.primitive) + ": conflicting material");
  }
}

namespace {

// A copy of a ray that hits one of the two components of a mixture.
struct Part {
  double share;
  bool counts, shaded = false;
  PathContext context;
  RayEnd end;
  RayResult result;

  Part(const RayEnd& whole, double ofWhole, bool matters, const RayResult& before)
      : share(ofWhole), counts(matters), context(whole.context), end(whole, context), result(before) {
    context.weight *= share;
    context.contribution *= share;
  }
};

RayResult mixedLight(const Part& a, const Part& b) {
  RayResult all{a.result.value * a.share + b.result.value * b.share,
                a.result.mirrored * a.share + b.result.mirrored * b.share};
  const double mirroredA = a.share * brightness(a.result.mirrored),
               mirroredB = b.share * brightness(b.result.mirrored);
  all.mirroredLength = (mirroredA > mirroredB ? a : b).result.mirroredLength;
  const double restA = a.share * brightness(a.result.value) - mirroredA,
               restB = b.share * brightness(b.result.value) - mirroredB;
  all.unmirroredLength = (restA > restB ? a : b).result.unmirroredLength;
  return all;
}

}  // namespace

SurfaceShading::Mixed SurfaceShading::mix(const RayEnd& end, ModifierId modifier, const Mixture& mixture,
                                          const RayResult& before) {
  const double share = t_.functions().mixture(modifier, pointOf(end), context_.scratch);
  if (share < 0) return {end.hit.perturbation, end.hit.pattern, std::nullopt};
  Part a(end, share, share > kNegligible, before), b(end, 1 - share, share < 1 - kNegligible, before);
  if (a.counts) a.shaded = shadeChain(a.end, mixture.foreground, a.result);
  if (b.counts) b.shaded = shadeChain(b.end, mixture.background, b.result);
  // If only one component of a mixture is a material, the ray passes the other one.
  if (a.counts && !a.shaded && b.shaded) a.result = follower_.pass(a.end);
  if (b.counts && !b.shaded && a.shaded) b.result = follower_.pass(b.end);
  Mixed mixed{a.end.hit.perturbation * a.share + b.end.hit.perturbation * b.share,
              a.end.hit.pattern * a.share + b.end.hit.pattern * b.share, std::nullopt};
  if (a.shaded || b.shaded) mixed.light = mixedLight(a, b);
  return mixed;
}

// ---- materials

void SurfaceShading::meter(RayEnd& end, RayResult& result) {
  shadeMaterial(end, kIrradianceMeter, kNone, result);
}

template <class M>
bool SurfaceShading::shadeMaterial(RayEnd& end, const M& material, ModifierId behind, RayResult& result) {
  Seen seen(*this, end, behind);
  auto asked = response(material, seen);
  if constexpr (requires { asked.index(); })
    return std::visit([&](auto& outcome) { return estimate(end, outcome, result); }, asked);
  else
    return estimate(end, asked, result);
}

// lobesPart(): the light of the source that a sample of the reflected lobe has hit, with the weight of the
// lobe. lobesCoefficient(): the part of the coefficient of shadow rays that is left to the lobe.
template <ScattersLight S>
Radiance SurfaceShading::lobesPart(const S& scattering, const RayEnd& sample) const {
  const Radiance seen = sourceSeenBy(t_, sample);
  if (isBlack(seen)) return {};
  const LightSource& light = t_.lights().all()[t_.lights().of(sample.hit.surface)];
  return seen * shareOfLobe(light, sample.hit.length, std::abs(sample.hit.cosine),
                            scattering.lobeDensity(Component::reflected, sample.ray.direction));
}

template <ScattersLight S>
Coefficient SurfaceShading::lobesCoefficient(const S& scattering, const SourceSample& sample) const {
  const double density = scattering.lobeDensity(Component::reflected, sample.direction);
  if (!(density > 0) || !sharesHighlights(t_, sample.source)) return {};
  const double share = shareOfLobe(t_.lights().all()[sample.source], sample.distance, sample.cosine, density);
  return Coefficient(scattering.lobeShare(Component::reflected) * (share * density * sample.solidAngle));
}

namespace {

// Whether the path from the eye, or from the last diffuse surface, to the end of a ray contains a reflection.
bool isMirrored(const PathContext& context) {
  for (const PathContext* ray = &context; !(ray->kind & kAmbient) && ray->parent; ray = &ray->parent->context)
    if (ray->kind & (kReflected | kReflectedSpecular)) return true;
  return false;
}

}  // namespace

bool SurfaceShading::leavesThroughPortal(const RayEnd& end) const {
  return state_.request.vertexLight->surfaces().portals().isLeft(end.ray.origin, end.ray.direction,
                                                                 end.hit.length);
}

bool SurfaceShading::leftToPortals(const RayEnd& end) const {
  const PathContext& ray = end.context;
  return ownerOf(LightPart::throughPortal, {.known = ray.known,
                                            .isShadow = (ray.kinds & kShadow) != 0,
                                            .ambientLevel = ray.ambientLevel,
                                            .isMirrored = isMirrored(ray)}) != Owner::eye &&
         leavesThroughPortal(end);
}

SurfaceShading::Owners SurfaceShading::ownersAt(const RayEnd& end) {
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
double SurfaceShading::restOf(const RayEnd& end, Owner indirect) {
  const VertexLight& light = *state_.request.vertexLight;
  const bool here = indirect == Owner::here;
  if (!here && light.surfaces().coverage().all) return 0;
  const double probability = here                            ? tuning::VertexLight::kFollowed
                             : end.context.ambientLevel == 0 ? light.vertices().shareOfRest()
                                                             : 1;
  if (probability >= 1) return 1;
  return state_.random.uniform() < probability ? 1 / probability : 0;
}

void SurfaceShading::addFromVertices(const RayEnd& end, const V3d& normal, const Coefficient& coefficient,
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

void SurfaceShading::addFromSource(const RayEnd& end, const V3d& normal, Shown shown, Radiance& value) {
  const VertexLight& light = *state_.request.vertexLight;
  const PlainSurfaces& known = light.surfaces();
  const SurfaceId hit = end.hit.surface;
  const PlainPlace at{
      end.hit.point,  normal, known.finishOf(hit).opaque, hit, isFlat(t_.scene().surfaces[hit].shape),
      end.hit.pattern};
  value += light.directOf(at, {.view = end.ray.direction, .shown = shown}, state_.random, scratch_);
}

// The light that a surface scatters towards the ray's origin: sharp paths and lobes, then the indirect and
// direct light on each side.
template <ScattersLight S>
bool SurfaceShading::estimate(RayEnd& end, S& scattering, RayResult& result) {
  light_.specular.add(end, scattering.sharp(), result);
  if (end.context.kinds & kShadow) return true;
  const Owners owners = ownersAt(end);
  if (owners.highlight == Owner::here)
    addFromSource(end, scattering.trueNormal(),
                  owners.ofSources == Owner::here ? Shown::all : Shown::highlight, result.value);
  const bool shares = estimateLobes(end, scattering, owners.ofSources == Owner::eye, result);
  if (owners.indirect != Owner::eye) end.known = knownAfter(owners.indirect);
  const auto partOfLobe = [&](const SourceSample& sample) { return lobesCoefficient(scattering, sample); };
  const PartOfLobe part(partOfLobe);
  for (const Component c : scattering.components())
    estimateSide(end, scattering, c, owners, shares ? &part : nullptr, result.value);
  return true;
}

// Adds the light of the lobes. Returns whether samples of the reflected lobe estimate a part of the light of
// sources.
template <ScattersLight S>
[[gnu::always_inline]] inline bool SurfaceShading::estimateLobes(const RayEnd& end, S& scattering,
                                                                 bool mayShare, RayResult& result) {
  Random& random = state_.random;
  bool shares = false;
  const bool followsLobes = end.context.depth > 0 || !state_.request.leavesOutLobes;
  for (const Component c : scattering.components()) {
    std::optional<Lobe> lobe = scattering.lobe(c, random);
    if (!lobe) continue;
    if (!followsLobes) {
      state_.leftOut.lobes = true;
      continue;
    }
    if (end.context.depth == 0 && !isRayMode(settings_.mode) &&
        maxChannel(scattering.lobeShare(c)) >= tuning::VertexLight::kStrong)
      lobe->leastSamples = std::max(lobe->leastSamples, tuning::SpecularLight::kOfPoint);
    const auto draw = [&](int i, int n) { return scattering.draw(c, i, n, random); };
    if (c == Component::transmitted) {
      light_.specular.addLobe(end, kTransmittedSpecular, *lobe, draw, nullptr, result);
      continue;
    }
    shares = mayShare && settings_.mode.sharesHighlights && goesOn(t_, end.context);
    const auto ofSource = [&](const RayEnd& sample) { return lobesPart(scattering, sample); };
    const LobeShare share(ofSource);
    light_.specular.addLobe(end, kReflectedSpecular, *lobe, draw, shares ? &share : nullptr, result);
  }
  return shares;
}

// Adds the indirect and direct light on one side.
template <ScattersLight S>
[[gnu::always_inline]] inline void SurfaceShading::estimateSide(const RayEnd& end, S& scattering,
                                                                Component side, const Owners& owners,
                                                                const PartOfLobe* partOfLobe,
                                                                Radiance& value) {
  const V3d point = end.hit.point + scattering.offset(side);
  if (const Coefficient indirect = scattering.indirect(side); maxChannel(indirect) > kNegligible) {
    const V3d &normal = scattering.normal(side), &trueNormal = scattering.trueNormal();
    if (owners.indirect == Owner::here) addFromVertices(end, normal, indirect, value);
    if (owners.rest > 0) {
      const Coefficient followed = indirect * owners.rest;
      light_.indirect.add(end,
                          side == Component::reflected
                              ? DiffuseSide{point, normal, trueNormal, kReflectedAmbient, followed}
                              : DiffuseSide{point, -normal, -trueNormal, kTransmittedAmbient, followed},
                          value);
    }
  }
  const PlainSurfaces* const known =
      owners.ofSources == Owner::eye ? nullptr : &state_.request.vertexLight->surfaces();
  if (!scattering.takesDirect(side) || (known && (known->coverage().allDirect || !(owners.rest > 0)))) return;
  const auto coefficient = [&](const V3d& toSource, double solidAngle) {
    return scattering.coefficient(side, toSource, solidAngle, state_.random);
  };
  if (t_.options().chosenSources > 0 && scattering.isEven())
    return light_.direct.addOfChosen({end, point}, coefficient, scattering.front(), value);
  if (!known) return light_.direct.add({end, point}, coefficient, scattering.front(), partOfLobe, value);
  const auto ofRest = [&](const V3d& toSource, double solidAngle) {
    return coefficient(toSource, solidAngle) * owners.rest;
  };
  light_.direct.add({end, point, known}, ofRest, scattering.front(), partOfLobe, value);
}

bool SurfaceShading::estimate(RayEnd& end, Passes, RayResult& result) {
  result = follower_.pass(end);
  return true;
}

bool SurfaceShading::estimate(RayEnd& end, const Alternate& alternate, RayResult& result) {
  if (alternate.kind == Alternate::Kind::modifier) return shadeChain(end, alternate.modifier, result);
  return estimate(end, Passes{}, result);
}

bool SurfaceShading::estimate(RayEnd& end, const Emits& emits, RayResult& result) {
  if (ownerOf(LightPart::emitted,
              {.known = end.context.known, .isShadow = (end.context.kinds & kShadow) != 0}) != Owner::eye)
    return true;
  result.value = emits.radiance;
  // Not for shadow rays, which are the most frequent.
  if (!(end.context.kinds & kShadow)) noteShown(t_, end, state_);
  return true;
}

bool SurfaceShading::estimate(RayEnd& end, const Boundary& boundary, RayResult& result) {
  end.changedSpace().medium = boundary.scattering.medium;
  light_.specular.add(end, boundary.scattering.sharp, result);
  return true;
}

bool SurfaceShading::estimate(RayEnd& end, const CrossesMist& boundary, RayResult& result) {
  NextRay next = beyondMist(t_, boundary, end);
  result = follower_.passOn(next, end);
  return true;
}

bool SurfaceShading::estimate(RayEnd& end, const CrossesAntimatter& boundary, RayResult& result) {
  if (!entersCut(t_.scene(), boundary, end)) return estimate(end, Passes{}, result);
  // The material is on the other side of the antimatter's surface: a ray that leaves antimatter enters a
  // dielectric, and vice versa.
  flip(end.hit);
  end.hit.insideOut = !end.hit.insideOut;
  return shadeChain(end, boundary.cut.modifier, result);
}

}  // namespace rsphere
