#include "transport/path_tracer.h"

#include <fmt/format.h>
#include <pthread.h>

#include <algorithm>
#include <cstdint>

#include "base/stop_check.h"
#include "rays/ray_functions.h"
#include "rays/ray_hit.h"
#include "transport/participating_media.h"
#include "transport/ray_limits.h"
#include "transport/surface_shading.h"

namespace rsphere {
namespace {

// With -I: distance of the fictitious surface from the ray's origin, as in rtrace, which uses 1e-5; in small
// scenes it is less (world units).
double meterLength(const Scene& scene) { return 1e-5 * (scene.samePlace / kSamePlace); }

// Cap on the depth of the recursion, which then takes at most 40 MB of stack. Threads of runRecords() have
// more.
constexpr int kDeepest = 20500;
// Stack (bytes) that processing one surface may take, including a ray through nested octrees.
constexpr uintptr_t kStackReserve = 512 << 10;

// The lowest address of this thread's stack. The system is only queried once per thread.
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

void checkDepth(const PathContext& ray) {
  if (ray.depth > kDeepest)
    throw rad::Error(fmt::format("a ray goes through more than {} surfaces one after the other", kDeepest));
  if (reinterpret_cast<uintptr_t>(__builtin_frame_address(0)) < stackEnd() + kStackReserve)
    throw rad::Error(
        fmt::format("a ray goes through {} surfaces one after the other, and the stack of its thread is "
                    "full: allow a larger one (ulimit -s)",
                    ray.depth),
        rad::Status::system);
}

// Whether a finished ray has hit a light source whose light no other ray brings. This excludes illums,
// because a ray sees the objects that they replace, and shadow rays that hit anything other than their
// source.
bool bringsLight(const PreparedScene& prepared, const RayEnd& end) {
  if (end.hit.surface == kNone) return false;
  const LightId aimedAt = end.ray.aimedAt;
  if (aimedAt != kNone) return prepared.lights().all()[aimedAt].surface == end.hit.surface;
  const Material* const material = prepared.scene().materialOf(prepared.scene().surfaces[end.hit.surface]);
  return material && isLightSource(*material) && !std::holds_alternative<Illum>(*material);
}

}  // namespace

// Implements the recursion, and owns the parts of the path tracer.
class PathTracer::Path final : public RayFollower {
 public:
  Path(const PreparedScene& prepared, const PathSettings& settings)
      : t_(prepared),
        settings_(settings),
        shading_({prepared, settings_, state_, *this}),
        media_(prepared, state_, shading_.light().direct) {}

  void begin(uint64_t seed, const V3d& direction, const PathRequest& request = {}) {
    StopCheck::here();
    state_ = {};
    state_.request = request;
    state_.random = Random(seed);
    state_.primaryDirection = direction;
    state_.descendants = descendantsOfPrimary(
        settings_.mode, t_.options().ambientDivisions + t_.options().ambientSuperSamples);
  }
  TracedRay traced(const RayEnd& end, const RayResult& result) const;
  // The context of a primary ray.
  PathContext context() const {
    PathContext primary;
    primary.space.medium = t_.options().medium();
    if (state_.request.vertexLight) primary.known = Known::joined;
    return primary;
  }

  // The surface on which a primary ray starts. In ray mode, as in rtrace, it passes surfaces at its origin.
  SurfaceId begins() const { return isRayMode(settings_.mode) ? SurfaceId() : kInSpace; }

  Radiance glimpse(const V3d& origin, const V3d& direction, int bounces, uint64_t seed,
                   const PathRequest& request = {});

  using RayFollower::follow;
  RayResult follow(RayEnd& end) override;
  RayResult passOn(NextRay& next, const RayEnd& before) override;
  bool shade(RayEnd& end, ModifierId modifier, RayResult& result) override {
    return shading_.shadeChain(end, modifier, result);
  }
  InnerPath beginGather(uint64_t seed, const V3d& normal) override;

 private:
  friend class PathTracer;

  void find(RayEnd& end) {
    const Hit nearest = findHit(t_, end);
    if (end.context.depth == 0) state_.firstHit = nearest;
  }
  RayResult arrive(RayEnd& end);

