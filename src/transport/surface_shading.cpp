// Shading of the surface that a ray hit.
#include "transport/surface_shading.h"

#include "transport/ray_functions.h"
#include "transport/ray_interaction.h"
#include "transport/ray_limits.h"
#include "transport/shared_highlights.h"
#include "transport/volume_boundaries.h"

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
          .medium = prepared.medium()};
}

}  // namespace

SurfaceShading::SurfaceShading(const PreparedScene& prepared, const PathSettings& settings, PathState& state,
                               RayFollower& follower, DirectLight& direct, SpecularLight& specular,
                               IndirectLight& indirect)
    : t_(prepared),
      settings_(settings),
      state_(state),
      follower_(follower),
      direct_(direct),
      specular_(specular),
      indirect_(indirect),
      context_{prepared.scene(), prepared.functions(), materialOptions(prepared)} {}

// The hit of a ray as its material sees it.
class SurfaceShading::Hit final : public MaterialHit {
 public:
  Hit(SurfaceShading& shading, Ray& ray, ModifierId behind)
      : MaterialHit(arrivalOf(shading.t_, ray), behind, shading.context_), shading_(shading), ray_(ray) {}

  Interaction interaction() const override { return interactionOf(scene(), ray_); }
  const Color& pattern() const override { return ray_.pattern; }
  Interaction interactionAfter(ModifierId modifiers) const override {
    Ray own = ray_;
    shading_.applyModifiers(own, modifiers);
    return interactionOf(scene(), own);
  }
  FunctionPoint point() const override { return pointOf(ray_); }
  const Medium& medium() const override { return ray_.medium; }
  V3d towardsSource() const override {
    const auto& lights = shading_.t_.lights().all();
    const LightSource& source = lights[lights[ray_.aimedAt].relayed];
    return (source.isDistant() ? source.center : source.center - ray_.point).normalized();
  }
  int samplesOf(double wanted) const override { return rsphere::samplesOf(shading_.settings_, ray_, wanted); }

 private:
  void applyModifiers() override { shading_.applyModifiers(ray_, modifiers()); }
  void turnToFront() override { rsphere::turnRound(ray_); }

  SurfaceShading& shading_;
  Ray& ray_;
};

// ---- surfaces and their modifiers

void SurfaceShading::shadeHit(Ray& ray) {
  ray.unmirroredLength = ray.length;
  const bool clipped = (t_.scene().surfaces[ray.surface].clip & ray.clips) != 0;
  if (!clipped && shadeSurface(ray)) return;
  if (t_.scene().surfaces[ray.surface].shape.as<Distant>()) return;
  follower_.pass(ray);
}

bool SurfaceShading::shadeSurface(Ray& ray) {
  const Surface& surface = t_.scene().surfaces[ray.surface];
  if (!surface.goal || ray.cosine < 0) return shade(ray, surface.modifier);
  Ray emitted = ray;
  Hit hit(*this, emitted, kNone);
  const LightId light = t_.lightOf(ray.surface);
  SourceResponse emission = goalResponse(light != kNone, hit);
  follow(emitted, emission);
  const bool shaded = (ray.kinds & kShadow) && ray.aimedAt == light ? true : shade(ray, surface.modifier);
  ray.value += emitted.value;
  return shaded;
}

// Shades the ray with a chain of modifiers; false if the chain has no material.
bool SurfaceShading::shade(Ray& ray, ModifierId modifier) {
  const bool meters = t_.irradiance() == IrradianceAt::surface && !(ray.kinds & ~(kPrimary | kTransmitted));
  for (; modifier != kNone; modifier = t_.scene().modifiers[modifier].next) {
    const Modifier& m = t_.scene().modifiers[modifier];
    const auto* material = std::get_if<Material>(&m.content);
    if (!material) {
      if (applyModifier(ray, modifier)) {
        // A mixture of materials must be the last modifier of a chain.
        if (m.next != kNone) throw rad::Error(t_.scene().place(m.primitive) + ": inappropriate modifier");
        return true;
      }
      continue;
    }
    if (meters && isTransparent(*material)) return follow(ray, Passes{});
    if (meters && !isLightSource(*material) && !std::holds_alternative<Antimatter>(*material)) {
      ray.pattern = Color(1, 1, 1);
      meter(ray);
      return true;
    }
    if (std::visit([&](const auto& kind) { return shadeMaterial(ray, kind, m.next); }, *material))
      return true;
  }
  return false;
}

