#pragma once
// The path tracer's recursion as an interface for its parts: they choose directions that light may come from,
// and request the radiance along them.
#include "transport/ray.h"

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
  // Traces a ray: sets its hit and its radiance at its origin. REQUIRES that its origin, its direction and
  // the fields that it inherits from its parent are set (continueRay()).
  virtual void follow(Ray& ray) = 0;

  // Continues a ray straight through the surface that it hit, as if nothing were there; its value becomes the
  // radiance from beyond the surface.
  virtual void pass(Ray& ray) = 0;
  // The same with a child that inherits from the ray, whose medium may differ.
  virtual void passOn(Ray& child, Ray& ray) = 0;

  // Shades a ray that hit a surface with a chain of modifiers (index in Scene::modifiers). False, with
  // nothing done, if the chain has no material.
  virtual bool shade(Ray& ray, ModifierId modifier) = 0;

  // Begins a path for a gather. It is valid until the next one begins. normal: of the gather's site (unit).
  virtual InnerPath beginGather(uint64_t seed, const V3d& normal) = 0;

 protected:
  ~RayFollower() = default;
};

}  // namespace rsphere
