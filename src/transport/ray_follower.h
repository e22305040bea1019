#pragma once
// The recursion of the path tracer as its parts see it: they find where light may come from, and ask for the
// radiance from there.
#include "transport/ray.h"

namespace rsphere {

class RayFollower {
 public:
  // Traces a ray: sets what it hits and its radiance at its origin. Origin, direction and all that it
  // inherits from its parent are set (continueRay()).
  virtual void follow(Ray& ray) = 0;

  // Continues a ray straight through the surface that it hit, as if nothing were there; its value becomes
  // what is seen beyond.
  virtual void pass(Ray& ray) = 0;
  // The same with a child that inherits from the ray, whose medium may differ.
  virtual void passOn(Ray& child, Ray& ray) = 0;

  // Shades a ray that hit something with a chain of modifiers (index in Scene::modifiers); false where the
  // chain has no material, and nothing was done.
  virtual bool shade(Ray& ray, int32_t modifier) = 0;

 protected:
  ~RayFollower() = default;
};

}  // namespace rsphere
