// Shading of the surface that a ray hit.
#include "transport/surface_shading.h"

#include "rays/ray_functions.h"
#include "rays/ray_interaction.h"
#include "rays/volume_boundaries.h"
#include "transport/ray_limits.h"

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

}  // namespace

SurfaceShading::SurfaceShading(const PathPart& path)
    : PathPart(path), light_(path), context_{t_.scene(), t_.functions(), materialOptions(t_)} {}

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
      ((end.context.kinds & kShadow) || !light_.leavesThroughPortal(end)))
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

bool SurfaceShading::estimate(RayEnd& end, Passes, RayResult& result) {
  result = follower_.pass(end);
  return true;
}

bool SurfaceShading::estimate(RayEnd& end, const Alternate& alternate, RayResult& result) {
  if (alternate.kind == Alternate::Kind::modifier) return shadeChain(end, alternate.modifier, result);
  return estimate(end, Passes{}, result);
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