// Applies a pattern, texture or mixture to the ray. Returns whether a mixture has shaded it with a material.
inline bool SurfaceShading::applyModifier(Ray& ray, ModifierId modifier) {
  const Content& content = t_.scene().modifiers[modifier].content;
  if (const auto* mixture = std::get_if<Mixture>(&content)) return shadeMixture(ray, modifier, *mixture);
  const FunctionPoint at = pointOf(ray);
  if (std::holds_alternative<Pattern>(content))
    ray.pattern *= t_.functions().pattern(modifier, at, context_.scratch);
  else
    ray.perturbation += t_.functions().texture(modifier, at, context_.scratch);
  return false;
}

// Applies the modifiers of a material: patterns, textures, and mixtures of them.
inline void SurfaceShading::applyModifiers(Ray& ray, ModifierId modifier) {
  for (; modifier != kNone; modifier = t_.scene().modifiers[modifier].next) {
    const Modifier& m = t_.scene().modifiers[modifier];
    if (std::holds_alternative<Material>(m.content) || applyModifier(ray, modifier))
      throw rad::Error(t_.scene().place(m.primitive) + ": conflicting material");
  }
}

bool SurfaceShading::shadeMixture(Ray& ray, ModifierId modifier, const Mixture& mixture) {
  const double share = t_.functions().mixture(modifier, pointOf(ray), context_.scratch);
  if (share < 0) return false;
  struct Side {
    Ray ray;
    double share;
    bool counts, shaded = false;
  };
  Side sides[2] = {{ray, share, share > kNegligible}, {ray, 1 - share, share < 1 - kNegligible}};
  const ModifierId chains[2] = {mixture.foreground, mixture.background};
  for (int i = 0; i < 2; ++i) {
    Side& side = sides[i];
    if (!side.counts) continue;
    side.ray.weight *= side.share;
    side.ray.contribution *= side.share;
    side.shaded = shade(side.ray, chains[i]);
  }
  // If one component of a mixture is a material, void as the other component is transparent.
  for (int i = 0; i < 2; ++i)
    if (sides[i].counts && !sides[i].shaded && sides[1 - i].shaded) follower_.pass(sides[i].ray);
  const Ray& a = sides[0].ray;
  const Ray& b = sides[1].ray;
  const auto mixed = [&](const auto& x, const auto& y) { return x * share + y * (1 - share); };
  ray.perturbation = mixed(a.perturbation, b.perturbation);
  ray.pattern = mixed(a.pattern, b.pattern);
  if (!sides[0].shaded && !sides[1].shaded) return false;
  ray.value = mixed(a.value, b.value);
  ray.mirrored = mixed(a.mirrored, b.mirrored);
  const double mirroredA = share * brightness(a.mirrored), mirroredB = (1 - share) * brightness(b.mirrored);
  ray.mirroredLength = (mirroredA > mirroredB ? a : b).mirroredLength;
  const double restA = share * brightness(a.value) - mirroredA;
  const double restB = (1 - share) * brightness(b.value) - mirroredB;
  ray.unmirroredLength = (restA > restB ? a : b).unmirroredLength;
  return true;
}

// ---- materials

void SurfaceShading::meter(Ray& ray) { shadeMaterial(ray, kIrradianceMeter, kNone); }

template <class M>
bool SurfaceShading::shadeMaterial(Ray& ray, const M& material, ModifierId behind) {
  Hit hit(*this, ray, behind);
  auto answer = response(material, hit);
  return follow(ray, answer);
}

template <class... Outcomes>
bool SurfaceShading::follow(Ray& ray, std::variant<Outcomes...>& response) {
  return std::visit([&](auto& outcome) { return follow(ray, outcome); }, response);
}

// The light of a source that a sample of the reflected lobe has hit, and the coefficient that shadow rays
// leave to it.
template <ScattersLight S>
Radiance SurfaceShading::lobesPart(const S& scattering, const Ray& sample) const {
  const Radiance seen = sourceSeenBy(t_, sample);
  if (isBlack(seen)) return {};
  const LightSource& light = t_.lights().all()[t_.lightOf(sample.surface)];
  return seen * shareOfLobe(light, sample.length, std::abs(sample.cosine),
                            scattering.lobeDensity(Component::reflected, sample.direction));
}

template <ScattersLight S>
Coefficient SurfaceShading::lobesCoefficient(const S& scattering, const SourceSample& sample) const {
  const double density = scattering.lobeDensity(Component::reflected, sample.direction);
  if (!(density > 0) || !sharesHighlights(t_, sample.source)) return {};
  const double share = shareOfLobe(t_.lights().all()[sample.source], sample.distance, sample.cosine, density);
  return Coefficient(scattering.lobeShare(Component::reflected) * (share * density * sample.solidAngle));
}

