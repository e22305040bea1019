#pragma once
// Radiance along a ray: direct light from the sources, sharp reflections and refractions, samples of rough
// ones, and indirect light.
//
// With -aa above 0, indirect light at the first diffuse surface of a path is interpolated
// (irradiance_field.h), and that of later ones comes from a coarse solution (coarse_solution.h). Otherwise it
// is gathered directly: -ad + -as stratified directions over the hemisphere at the first diffuse surface, one
// direction at every later one. Paths end after -ab bounces, and below -lw: by Russian roulette, which
// keeps the mean unbiased, unless -lr is positive.
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "cli/answer.h"
#include "cli/options.h"
#include "light/source_choice.h"
#include "light/sources.h"
#include "scene/random.h"
#include "scene/scene.h"
#include "shade/anisotropic.h"
#include "shade/function_reflection.h"
#include "shade/scattering.h"
#include "shade/surface_functions.h"
#include "trace/tracer.h"
#include "transport/bright_spots.h"
#include "transport/coarse_solution.h"
#include "transport/function_ref.h"
#include "transport/irradiance_field.h"
#include "transport/openings.h"
#include "transport/presumed_shadows.h"
#include "transport/ray.h"

namespace rsphere {

// Changes seeds with -Sr; 0 for -Sr 0, where seeds follow from places and rays alone.
inline uint64_t rotationBits(const RayOptions& options) {
  return options.rotation == 0 ? 0 : mixBits(options.rotation);
}

// What all threads share; not changed by tracing. Keeps references to the scene.
class Transport {
 public:
  // basicRadiance: refraction leaves radiance as it is (-Sb). warn: SurfaceFunctions' and LightSources'.
  Transport(const Scene& scene, const RayOptions& options, Irradiance irradiance, bool basicRadiance = false,
            const rad::Warn& warn = {});

  const Scene& scene() const { return scene_; }
  const Tracer& tracer() const { return tracer_; }
  const LightSources& lights() const { return lights_; }
  const PresumedShadows& presumedShadows() const { return presumedShadows_; }
  const SourceChoice& choice() const { return choice_; }
  const SurfaceFunctions& functions() const { return functions_; }
  const RayOptions& options() const { return options_; }
  Irradiance irradiance() const { return irradiance_; }
  bool basicRadiance() const { return basicRadiance_; }
  // Index in LightSources of a surface's own light, or kNone.
  int32_t lightOf(int32_t surface) const { return lightOf_[surface]; }
  // The radiance that a light source has whatever it is seen from, by index in LightSources; null where that
  // is to be computed.
  const Rgb* constantRadiance(uint32_t source) const {
    return constantRadiance_[source] ? &*constantRadiance_[source] : nullptr;
  }
  // Whether indirect light is computed on the surface (-ae, -ai).
  bool isAmbient(int32_t surface) const { return surface == kNone || ambient_.empty() || ambient_[surface]; }
  // Of what no mist and no dielectric fills (-me -ma -mg).
  Medium medium() const {
    return {options_.mediumExtinction, options_.mediumAlbedo, options_.mediumEccentricity};
  }
  // Light sources that some mist names, as indices in LightSources; and which of these one does.
  const std::vector<uint32_t>& scatterers() const { return scatterers_; }
  const std::vector<uint16_t>& scatterersOf(const Mist& mist) const { return scatterersOf_[mist.number]; }
  // Whether nothing can give light: no light sources, no glow, no ambient value, no goals.
  bool isDark() const;
  // Whether rtrace warns of it: no light source, and either no surface that glows or no indirect light (-ab),
  // by which alone glow of no reach lights surfaces. The ambient value does not count.
  bool lacksSources() const;
  // Surfaces of type source that shine, in the order of the scene.
  const std::vector<int32_t>& distant() const { return distant_; }
  // Where indirect light is interpolated; null where it is not (-aa 0). Tracing adds to it.
  IrradianceField* field() const { return field_.get(); }
  // Where the light of second and later diffuse surfaces comes from; null where paths are followed (-aa 0).
  // Tracing adds to it.
  CoarseSolution* coarse() const { return coarse_.get(); }
  // Where daylight comes in; null where nothing is known of that.
  const Openings* openings() const { return openings_.get(); }
  // What its paths aim at; null where light falls evenly.
  const BrightSpots* spots() const { return spots_.get(); }

 private:
  void prepareInterpolation(const rad::Warn& warn);
  bool glows(std::span<const Surface> surfaces) const;
  void findScatterers(const rad::Warn& warn);
  std::optional<uint32_t> sourceNamed(std::string_view name) const;

