#pragma once
// Radiance along a ray: emission, direct light from the sources (direct_light.h), sharp reflections and
// refractions and samples of rough ones (specular_light.h), and indirect light (indirect_light.h), attenuated
// by the medium on the way (participating_media.h). surface_shading.h adds these up for the material that a
// ray hits. Paths end after -ab diffuse bounces, and by -lr and -lw (ray_limits.h).
#include <memory>

#include "transport/path_observer.h"
#include "transport/path_state.h"
#include "transport/prepared_scene.h"

namespace rsphere {

// Traces one ray at a time; each thread needs its own tracer. The answer depends only on the ray, the seed,
// the prepared scene, the aims and the mode.
class PathTracer {
 public:
  // Keeps references to the scene and the caches; caches without fields: nothing is interpolated. aims: for
  // the gathers that do not serve the caches.
  PathTracer(const PreparedScene& prepared, const Caches& caches, const Aims& aims,
             const TracingMode& mode = {});
  ~PathTracer();
  PathTracer(PathTracer&&) noexcept;

  // Radiance along a primary ray (W/sr/m2), or irradiance (W/m2) if PreparedScene::irradiance asks for it: on
  // the surface that is hit, or on an imagined one just ahead that faces the ray (see inputRay() for where -I
  // starts). direction: unit. farthest: 0 for no limit (-ld, world units). The seed determines every random
  // number of the path. Throws rad::Error
  // - if a path passes through more than 20500 surfaces in succession,
  // - if it passes through more than this thread's stack has room for (at most 2 kB each),
  // - if Russian roulette has no weight limit to compare with (-lw 0).
  TracedRay trace(const V3d& origin, const V3d& direction, double farthest, uint64_t seed,
                  const PathRequest& request = {});

  // The radiance along a primary ray to a light source, equal to that of trace(). It costs one shadow ray if
  // no surface that may transmit light lies in between. TracedRay::shown says whether the ray showed the
  // source.
  TracedRay traceToSource(const V3d& point, const SourceSample& sample, uint64_t seed,
                          const PathRequest& request = {});

  // The radiance (W/sr/m2) along a ray after which at most one diffuse bounce is followed, in one direction.
  Radiance glimpse(const V3d& origin, const V3d& direction, uint64_t seed);

  // Finds the surface that a ray hits; its value stays 0.
  TracedRay cast(const V3d& origin, const V3d& direction, double farthest);

 private:
  class Path;
  std::unique_ptr<Path> path_;
};

// Traces paths from one point, all with the same request.
class PathsFrom {
 public:
  // point: world. Keeps a reference to the tracer.
  PathsFrom(PathTracer& tracer, const V3d& point, const PathRequest& request = {})
      : tracer_(tracer), point_(point), request_(request) {}

  const V3d& point() const { return point_; }
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
