#include "transport/path_tracer.h"

#include <fmt/format.h>
#include <pthread.h>

#include <algorithm>
#include <cstdint>

#include "transport/participating_media.h"
#include "transport/ray_functions.h"
#include "transport/ray_hit.h"
#include "transport/ray_limits.h"
#include "transport/surface_shading.h"

namespace rsphere {
namespace {

// -I: distance (world units) from the ray's origin to its imagined surface, as in rtrace.
constexpr double kMeterLength = 1e-5;

// The maximal depth of the recursion. It takes at most 40 MB of stack; runRecords() gives its threads more.
constexpr int kDeepest = 20500;
// Stack (bytes) that the work at one surface may need, including a ray through nested octrees.
constexpr uintptr_t kStackReserve = 512 << 10;

// The lowest address of this thread's stack. The system is asked once per thread.
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

}  // namespace

// The recursion and its parts.
class PathTracer::Path final : public RayFollower {
 public:
  Path(const PreparedScene& prepared, const PathSettings& settings)
      : t_(prepared),
        settings_(settings),
        direct_(prepared, settings_, state_, *this),
        specular_(prepared, settings_, state_, *this),
        interpolated_(prepared, settings_, state_, *this),
        indirect_(prepared, settings_, state_, *this, interpolated_),
        media_(prepared, state_, direct_),
        shading_(prepared, settings_, state_, *this, direct_, specular_, indirect_) {}

  TracedRay trace(const V3d& origin, const V3d& direction, double farthest, uint64_t seed,
                  const PathRequest& request);
  TracedRay traceToSource(const V3d& point, const SourceSample& sample, uint64_t seed,
                          const PathRequest& request);
  Radiance glimpse(const V3d& origin, const V3d& direction, uint64_t seed);
  Ray cast(const V3d& origin, const V3d& direction, double farthest);

  void follow(Ray& ray) override;
  void pass(Ray& ray) override;
  void passOn(Ray& child, Ray& ray) override;
  bool shade(Ray& ray, ModifierId modifier) override { return shading_.shade(ray, modifier); }
  InnerPath beginGather(uint64_t seed, const V3d& normal) override;

 private:
  void begin(uint64_t seed, const V3d& direction, const PathRequest& request = {}) {
    state_ = {};
    state_.request = request;
    state_.random = Random(seed);
    state_.primaryDirection = direction;
    state_.descendants = descendantsOfPrimary(
        settings_.mode, t_.options().ambientDivisions + t_.options().ambientSuperSamples);
  }
  void end(TracedRay& ray) const {
    ray.firstHit = state_.firstHit;
    ray.shown = state_.shown;
    ray.leftOut = state_.leftOut;
  }
  void find(Ray& ray);
  void finish(Ray& ray);