  const Scene& scene_;
  RayOptions options_;
  Irradiance irradiance_;
  bool basicRadiance_;
  Tracer tracer_;
  SurfaceFunctions functions_;
  LightSources lights_;
  PresumedShadows presumedShadows_;
  SourceChoice choice_;
  std::vector<int32_t> lightOf_;
  std::vector<std::optional<Rgb>> constantRadiance_;
  std::vector<int32_t> distant_;
  std::vector<uint32_t> scatterers_;
  std::vector<std::vector<uint16_t>> scatterersOf_;  // by Mist::number
  std::vector<bool> ambient_;                        // by surface; empty: all of them
  std::unique_ptr<const Openings> openings_;
  std::unique_ptr<IrradianceField> field_;
  std::unique_ptr<CoarseSolution> coarse_;
  std::unique_ptr<const BrightSpots> spots_;
};

// The share of a source's radiance that leaves along a ray, for the source's direction (unit) and the solid
// angle (sr) that a sample of it stands for.
using DirectCoefficient = FunctionRef<Rgb(const V3d& toSource, double solidAngle)>;

// Draws a direction (unit) of a lobe for two uniform numbers in [0, 1); answers its weight, 0 where the draw
// is lost.
using LobeSampler = FunctionRef<double(double u1, double u2, V3d& direction)>;

// Gets a ray that is finished, but for what the medium in front of its hit takes away (rtrace's -ot, -oT).
using RayObserver = std::function<void(const Ray& ray)>;

// The weight of an indirect ray in its parent's where light is interpolated: it stands for a mean reflectance
// rather than for its own small share of the light, so that limits of weight end bounces and not directions.
// RADIANCE's own figure.
inline constexpr double kMeanReflectance = .5;

struct BsdfHit;
class LocalGuess;

// Traces one ray at a time; one a thread. The answer depends on the ray, the seed and Transport alone.
class PathTracer {
 public:
  // spots: where indirect light is gathered (not interpolated), directions are aimed at them; null: nowhere.
  explicit PathTracer(const Transport& transport, const BrightSpots* spots = nullptr)
      : t_(transport), spots_(spots), blockers_(size_t{1} << kBlockerBits, Tracer::kNoBlocker) {}

  // Radiance along a primary ray (W/sr/m2), or irradiance (W/m2) as Transport::irradiance says: on the
  // surface that is hit, or on an imagined one just ahead that faces the ray (see inputRay() for where -I
  // starts). direction: unit. farthest: 0 for no limit (-ld, world units). The seed decides every random
  // number of the path. Throws rad::Error where a path goes through more than 20500 surfaces one after the
  // other, or more than this thread's stack has room for (2 kB each at most), and where Russian roulette has
  // no weight to go by (-lw 0).
  Ray trace(const V3d& origin, const V3d& direction, double farthest, uint64_t seed);

  // The radiance along a primary ray to a light source, as trace() would have it, at the price of a shadow
  // ray where nothing that could let light pass is in between. Whether it shows the source: shown().
  Ray traceToSource(const V3d& point, const SourceSample& sample, uint64_t seed);

  // The light source whose own light the last primary ray showed, at its end or straight on through panes
  // that shadow rays pass as well, mirrored once by something flat or not at all. Of several the one that was
  // not mirrored, or else the first.
  struct Shown {
    int32_t source = kNone;  // index in Scene::surfaces; kNone: none was shown
    int32_t mirror = kNone;  // what mirrored it
    bool operator==(const Shown&) const = default;
  };
  const Shown& shown() const { return shown_; }

  // What the last primary ray met first, as Tracer::nearest tells it.
  const Hit& firstHit() const { return firstHit_; }

  // From now on trace() shows every ray to the observer, descendants before their ancestors, the primary ray
  // last (but not under -I, where it meets nothing); Ray::depth counts its ancestors. Shadow rays are shown
  // where they meet something that might let light pass, and all that meet something if allShadowRays. No
  // answer changes by it. Null: none.
  void observe(RayObserver observer, bool allShadowRays = false) {
    observer_ = std::move(observer);
    allShadowRays_ = allShadowRays;
  }

  // From now on what the indirect rays that are gathered bring is guessed as well (radiance_guess.h): for one
  // that is followed several are only guessed. The mean of many rays stays what it is; one ray's value may be
  // negative. Null: nothing is guessed.
  void guessWith(const LocalGuess* guess) { guess_ = guess; }

  // The radiance along a ray of which nothing but the last diffuse bounce may be followed.
  Rgb glimpse(const V3d& origin, const V3d& direction, uint64_t seed);

  // From now on indirect light is gathered directly at the first diffuse surface even if -aa is above 0:
  // where thousands of directions are averaged, single rays reduce the error faster than sites. Later
  // surfaces still use the coarse solution.
  void gatherFirstAnew() { gathersFirstAnew_ = true; }

