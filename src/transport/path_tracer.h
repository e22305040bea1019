#pragma once
// Radiance along a ray: emission, direct light from the sources (direct_light.h), sharp reflections and
// refractions and samples of rough ones (specular_light.h), and indirect light (indirect_light.h), attenuated
// by the medium on the way (participating_media.h). surface_shading.h adds these up for the material that a
// ray hits. Paths end after -ab diffuse bounces, and by -lr and -lw (ray_limits.h).
#include <memory>

#include "transport/path_observer.h"
#include "transport/ray.h"
#include "transport/transport.h"

namespace rsphere {

class LocalGuess;

// Traces one ray at a time; each thread needs its own tracer. The answer depends only on the ray, the seed,
// and the transport.
class PathTracer {
 public:
  // Keeps references. aims: of directions where indirect light is gathered instead of interpolated.
  explicit PathTracer(const Transport& transport, const Aims& aims = {});
  ~PathTracer();
  PathTracer(PathTracer&&) noexcept;

  // Radiance along a primary ray (W/sr/m2), or irradiance (W/m2) if Transport::irradiance asks for it: on the
  // surface that is hit, or on an imagined one just ahead that faces the ray (see inputRay() for where -I
  // starts). direction: unit. farthest: 0 for no limit (-ld, world units). The seed determines every random
  // number of the path. Throws rad::Error
  // - if a path passes through more than 20500 surfaces in succession,
  // - if it passes through more than this thread's stack has room for (at most 2 kB each),
  // - if Russian roulette has no weight limit to compare with (-lw 0).
  Ray trace(const V3d& origin, const V3d& direction, double farthest, uint64_t seed);

  // The radiance along a primary ray to a light source, equal to that of trace(). It costs one shadow ray if
  // no surface that may transmit light lies in between. shown() says whether the ray showed the source.
  Ray traceToSource(const V3d& point, const SourceSample& sample, uint64_t seed);

  // The radiance (W/sr/m2) along a ray after which at most one diffuse bounce is followed, in one direction.
  Radiance glimpse(const V3d& origin, const V3d& direction, uint64_t seed);

  // Finds the surface that a ray hits; its value stays 0.
  Ray cast(const V3d& origin, const V3d& direction, double farthest);

  // The light source that the last primary ray showed: one that it hit, directly or straight through panes that
  // also transmit shadow rays, after at most one reflection by a flat surface; a distant one also through slabs of
  // parallel faces. If there are several, the one that was not mirrored, otherwise the first.
  using Shown = ShownSource;
  const Shown& shown() const;

  // The first hit of the last primary ray, as Tracer::nearest found it.
  const Hit& firstHit() const;

  // From now on trace() shows every ray to the observer: descendants before their ancestors, and the primary
  // ray last (except under -I, where it hits nothing). Shadow rays are shown if they hit a surface that may
  // transmit light, or any surface if allShadowRays. This changes no answer. Null: no observer.
  void observe(RayObserver observer, bool allShadowRays = false);

  // From now on a guess of the radiance of indirect rays (radiance_guess.h) is used as a control variate: for
  // each indirect ray that is followed, several are only guessed. The expected value does not change, but the
  // value of one ray may be negative. Null: nothing is guessed.
  void guessWith(const LocalGuess* guess);

  // Whether the light of sources in rough highlights is divided between shadow rays and samples of the lobes
  // (shared_highlights.h). The mean stays the same.
  void shareHighlights(bool share);

  // Whether the rays that one primary ray may spawn have a bound, so that a record takes a bounded time wherever it
  // lies: within a closed metal cylinder paths would branch at each surface, into thousands of rays. Beyond
  // tuning::BoundedPath::kRays rays, weak ones are followed by Russian roulette. The mean stays the same.
  void boundWork(bool bound);

  // Whether, with -aa above 0, the coarse solution gives the indirect light of the first diffuse surface as it
  // does that of later ones: if thousands of directions are averaged, the errors of single patches matter less than
  // what a gather at each surface costs. In a picture patches would be visible.
  void useCoarseSolutionAtFirst(bool use);

 private:
  class Path;
  std::unique_ptr<Path> path_;
};

}  // namespace rsphere
