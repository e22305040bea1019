#pragma once
// The recursion of the path tracer, as an interface for its parts. The parts choose directions from which
// light may arrive, and request the radiance along them.
#include "rays/ray_functions.h"

namespace rsphere {

class PreparedScene;
struct PathSettings;
struct PathState;
class RayFollower;

// A path within another path. It has a new state, and does not depend on the path that requested it.
struct InnerPath {
  PathState& state;
  const PathSettings& settings;
  RayFollower& follower;
};

// The objects to which all parts of a path tracer refer.
struct PathPart {
  const PreparedScene& t_;
  const PathSettings& settings_;
  PathState& state_;
  RayFollower& follower_;  // follows the rays that the part sends
};

class RayFollower {
 public:
  // The radiance that arrives at a ray's origin. It is computed at the ray's end, and attenuated along the
  // ray.
  RayResult follow(const RayQuery& ray, const PathContext& context) {
    RayEnd end(ray, context);
    return follow(end);
  }
  // Follows the ray of `end`, and sets the hit there.
  virtual RayResult follow(RayEnd& end) = 0;

  // The radiance that arrives at a surface from behind, as if the surface were not there.
  RayResult pass(const RayEnd& end) {
    NextRay next = straightOn(end);
    return passOn(next, end);
  }
  // pass() along a given continuation of the ray, which may pass through another medium.
  virtual RayResult passOn(NextRay& next, const RayEnd& end) = 0;

  // Shades the end of a ray that hit a surface with this chain of modifiers. False, without any effect, if
  // the chain has no material. result: the ray's result, initially empty.
  virtual bool shade(RayEnd& end, ModifierId modifier, RayResult& result) = 0;

  // Begins the path of a gather. It remains valid until the next one begins. normal: at the gather's site
  // (unit).
  virtual InnerPath beginGather(uint64_t seed, const V3d& normal) = 0;

 protected:
  ~RayFollower() = default;
};

}  // namespace rsphere