  // Only what is hit, no value.
  Ray cast(const V3d& origin, const V3d& direction, double farthest);

 private:
  struct Contribution {
    const SourceSample* sample;
    Rgb coefficient, value;
  };

  bool continueRay(Ray& child, RayKind kind, const Ray& parent, Rgb& coefficient);
  void evaluate(Ray& ray);
  void findHit(Ray& ray);
  void findTarget(Ray& ray);
  bool seesDistant(Ray& ray);
  void shadeHit(Ray& ray);
  bool shadeSurface(Ray& ray);
  bool shade(Ray& ray, int32_t modifier);
  void pass(Ray& ray);
  void finish(Ray& ray);
  Rgb valueFromSource(const Ray& ray, const Contribution& to);
  void passOn(Ray& child, Ray& ray);
  void participate(Ray& ray);
  void addScattered(Ray& ray);

  bool applyModifier(Ray& ray, int32_t modifier);
  bool shadeMixture(Ray& ray, int32_t modifier, const Mixture& mixture);
  void applyModifiers(Ray& ray, int32_t modifier);
  FunctionPoint functionPoint(const Ray& ray) const;
  FunctionPoint functionPoint(const Ray& ray, const FunctionScattering& scattering) const;
  FunctionPoint functionPoint(const Ray& ray, const Interaction& at) const;

  // behind: the chain of modifiers that the material has itself.
  template <class M>
  bool shadeTwoSided(Ray& ray, const M& material, int32_t behind);
  bool shadeMaterial(Ray& ray, const Opaque& material, int32_t behind);
  bool shadeMaterial(Ray& ray, const Trans& material, int32_t behind);
  bool shadeMaterial(Ray& ray, const Anisotropic& material, int32_t behind);
  bool shadeMaterial(Ray& ray, const Ashikhmin& material, int32_t behind);
  bool shadeMaterial(Ray& ray, const FunctionScatterer& material, int32_t behind);
  bool shadeMaterial(Ray& ray, const BrtdFunction& material, int32_t behind);
  bool shadeMaterial(Ray& ray, const WgmdFunction& material, int32_t behind);
  bool shadeMaterial(Ray& ray, const BsdfMaterial& material, int32_t behind);
  bool shadeMaterial(Ray& ray, const Dielectric& material, int32_t behind);
  bool shadeMaterial(Ray& ray, const Interface& material, int32_t behind);
  bool shadeMaterial(Ray& ray, const Glass& material, int32_t behind);
  bool shadeMaterial(Ray& ray, const Mirror& material, int32_t behind);
  bool shadeMaterial(Ray& ray, const Prism& material, int32_t behind);
  bool shadeMaterial(Ray& ray, const Antimatter& material, int32_t behind);
  bool shadeMaterial(Ray& ray, const Mist& material, int32_t behind);
  bool shadeMaterial(Ray& ray, const Light& material, int32_t behind);
  bool shadeMaterial(Ray& ray, const Illum& material, int32_t behind);
  bool shadeMaterial(Ray& ray, const Glow& material, int32_t behind);
  bool shadeMaterial(Ray& ray, const Spotlight& material, int32_t behind);