// The light that a surface scatters towards the ray's origin: sharp paths, lobes, and on each side indirect
// and direct light.
template <ScattersLight S>
bool SurfaceShading::follow(Ray& ray, S& scattering) {
  Random& random = state_.random;
  specular_.follow(ray, scattering.sharp());
  if (ray.kinds & kShadow) return true;
  const auto components = scattering.components();
  bool shares = false;
  const bool followsLobes = ray.depth > 0 || !state_.request.leavesOutLobes;
  for (const Component c : components)
    if (const std::optional<Lobe> lobe = scattering.lobe(c, random)) {
      if (!followsLobes) {
        state_.leftOut.lobes = true;
        continue;
      }
      const auto draw = [&](int i, int n) { return scattering.draw(c, i, n, random); };
      if (c == Component::transmitted) {
        specular_.sampleLobe(ray, kTransmittedSpecular, *lobe, draw);
        continue;
      }
      shares = settings_.mode.sharesHighlights && goesOn(t_, ray);
      const auto ofSource = [&](const Ray& sample) { return lobesPart(scattering, sample); };
      const LobeShare share(ofSource);
      specular_.sampleLobe(ray, kReflectedSpecular, *lobe, draw, shares ? &share : nullptr);
    }
  const auto partOfLobe = [&](const SourceSample& sample) { return lobesCoefficient(scattering, sample); };
  const PartOfLobe part(partOfLobe);
  const V3d hit = ray.point;
  for (const Component c : components) {
    ray.point = hit + scattering.offset(c);
    if (const Coefficient indirect = scattering.indirect(c); maxChannel(indirect) > kNegligible) {
      const V3d &normal = scattering.normal(c), &trueNormal = scattering.trueNormal();
      if (c == Component::reflected)
        indirect_.add(ray, normal, trueNormal, kReflectedAmbient, indirect);
      else
        indirect_.add(ray, -normal, -trueNormal, kTransmittedAmbient, indirect);
    }
    if (!scattering.takesDirect(c)) continue;
    const auto coefficient = [&](const V3d& toSource, double solidAngle) {
      return scattering.coefficient(c, toSource, solidAngle, random);
    };
    if (t_.options().chosenSources > 0 && scattering.isEven())
      direct_.addOfChosen(ray, coefficient, scattering.front());
    else
      direct_.add(ray, coefficient, scattering.front(), shares ? &part : nullptr);
  }
  ray.point = hit;
  return true;
}

bool SurfaceShading::follow(Ray& ray, Passes) {
  follower_.pass(ray);
  return true;
}

bool SurfaceShading::follow(Ray& ray, const Alternate& alternate) {
  if (alternate.kind == Alternate::Kind::modifier) return shade(ray, alternate.modifier);
  return follow(ray, Passes{});
}

bool SurfaceShading::follow(Ray& ray, const Emits& emits) {
  ray.value = emits.radiance;
  if (!(ray.kinds & kShadow)) noteShown(t_, ray, state_);  // most rays are shadow rays
  return true;
}

bool SurfaceShading::follow(Ray& ray, const ReflectsSharply& response) {
  specular_.follow(ray, response.scattering.sharp);
  return true;
}

bool SurfaceShading::follow(Ray& ray, const Boundary& boundary) {
  ray.medium = boundary.scattering.medium;
  specular_.follow(ray, boundary.scattering.sharp);
  return true;
}

bool SurfaceShading::follow(Ray& ray, const Redirects& redirects) {
  specular_.redirect(ray, redirects.paths);
  return true;
}

bool SurfaceShading::follow(Ray& ray, const Relays& relays) {
  specular_.relay(ray, relays.path);
  return true;
}

bool SurfaceShading::follow(Ray& ray, const CrossesMist& boundary) {
  Ray child = beyondMist(t_, boundary, ray);
  follower_.passOn(child, ray);
  return true;
}

bool SurfaceShading::follow(Ray& ray, const CrossesAntimatter& boundary) {
  if (!entersCut(t_.scene(), boundary, ray)) return follow(ray, Passes{});
  // The material lies on the other side of the antimatter's surface: a ray that leaves the antimatter enters
  // a dielectric, and the reverse.
  flip(ray);
  ray.insideOut = !ray.insideOut;
  return shade(ray, boundary.cut.modifier);
}

}  // namespace rsphere
