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

class BrightSpots;
class LocalGuess;

// Traces one ray at a time; each thread has a tracer of its own. The answer depends on the ray, the seed, and
// the transport alone.
class PathTracer {
 public:
  // Keeps references. spots: where indirect light is gathered and not interpolated, some directions are aimed
  // at them; null: none.
  explicit PathTracer(const Transport& transport, const BrightSpots* spots = nullptr);
  ~PathTracer();
  PathTracer(PathTracer&&) noexcept;

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

  // The radiance along a ray of which only the last diffuse bounce may be followed (W/sr/m2).
  Rgb glimpse(const V3d& origin, const V3d& direction, uint64_t seed);

  // Finds the surface that a ray hits; its value stays 0.
  Ray cast(const V3d& origin, const V3d& direction, double farthest);

  // The light source whose own light the last primary ray showed, at its end or straight on through panes
  // that shadow rays pass as well, mirrored at most once by a flat surface. Of several the one that was not
  // mirrored, or else the first.
  using Shown = ShownSource;
  const Shown& shown() const;

  // The first hit of the last primary ray, as Tracer::nearest found it.
  const Hit& firstHit() const;

  // From now on trace() shows every ray to the observer, descendants before their ancestors, the primary ray
  // last (but not under -I, where it meets nothing); Ray::depth counts its ancestors. Shadow rays are shown
  // where they meet something that might let light pass, and all that meet something if allShadowRays. No
  // answer changes by it. Null: none.
  void observe(RayObserver observer, bool allShadowRays = false);

  // From now on the radiance of indirect rays is guessed as well (radiance_guess.h), as a control variate:
  // for each one that is followed, several are only guessed. The expected value does not change; the value of
  // one ray may be negative. Null: nothing is guessed.
  void guessWith(const LocalGuess* guess);

  // From now on indirect light is gathered directly at the first diffuse surface even if -aa is above 0:
  // where thousands of directions are averaged, single rays reduce the error faster than sites. Later
  // surfaces still use the coarse solution.
  void gatherFirstAnew();

 private:
  class Path;
  std::unique_ptr<Path> path_;
};

}  // namespace rsphere