  bool countedByDirect(const Ray& ray, const Glow* glow) const;
  bool isStraight(const Ray& ray) const;
  void emit(Ray& ray, const Rgb& radiance, const Glow* glow, int32_t behind = kNone);
  bool shadeDiffusing(Ray& ray, const Scattering& scattering, const Interaction& at);
  bool shadeBoundary(Ray& ray, const Scattering& scattering);
  bool useAlternate(Ray& ray, const Alternate& alternate);
  void sampleBsdf(Ray& ray, BsdfHit& hit, RayKind kind);
  Rgb directedBsdf(const Ray& ray, const BsdfHit& hit, const V3d& toSource, double solidAngle);
  V3d jittered(const V3d& view, double projectedSolidAngle);
  bool passesBack(Ray& ray);
  bool shadeElliptic(Ray& ray, const AnisotropicScattering& scattering, const Interaction& at);
  bool shadeByFunction(Ray& ray, const FunctionScattering& scattering, const Interaction& at,
                       int32_t functions);
  Interaction component(const Ray& ray, const std::optional<int32_t>& named, const Interaction& inherited);
  void followSharp(Ray& ray, const SharpPaths& sharp);
  const LightSource* targetOf(const Ray& ray) const;
  void relay(Ray& ray, RayKind kind, const V3d& direction, Rgb coefficient);
  void sampleLobes(Ray& ray, const Scattering& scattering, const Interaction& at);
  // Whether the ray is one of the many rays of a gather for interpolation, or comes from one. Its own noise
  // averages out over them, so that it takes one sample where a primary ray takes several.
  bool isOfGather(const Ray& ray) const { return t_.field() && ray.ambientLevel > 0; }
  int samplesOf(const Ray& ray, double wanted) const;
  void sampleLobe(Ray& ray, RayKind kind, const Rgb& share, LobeSampler draw, int least = 1);
  void addIndirect(Ray& ray, const V3d& normal, const V3d& trueNormal, RayKind kind, const Rgb& coefficient);
  void addIndirect(Ray& ray, const V3d& normal, const Interaction& at, RayKind kind, const Rgb& coefficient);
  int raysToGuess(const Ray& ray) const;
  bool addInterpolated(Ray& ray, const V3d& normal, const V3d& trueNormal, const Rgb& coefficient);
  class Looker;
  PathTracer& gatherer();
  CoarseSolution::Patch* patchAt(const Ray& ray, const V3d& normal, const V3d& trueNormal, Looker& looker);
  bool addFromPatch(Ray& ray, const V3d& normal, const V3d& trueNormal, const Rgb& coefficient);
  int bouncesLeft(const Ray& ray) const;
  Ray gatherRoot(const GatherSite& site, int depth) const;
  // Gets a child that is ready to be traced, and its share of the mean over the hemisphere.
  using GatherRay = FunctionRef<void(Ray& child, double part)>;
  void gatherHemisphere(const Ray& root, const V3d& normal, const V3d& trueNormal, RayKind kind, int rays,
                        GatherRay each);
  void link(const GatherSite& site, int rays, uint64_t seed, int depth, CoarseSolution::Links& links);
  GatheredLight gather(const GatherSite& site, uint64_t seed, int depth);
  double reach(const GatherSite& site);
  // front: the normal of a surface that lets no light through, whose coefficients are 0 behind it; or 0.
  void addDirect(Ray& ray, DirectCoefficient coefficientOf, const V3d& front = V3d(0, 0, 0));
  void addDirectOfChosen(Ray& ray, DirectCoefficient coefficientOf, const V3d& front);
  size_t lookAheadOf(size_t count);
  void rankByBrightness(uint32_t count);
  Rgb sourceValue(const Ray& ray, const SourceSample& sample);
  uint32_t& blockerOf(int32_t surface, uint32_t source) {
    const uint64_t both = (uint64_t{static_cast<uint32_t>(surface)} << 32) | source;
    return blockers_[(both * 0x9e3779b97f4a7c15u) >> (64 - kBlockerBits)];  // Fibonacci hashing
  }
  uint32_t findContributions(const Ray& ray, DirectCoefficient coefficientOf, const V3d& front);
  void addOneOf(Ray& ray, size_t first, uint32_t count);
  bool arrives(const Ray& ray, const Contribution& to, Rgb& value);
  bool isWhole(const SourceSample& sample) const;
  Interaction interaction(const Ray& ray) const;

  const Transport& t_;
  const BrightSpots* spots_;
  const LocalGuess* guess_ = nullptr;
  Random random_{0};
  V3d primaryDirection_{0, 0, 1};
  Shown shown_;
  Hit firstHit_;
  RayObserver observer_;
  bool allShadowRays_ = false;
  FunctionScratch functionScratch_;
  FieldReader fieldReader_;
  std::unique_ptr<PathTracer> gatherer_;  // traces for sites and patches, whose paths begin anew
  bool gathersFirstAnew_ = false;
  CoarseSolution::Links* linking_ = nullptr;  // gets what the path finds, where it is a patch's
  // Scratch of addDirect, which never runs inside itself: shadow rays ask for no direct light. Behind what it
  // has filled is what was there before.
  std::vector<SourceSample> samples_;
  std::vector<Contribution> contributions_;
  std::vector<double> brightness_;  // of the contributions
  std::vector<uint32_t> order_;     // of these, brightest first where not all are tested
  std::vector<double> remaining_;
  std::vector<double> sourceWeights_;
  // What stopped the last ray from a surface to a source, at a hash of the two.
  static constexpr int kBlockerBits = 12;
  std::vector<uint32_t> blockers_;
  std::vector<size_t> lookAheads_;  // by count; as far as they were asked for
};

// What rtrace's output letters say of a traced ray.
RayAnswer answerOf(const Scene& scene, const Ray& ray);

// What they say of a ray that an observer was shown: as answerOf(), with its weight and its contribution,
// which is zero for a shadow ray that brings no light from its source.
RayAnswer branchAnswer(const Transport& transport, const Ray& ray);

// Whether the letters need a ray's value, or only what it hits.
bool needsValue(std::string_view letters);

}  // namespace rsphere
