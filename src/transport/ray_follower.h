#pragma once
// The path tracer's recursion as an interface for its parts: they choose directions that light may come from,
// and request the radiance along them.
#include "transport/ray_functions.h"

namespace rsphere {

struct PathSettings;
struct PathState;
class RayFollower;

// A path within another one: it begins with a new state, and does not depend on the path that requested it.
struct InnerPath {
  PathState& state;
  const PathSettings& settings;
  RayFollower& follower;
};

class RayFollower {
 public:
  // The radiance along a ray, at its origin. It is found where the ray ends, and attenuated on the way.
  RayResult follow(const RayQuery& ray, const PathContext& context) {
    RayEnd end(ray, context);
    return follow(end);
  }
  // The same; sets the hit of the ray's end too.
  virtual RayResult follow(RayEnd& end) = 0;

  // The radiance that arrives from behind the surface that a ray hit, as if the surface were not there.
  RayResult pass(const RayEnd& end) {
    NextRay next = straightOn(end);
    return passOn(next, end);
  }
  // The same along a given continuation of the ray, which may enter another medium.
  virtual RayResult passOn(NextRay& next, const RayEnd& end) = 0;

  // Shades the end of a ray that hit a surface with a chain of modifiers (index in Scene::modifiers). False,
  // with nothing done, if the chain has no material. result: that of the ray, with nothing added yet.
  virtual bool shade(RayEnd& end, ModifierId modifier, RayResult& result) = 0;

  // Begins a path for a gather. It is valid until the next one begins. normal: of the gather's site (unit).
  virtual InnerPath beginGather(uint64_t seed, const V3d& normal) = 0;

 protected:
  ~RayFollower() = default;
};

}  // namespace rsphere
