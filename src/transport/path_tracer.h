#pragma once
// Radiance along a ray. It consists of emission, direct light from the sources (direct_light.h), sharp
// reflections and refractions, samples of rough ones (specular_light.h), and indirect light
// (indirect_light.h), all attenuated by the medium along the ray (participating_media.h). surface_shading.h
// adds these up for the material that a ray hits. Paths end after -ab diffuse bounces, and according to -lr
// and -lw (ray_limits.h).
#include <memory>
#include <vector>

#include "rays/path_observer.h"
#include "rays/prepared_scene.h"
#include "transport/path_state.h"

namespace rsphere {

// Traces one ray at a time; each thread needs its own tracer. The answer depends only on the ray, the seed,
// the prepared scene, the aims and the mode.
class PathTracer {
 public:
  // Keeps references to the scene and the caches. If the caches are null, nothing is interpolated. aims: for
  // all gathers except those that fill the caches.
  PathTracer(const PreparedScene& prepared, const Caches& caches, const Aims& aims,
             const TracingMode& mode = {});
  ~PathTracer();
  PathTracer(PathTracer&&) noexcept;

  // Radiance along a primary ray (W/sr/m2), or irradiance (W/m2) according to PreparedScene::irradiance: on
  // the surface that is hit (-i), or on a fictitious surface just ahead of the origin that faces the ray (-I;
  // see inputRay()). direction: unit. farthest: limit on the distance (-ld, world units); 0: none. The seed
  // determines all random numbers of the path. Throws rad::Error
  // - if a path passes more than 20500 surfaces in succession,
  // - if it passes more surfaces than this thread's stack has room for (at most 2 kB each),
  // - if Russian roulette has no weight limit to compare with (-lw 0).
  TracedRay trace(const V3d& origin, const V3d& direction, double farthest, uint64_t seed,
                  const PathRequest& request = {});

  // Radiance along a primary ray to a light source, equal to the result of trace(). It takes only a shadow
  // ray if no surface in between may transmit light. TracedRay::shown indicates whether the source is visible
  // along the ray.
  TracedRay traceToSource(const V3d& point, const SourceSample& sample, uint64_t seed,
                          const PathRequest& request = {});

  // A rough estimate of the radiance (W/sr/m2) along a ray, with at most one further diffuse bounce. Each
  // gather sends one ray, and few light sources are sampled.
  Radiance glimpse(const V3d& origin, const V3d& direction, uint64_t seed);

  // The light beyond portals: OutdoorRadiance and OutdoorParts (sky_emission.h). Each gather sends one ray.
  Radiance outdoors(const V3d& origin, const V3d& direction, int bounces, uint64_t seed);
  void outdoors(const V3d& origin, const V3d& direction, int bounces, uint64_t seed,
                std::vector<Radiance>& parts);

  // Finds the surface that a ray hits, without its radiance: value is 0.
  TracedRay cast(const V3d& origin, const V3d& direction, double farthest);

 private:
  class Path;
  std::unique_ptr<Path> path_;
};

// Traces paths from one point that share one request.
class PathsFrom {
 public:
  // point: world. Keeps a reference to the tracer.
  PathsFrom(PathTracer& tracer, const V3d& point, const PathRequest& request = {})
      : tracer_(tracer), point_(point), request_(request) {}

  const V3d& point() const { return point_; }
  PathTracer& tracer() const { return tracer_; }
  TracedRay trace(const V3d& direction, uint64_t seed) const {
    return tracer_.trace(point_, direction, 0, seed, request_);
  }
  TracedRay traceToSource(const SourceSample& sample, uint64_t seed) const {
    return tracer_.traceToSource(point_, sample, seed, request_);
  }

 private:
  PathTracer& tracer_;
  V3d point_;
  PathRequest request_;
};

}  // namespace rsphere