  const PreparedScene& t_;
  const PathSettings settings_;
  PathState state_;
  DirectLight direct_;
  SpecularLight specular_;
  InterpolatedLight interpolated_;
  IndirectLight indirect_;
  ParticipatingMedia media_;
  SurfaceShading shading_;
  std::unique_ptr<Path> gatherer_;  // a gather is a path of its own, within this one
};

TracedRay PathTracer::Path::trace(const V3d& origin, const V3d& direction, double farthest, uint64_t seed,
                                  const PathRequest& request) {
  begin(seed, direction, request);
  TracedRay ray;
  ray.medium = t_.medium();
  ray.origin = origin;
  ray.direction = direction;
  if (t_.irradiance() == IrradianceAt::point) {
    ray.length = ray.unmirroredLength = kMeterLength;
    ray.point = origin + kMeterLength * direction;
    ray.normal = -direction;
    shading_.meter(ray);
  } else {
    ray.farthest = farthest;
    follow(ray);
  }
  interpolated_.endPath();
  end(ray);
  return ray;
}

TracedRay PathTracer::Path::traceToSource(const V3d& point, const SourceSample& sample, uint64_t seed,
                                          const PathRequest& request) {
  begin(seed, sample.direction, request);
  const LightSource& light = t_.lights().all()[sample.source];
  TracedRay ray;
  switch (t_.tracer().shadow(point, sample.direction, sample.distance,
                             light.isDistant() ? kNone : light.surface)) {
    case Shadow::unsure:
    case Shadow::refracted:
      return trace(point, sample.direction, 0, seed, request);
    case Shadow::blocked:
      break;
    case Shadow::clear: {
      ray.origin = point;
      ray.direction = sample.direction;
      ray.surface = light.surface;
      ray.length = ray.unmirroredLength = sample.distance;
      if (!light.isDistant()) ray.point = point + sample.distance * sample.direction;
      ray.normal = sample.normal;
      ray.cosine = sample.cosine;
      ray.medium = t_.medium();
      shading_.shadeSurface(ray);
      media_.participate(ray);
      end(ray);
      break;
    }
  }
  return ray;
}

Radiance PathTracer::Path::glimpse(const V3d& origin, const V3d& direction, uint64_t seed) {
  begin(seed, direction);
  state_.glimpses = true;
  Ray ray;
  ray.medium = t_.medium();
  ray.origin = origin;
  ray.direction = direction;
  ray.kind = kReflectedAmbient;
  ray.kinds = kPrimary | kReflectedAmbient;
  ray.ambientLevel = t_.options().ambientBounces - 1;
  follow(ray);
  return ray.value;
}

Ray PathTracer::Path::cast(const V3d& origin, const V3d& direction, double farthest) {
  Ray ray;
  ray.origin = origin;
  ray.direction = direction;
  ray.farthest = farthest;
  find(ray);
  return ray;
}

void PathTracer::Path::follow(Ray& ray) {
  checkDepth(ray);
  find(ray);
  if (ray.surface != kNone) shading_.shadeHit(ray);
  finish(ray);
}

void PathTracer::Path::pass(Ray& ray) {
  Ray child;
  inherit(child, ray, kTransmitted);
  passOn(child, ray);
}

void PathTracer::Path::passOn(Ray& child, Ray& ray) {
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
  find(child);
  // Any number of surfaces without a modifier is passed in this loop instead of by recursion, unless an
  // observer is to be shown each of them.
  while (!state_.request.observer && child.surface != kNone &&
         t_.scene().surfaces[child.surface].modifier == kNone && child.length < kFarAway &&
         !isMedium(child.medium.extinction)) {
    length += child.length;
    child.pathLength += child.length;
    if (child.kinds & kShadow) child.shadowLength += child.length;
    child.origin = child.point;
    shorten(length);
    child.length = kFarAway;
    find(child);
  }
  if (child.surface != kNone) shading_.shadeHit(child);
  finish(child);
  ray.value = child.value;
  ray.mirrored = child.mirrored;
  ray.mirroredLength = length + child.mirroredLength;
  ray.unmirroredLength = length + child.unmirroredLength;
}

void PathTracer::Path::finish(Ray& ray) {
  // Rays that only determine the light of an unobstructed source are not shown. Shadow rays that hit nothing
  // are not shown either: they miss their source by rounding errors.
  if (state_.request.observer && !ray.unobstructed && (ray.aimedAt == kNone || ray.surface != kNone))
    (*state_.request.observer)(ray);
  media_.participate(ray);
}

void PathTracer::Path::find(Ray& ray) {
  const Hit hit = findHit(t_, ray);
  if (ray.depth == 0) state_.firstHit = hit;
}

// Nested gathers each use another path.
InnerPath PathTracer::Path::beginGather(uint64_t seed, const V3d& normal) {
  if (!gatherer_)
    gatherer_ = std::make_unique<Path>(t_, PathSettings{settings_.caches, settings_.caches.aims, {}});
  gatherer_->begin(seed ^ rotationBits(t_.options()), normal);
  return {gatherer_->state_, gatherer_->settings_, *gatherer_};
}

PathTracer::PathTracer(const PreparedScene& prepared, const Caches& caches, const Aims& aims,
                       const TracingMode& mode)
    : path_(std::make_unique<Path>(prepared, PathSettings{caches, aims, mode})) {}
PathTracer::~PathTracer() = default;
PathTracer::PathTracer(PathTracer&&) noexcept = default;

TracedRay PathTracer::trace(const V3d& origin, const V3d& direction, double farthest, uint64_t seed,
                            const PathRequest& request) {
  return path_->trace(origin, direction, farthest, seed, request);
}
TracedRay PathTracer::traceToSource(const V3d& point, const SourceSample& sample, uint64_t seed,
                                    const PathRequest& request) {
  return path_->traceToSource(point, sample, seed, request);
}
Radiance PathTracer::glimpse(const V3d& origin, const V3d& direction, uint64_t seed) {
  return path_->glimpse(origin, direction, seed);
}
Ray PathTracer::cast(const V3d& origin, const V3d& direction, double farthest) {
  return path_->cast(origin, direction, farthest);
}

}  // namespace rsphere
