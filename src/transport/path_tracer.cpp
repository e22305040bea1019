#include "transport/path_tracer.h"

#include <fmt/format.h>
#include <pthread.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "cli/version.h"
#include "scene/fingerprint.h"
#include "transport/ray_functions.h"

namespace rsphere {
namespace {

constexpr double kMeterLength =
    1e-5;  // -I: world units from the ray's origin to its imagined surface, as rtrace

// Rays are traced one inside the other. The deepest takes 40 MB of stack at most; runRecords() gives its
// threads more.
constexpr int kDeepest = 20500;
// What the work at one surface may need of it, tracing a ray through octrees within octrees included.
constexpr uintptr_t kStackReserve = 512 << 10;

// Where this thread's stack ends. Asked of the system once a thread.
uintptr_t stackEnd() {
  thread_local const uintptr_t end = [] {
    pthread_attr_t attributes;
    void* lowest = nullptr;
    size_t size = 0;
    if (pthread_getattr_np(pthread_self(), &attributes) != 0) return uintptr_t{0};
    pthread_attr_getstack(&attributes, &lowest, &size);
    pthread_attr_destroy(&attributes);
    return reinterpret_cast<uintptr_t>(lowest);
  }();
  return end;
}

void checkDepth(const Ray& ray) {
  if (ray.depth > kDeepest)
    throw rad::Error(fmt::format("a ray goes through more than {} surfaces one after the other", kDeepest));
  if (reinterpret_cast<uintptr_t>(__builtin_frame_address(0)) < stackEnd() + kStackReserve)
    throw rad::Error(
        fmt::format("a ray goes through {} surfaces one after the other: more than the thread's stack "
                    "has room for",
                    ray.depth),
        rad::Status::system);
}

// Rounded once: where a plane lies at 0, what is left of the coordinate tells on which side of it the point
// is, and function files with floor() in them ask.
V3d along(const V3d& origin, double distance, const V3d& direction) {
  return V3d(std::fma(distance, direction.x, origin.x), std::fma(distance, direction.y, origin.y),
             std::fma(distance, direction.z, origin.z));
}

// Of all that gathered light follows from besides the scene, this version of the program among it.
uint64_t fingerprint(const RayOptions& o, bool basicRadiance, const rad::FileAccess& access) {
  Fingerprint print;
  print.add(kVersion);
  print.add(uint64_t{4});  // how it is gathered, between two versions
  for (const double x :
       {o.directThreshold, o.directCertainty, o.directJitter, o.sourceSubstructuring, o.specularSampling,
        o.specularThreshold, o.ambientAccuracy, o.weightLimit, o.mediumEccentricity, o.mediumSampling})
    print.add(x);
  for (const Rgb& color : {o.ambientValue, o.mediumExtinction, o.mediumAlbedo})
    for (int c = 0; c < 3; ++c) print.add(static_cast<double>(color[c]));
  for (const int n : {o.directRelays, o.chosenSources, o.directPretest, o.ambientBounces, o.ambientResolution,
                      o.ambientDivisions, o.ambientSuperSamples, o.reflectionLimit})
    print.add(static_cast<uint64_t>(n));
  if (o.rotation != 0) print.add(o.rotation);
  for (const bool b : {o.sourcesVisible, o.backFacesVisible, o.uncorrelated, basicRadiance})
    print.add(uint64_t{b});
  for (const auto* names : {&o.ambientExcluded, &o.ambientIncluded}) {
    print.add(uint64_t{names->size()});
    for (const std::string& name : *names) print.add(name);
  }
  for (const SharedDefinitions& definitions : o.definitions) {
    print.add(definitions.text);
    if (definitions.isFile) addFile(print, definitions.text, access);
  }
  return print.value();
}

}  // namespace

Transport::Transport(const Scene& scene, const RayOptions& options, Irradiance irradiance, bool basicRadiance,
                     const rad::Warn& warn)
    : scene_(scene),
      options_(options),
      irradiance_(irradiance),
      basicRadiance_(basicRadiance),
      tracer_(scene, options.backFacesVisible),
      functions_(scene, warn, options.definitions),
      lights_(scene, options.directRelays, functions_, warn),
      presumedShadows_(scene, tracer_, lights_),
      choice_(scene, lights_),
      lightOf_(scene.surfaces.size(), kNone) {
  constantRadiance_.resize(lights_.all().size());
  for (size_t i = 0; i < lights_.all().size(); ++i) {
    if (lights_.all()[i].isVirtual()) continue;
    lightOf_[lights_.all()[i].surface] = static_cast<int32_t>(i);
    const Surface& surface = scene.surfaces[lights_.all()[i].surface];
    if (surface.goal ||
        (surface.modifier == surface.material && scene.modifiers[surface.material].next == kNone))
      constantRadiance_[i] = sourceRadiance(scene, surface);
  }
  for (size_t i = 0; i < scene.surfaces.size(); ++i) {
    const Surface& s = scene.surfaces[i];
    const Material* material = scene.materialOf(s);
    if (scene.importance || !std::holds_alternative<Distant>(s.shape) || !material) continue;
    const auto radiance = sourceRadiance(*material);
    if (radiance && maxChannel(*radiance) > kNegligible) distant_.push_back(static_cast<int32_t>(i));
  }
  findScatterers(warn);
  if (options.ambientAccuracy > 0 && options.ambientBounces > 0 && options.ambientDivisions > 0)
    prepareInterpolation(warn);
  const bool including = !options.ambientIncluded.empty();
  const auto& names = including ? options.ambientIncluded : options.ambientExcluded;
  if (names.empty()) return;
  ambient_.resize(scene.surfaces.size());
  for (size_t i = 0; i < scene.surfaces.size(); ++i)
    ambient_[i] = (std::find(names.begin(), names.end(), scene.modifierName(scene.surfaces[i])) !=
                   names.end()) == including;
}

void Transport::prepareInterpolation(const rad::Warn& warn) {
  const Box3d& bounds = tracer_.bounds();
  if (!scene_.importance) {
    PathTracer probe(*this);
    auto openings = std::make_unique<Openings>(scene_, bounds,
                                               [&](const V3d& origin, const V3d& direction, uint64_t seed) {
                                                 return brightness(probe.glimpse(origin, direction, seed));
                                               });
    if (!openings->empty()) openings_ = std::move(openings);
  }
  field_ = std::make_unique<IrradianceField>(scene_, bounds, options_);
  if (options_.ambientBounces > 1) {
    coarse_ = std::make_unique<CoarseSolution>(scene_, bounds, options_);
    auto spots = std::make_unique<BrightSpots>(scene_, tracer_, lights_, openings_.get());
    if (!spots->empty()) spots_ = std::move(spots);
  }
  if (!options_.ambientFile.empty())
    field_->keepIn(AmbientFile::openBeside(options_.ambientFile, fingerprint(scene_),
                                           fingerprint(options_, basicRadiance_, scene_.files), warn));
}

bool Transport::glows(std::span<const Surface> surfaces) const {
  return std::any_of(surfaces.begin(), surfaces.end(), [&](const Surface& surface) {
    const Material* material = scene_.materialOf(surface);
    const auto* glow = material ? std::get_if<Glow>(material) : nullptr;
    return glow && !isBlack(glow->radiance);
  });
}

bool Transport::isDark() const {
  return !scene_.importance && lights_.all().empty() && isBlack(options_.ambientValue) &&
         !glows(scene_.surfaces);
}

bool Transport::lacksSources() const {
  return !scene_.importance && lights_.all().empty() &&
         !(options_.ambientBounces > 0 && glows(scene_.outermost()));
}

Ray PathTracer::trace(const V3d& origin, const V3d& direction, double farthest, uint64_t seed) {
  random_ = Random(seed);
  primaryDirection_ = direction;
  shown_ = {};
  firstHit_ = {};
  Ray ray;
  ray.medium = t_.medium();
  ray.origin = origin;
  ray.direction = direction;
  if (t_.irradiance() == Irradiance::point) {
    ray.length = ray.unmirroredLength = kMeterLength;
    ray.point = origin + kMeterLength * direction;
    ray.normal = -direction;
    shadeMaterial(ray, kIrradianceMeter, kNone);
  } else {
    ray.farthest = farthest;
    evaluate(ray);
  }
  if (t_.field()) t_.field()->leave(fieldReader_);
  return ray;
}

Rgb PathTracer::glimpse(const V3d& origin, const V3d& direction, uint64_t seed) {
  random_ = Random(seed);
  Ray ray;
  ray.medium = t_.medium();
  ray.origin = origin;
  ray.direction = direction;
  ray.kind = kReflectedAmbient;
  ray.kinds = kPrimary | kReflectedAmbient;
  ray.ambientLevel = t_.options().ambientBounces - 1;
  evaluate(ray);
  return ray.value;
}

Ray PathTracer::cast(const V3d& origin, const V3d& direction, double farthest) {
  Ray ray;
  ray.origin = origin;
  ray.direction = direction;
  ray.farthest = farthest;
  findHit(ray);
  return ray;
}

// Makes child a descendant of parent, or returns false where the path ends. coefficient: of the child's
// radiance in the parent's; raised where the path survived Russian roulette, so that the mean stays right.
bool PathTracer::continueRay(Ray& child, RayKind kind, const Ray& parent, Rgb& coefficient) {
  const RayOptions& o = t_.options();
  inherit(child, parent, kind);
  if (kind & kReflections) {
    ++child.level;
    child.farthest = 0;
    if (kind == kReflected && !(parent.kinds & ~(kPrimary | kTransmitted)) && parent.surface != kNone &&
        static_cast<size_t>(parent.surface) < t_.scene().outermost().size() &&
        planeNormal(t_.scene().surfaces[parent.surface].shape))
      child.mirror = parent.surface;
  } else {
    child.mirror = parent.mirror;
    child.aimedAt = parent.aimedAt;
    child.farthest = parent.farthest > kSamePlace ? parent.farthest - parent.length : 0;
  }
  child.contribution *= coefficient;
  child.weight = parent.weight * std::min(1., maxChannel(coefficient));
  const Rgb& extinction = parent.medium.extinction;
  const double depth = std::min({extinction.x, extinction.y, extinction.z}) * parent.length;
  if (depth > .1) child.weight *= std::exp(-depth);
  if (!(child.weight > 0)) return false;
  if (child.kinds & kShadow) return true;
  if (o.reflectionLimit > 0) return child.weight >= o.weightLimit && child.level <= o.reflectionLimit;
  if (!(o.weightLimit > 0))
    throw rad::Error("zero ray weight in Russian roulette: -lw must be positive where -lr is not");
  if (o.reflectionLimit < 0 && child.level > -o.reflectionLimit) return false;
  if (child.weight >= o.weightLimit) return true;
  if (random_.uniform() * o.weightLimit > child.weight) return false;
  coefficient *= o.weightLimit / child.weight;
  child.contribution *= o.weightLimit / child.weight;
  child.weight = o.weightLimit;
  return true;
}

void PathTracer::evaluate(Ray& ray) {
  checkDepth(ray);
  findHit(ray);
  if (ray.surface != kNone) shadeHit(ray);
  finish(ray);
}

void PathTracer::findHit(Ray& ray) {
  if (ray.unobstructed) return findTarget(ray);
  const Hit hit =
      t_.tracer().nearest(ray.origin, ray.direction, ray.farthest > kSamePlace ? ray.farthest : kFarAway,
                          ray.parent ? ray.parent->surface : kNone);
  if (ray.depth == 0) firstHit_ = hit;
  ray.surface = hit.surface;
  ray.point = ray.origin;
  ray.normal = -ray.direction;
  ray.cosine = 1;
  if (hit.surface != kNone) {
    ray.length = hit.distance;
    ray.point = along(ray.origin, hit.distance, ray.direction);
    ray.normal = hit.normal;
    ray.cosine = hit.cosine;
    ray.perturbation = hit.perturbation;
    ray.u = hit.u;
    ray.v = hit.v;
    ray.path = hit.path;
  } else if (ray.farthest > kSamePlace) {
    ray.point = along(ray.origin, ray.farthest, ray.direction);
  } else {
    seesDistant(ray);
  }
}

// The surface that a shadow ray is aimed at, whatever else is in its way.
void PathTracer::findTarget(Ray& ray) {
  const Scene& scene = t_.scene();
  const LightSource& target = t_.lights().all()[ray.aimedAt];
  ray.point = ray.origin;
  ray.normal = -ray.direction;
  ShapeHit hit;
  if (target.distant && !target.isVirtual()) {
    seesDistant(ray);
  } else if (intersect(scene.surfaces[target.surface].shape, scene.vertices, ray.origin, ray.direction,
                       kFarAway, hit)) {
    ray.surface = target.surface;
    ray.length = hit.distance;
    ray.point = along(ray.origin, hit.distance, ray.direction);
    ray.normal = hit.normal;
    ray.cosine = hit.cosine;
  }
}

// A distant source in the ray's direction. The first one that is not glow hides the others; illum that lets
// light pass and glow give way, and glow is what is left.
bool PathTracer::seesDistant(Ray& ray) {
  const Scene& scene = t_.scene();
  const auto sees = [&](int32_t surface) {
    return std::get<Distant>(scene.surfaces[surface].shape).isSeenAlong(ray.direction);
  };
  if (ray.aimedAt != kNone) {
    const LightSource& light = t_.lights().all()[ray.aimedAt];
    if (light.distant && !light.isVirtual() && sees(light.surface)) ray.surface = light.surface;
    return ray.surface != kNone;
  }
  int32_t glow = kNone;
  bool passedIllum = false;
  for (const int32_t s : t_.distant()) {
    if (!sees(s)) continue;
    const Material& material = *scene.materialOf(scene.surfaces[s]);
    if (std::holds_alternative<Glow>(material)) {
      if (glow == kNone) glow = s;
    } else if (const auto* illum = std::get_if<Illum>(&material);
               illum && illum->alternate.kind != Alternate::Kind::modifier) {
      passedIllum = true;
    } else {
      ray.surface = s;
      return true;
    }
  }
  // Indirect rays through a distant illum would count again what it stands for.
  if (passedIllum && (ray.kinds & (kAmbient | kSpecular))) return false;
  ray.surface = glow;
  return glow != kNone;
}

// The ray goes on as if it had hit nothing.
void PathTracer::pass(Ray& ray) {
  Ray child;
  inherit(child, ray, kTransmitted);
  passOn(child, ray);
}

// child: what ray becomes beyond the surface, straight on and with all its weight.
void PathTracer::passOn(Ray& child, Ray& ray) {
  child.direction = ray.direction;
  child.aimedAt = ray.aimedAt;
  child.mirror = ray.mirror;
  child.weight = ray.weight;
  double length = ray.length;
  const auto shorten = [&](double by) {
    if (ray.farthest > kSamePlace) child.farthest = std::max(ray.farthest - by, 2 * kSamePlace);
  };
  shorten(length);
  checkDepth(child);
  findHit(child);
  // Surfaces of nothing at all are gone through here, however many there are, rather than one inside the
  // other, unless each is to be shown.
  while (!observer_ && child.surface != kNone && t_.scene().surfaces[child.surface].modifier == kNone &&
         child.length < kFarAway && !isMedium(child.medium.extinction)) {
    length += child.length;
    child.pathLength += child.length;
    if (child.kinds & kShadow) child.shadowLength += child.length;
    child.origin = child.point;
    shorten(length);
    child.length = kFarAway;
    findHit(child);
  }
  if (child.surface != kNone) shadeHit(child);
  finish(child);
  ray.value = child.value;
  ray.mirrored = child.mirrored;
  ray.mirroredLength = length + child.mirroredLength;
  ray.unmirroredLength = length + child.unmirroredLength;
}

void PathTracer::finish(Ray& ray) {
  // Not those that only ask what light there would be; shadow rays that meet nothing have just missed their
  // source, by rounding.
  if (observer_ && !ray.unobstructed && (ray.aimedAt == kNone || ray.surface != kNone)) observer_(ray);
  participate(ray);
}

RayAnswer answerOf(const Scene& scene, const Ray& ray) {
  RayAnswer a;
  a.origin = ray.origin;
  a.direction = ray.direction;
  a.value = ray.value;
  a.mirroredContribution = ray.mirrored;
  a.unmirroredContribution = ray.value - ray.mirrored;
  a.mirroredLength = ray.mirroredLength;
  a.unmirroredLength = ray.unmirroredLength;
  a.effectiveLength = apparentLength(ray);
  a.firstLength = ray.length;
  a.u = ray.u;
  a.v = ray.v;
  a.point = ray.point;
  if (ray.surface == kNone) return a;
  const Surface& surface = scene.surfaces[ray.surface];
  a.unperturbedNormal = ray.fromBehind != ray.insideOut ? -ray.normal : ray.normal;
  a.normal = ray.normal;
  if (ray.perturbation.length2() > 0) {
    // What has no material has not been turned to the ray.
    const double side = ray.cosine < 0 ? -1 : 1;
    Interaction at;
    at.direction = ray.direction;
    at.normal = side * ray.normal;
    at.cosine = side * ray.cosine;
    at.perturbation = side * ray.perturbation;
    double cosine = 0;
    a.normal = side * perturbedNormal(at, cosine);
  }
  a.surface = scene.surfaceName(surface);
  a.modifier = scene.modifierName(surface);
  a.material = scene.materialName(surface);
  return a;
}

RayAnswer branchAnswer(const Transport& transport, const Ray& ray) {
  RayAnswer a = answerOf(transport.scene(), ray);
  a.rayWeight = ray.weight;
  a.contribution = ray.contribution * passedBy(ray);
  const bool dark = ray.value.x + ray.value.y + ray.value.z <= 3 * kNegligible;
  if (ray.aimedAt != kNone && dark && transport.lights().all()[ray.aimedAt].surface != ray.surface)
    a.contribution = Rgb(0, 0, 0);
  return a;
}

bool needsValue(std::string_view letters) {
  return letters.find_first_of("vVrxlRXnW") != std::string_view::npos;
}

}  // namespace rsphere