  const PreparedScene& t_;
  const PathSettings settings_;
  PathState state_;
  SurfaceShading shading_;
  ParticipatingMedia media_;
  std::unique_ptr<Path> gatherer_;  // traces gathers, each as a separate path
};

// ---- the recursion

RayResult PathTracer::Path::follow(RayEnd& end) {
  checkDepth(end.context);
  find(end);
  return arrive(end);
}

RayResult PathTracer::Path::passOn(NextRay& next, const RayEnd& before) {
  double length = before.hit.length;
  const auto shorten = [&] {
    if (const double least = t_.scene().samePlace; before.ray.farthest > least)
      next.query.farthest = std::max(before.ray.farthest - length, 2 * least);
  };
  shorten();
  checkDepth(next.context);
  RayEnd end(next.query, next.context);
  find(end);
  // Surfaces without a modifier are passed in this loop instead of by recursion, so that their number is not
  // limited, unless an observer has to be called for each.
  while (!state_.request.observer && end.hit.surface != kNone &&
         t_.scene().surfaces[end.hit.surface].modifier == kNone && end.hit.length < kFarAway &&
         !isMedium(next.context.space.medium.extinction)) {
    length += end.hit.length;
    next.context.pathLength += end.hit.length;
    if (next.context.kinds & kShadow) next.context.shadowLength += end.hit.length;
    next.query.origin = end.hit.point;
    shorten();
    end.hit = {};
    find(end);
  }
  RayResult result = arrive(end);
  result.mirroredLength = length + result.mirroredLength;
  result.unmirroredLength = length + result.unmirroredLength;
  return result;
}

// The result of a ray whose hit is known.
[[gnu::always_inline]] inline RayResult PathTracer::Path::arrive(RayEnd& end) {
  RayResult result;
  if (end.context.known != Known::no && shading_.light().endsAtPortal(end)) return result;
  if (const SurfaceId surface = end.hit.surface; surface != kNone) {
    result.unmirroredLength = end.hit.length;
    if (!shading_.shade(end, result) && !t_.scene().surfaces[surface].shape.as<Distant>()) result = pass(end);
  }
  // The observer is not called for rays that only determine the light of an unoccluded source. Nor is it
  // called for shadow rays that hit nothing, which miss their source only because of rounding errors.
  if (state_.request.observer && !end.ray.unobstructed &&
      (end.ray.aimedAt == kNone || end.hit.surface != kNone))
    (*state_.request.observer)(end, result);
  media_.participate(end, result.value);
  return result;
}

// Each level of nested gathers uses a separate Path.
InnerPath PathTracer::Path::beginGather(uint64_t seed, const V3d& normal) {
  if (!gatherer_)
    gatherer_ = std::make_unique<Path>(
        t_, PathSettings{settings_.caches, settings_.caches.aims, {.solution = settings_.mode.solution}});
  gatherer_->begin(seed ^ rotationBits(t_.options()), normal);
  return {gatherer_->state_, gatherer_->settings_, *gatherer_};
}

PathTracer::PathTracer(const PreparedScene& prepared, const Caches& caches, const Aims& aims,
                       const TracingMode& mode)
    : path_(std::make_unique<Path>(prepared, PathSettings{caches, aims, mode})) {}
PathTracer::~PathTracer() = default;
PathTracer::PathTracer(PathTracer&&) noexcept = default;

// ---- primary rays

TracedRay PathTracer::Path::traced(const RayEnd& end, const RayResult& result) const {
  TracedRay ray(end, result);
  ray.firstHit = state_.firstHit;
  ray.shown = state_.shown;
  ray.leftOut = state_.leftOut;
  ray.gathers = state_.gathers;
  return ray;
}

TracedRay PathTracer::trace(const V3d& origin, const V3d& direction, double farthest, uint64_t seed,
                            const PathRequest& request) {
  path_->begin(seed, direction, request);
  const bool meters = path_->t_.irradiance() == IrradianceAt::point;
  const RayQuery ray{
      .origin = origin, .direction = direction, .farthest = meters ? 0 : farthest, .from = path_->begins()};
  const PathContext context = path_->context();
  RayEnd end(ray, context);
  RayResult result;
  if (meters) {
    end.hit.length = result.unmirroredLength = meterLength(path_->t_.scene());
    end.hit.point = origin + end.hit.length * direction;
    end.hit.normal = -direction;
    path_->shading_.meter(end, result);
  } else {
    result = path_->follow(end);
  }
  path_->shading_.light().indirect.endPath();
  return path_->traced(end, result);
}

TracedRay PathTracer::traceToSource(const V3d& point, const SourceSample& sample, uint64_t seed,
                                    const PathRequest& request) {
  const PreparedScene& prepared = path_->t_;
  const LightSource& light = prepared.lights().all()[sample.source];
  const Shadow shadow =
      prepared.tracer().shadow(point, sample.direction, sample.distance,
                               light.isDistant() ? kNone : light.surface, nullptr, path_->begins());
  if (shadow == Shadow::blocked) return {};
  if (shadow != Shadow::clear) return trace(point, sample.direction, 0, seed, request);
  path_->begin(seed, sample.direction, request);
  const RayQuery ray{.origin = point, .direction = sample.direction};
  const PathContext context = path_->context();
  RayEnd end(ray, context);
  putAtSource(end, light, sample);
  RayResult result;
  result.unmirroredLength = sample.distance;
  path_->shading_.shade(end, result);
  path_->media_.participate(end, result.value);
  return path_->traced(end, result);
}

Radiance PathTracer::Path::glimpse(const V3d& origin, const V3d& direction, int bounces, uint64_t seed,
                                   const PathRequest& request) {
  begin(seed, direction, request);
  state_.glimpses = true;
  PathContext ray = context();
  ray.kind = kReflectedAmbient;
  ray.kinds = kPrimary | kReflectedAmbient;
  ray.ambientLevel = bounces;
  state_.descendants = descendantsOfGlimpse(bounces);
  return follow({.origin = origin, .direction = direction}, ray).value;
}

Radiance PathTracer::glimpse(const V3d& origin, const V3d& direction, uint64_t seed) {
  return path_->glimpse(origin, direction, path_->t_.options().ambientBounces - 1, seed);
}

Radiance PathTracer::outdoors(const V3d& origin, const V3d& direction, int bounces, uint64_t seed) {
  return path_->glimpse(origin, direction, bounces, seed);
}

void PathTracer::outdoors(const V3d& origin, const V3d& direction, int bounces, uint64_t seed,
                          std::vector<Radiance>& parts) {
  parts.assign(static_cast<size_t>(path_->t_.options().ambientBounces - bounces + 1), Radiance());
  const RayObserver add = [&](const RayEnd& end, const RayResult& result) {
    if (bringsLight(path_->t_, end))
      parts[static_cast<size_t>(end.context.ambientLevel - bounces)] +=
          result.value * (end.context.contribution * passedBy(end));
  };
  path_->glimpse(origin, direction, bounces, seed, {.observer = &add, .shadows = ShownShadows::thatArrive});
}

TracedRay PathTracer::cast(const V3d& origin, const V3d& direction, double farthest) {
  const RayQuery ray{.origin = origin, .direction = direction, .farthest = farthest};
  const PathContext context;
  RayEnd end(ray, context);
  path_->find(end);
  return TracedRay(end, {});
}

}  // namespace rsphere
