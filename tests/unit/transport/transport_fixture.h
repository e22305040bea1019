#pragma once
#include <fmt/format.h>

#include <string>
#include <utility>

#include "tests/unit/support/scene_of.h"
#include "tests/unit/support/statistics.h"
#include "transport/path_tracer.h"

namespace rsphere {

// A scene, prepared for tracing, and a tracer.
class Traced {
 public:
  explicit Traced(const std::string& text, const RayOptions& options = {},
                  IrradianceAt irradiance = IrradianceAt::none)
      : scene_(sceneOf(text)), transport_(scene_, options, irradiance), tracer_(transport_) {}

  Rgb color(const V3d& origin, const V3d& direction, uint64_t seed = 1, double farthest = 0) {
    return tracer_.trace(origin, direction.normalized(), farthest, seed).value.rgb;
  }
  // The red channel alone: the scenes are gray unless a test says otherwise.
  double value(const V3d& origin, const V3d& direction, uint64_t seed = 1, double farthest = 0) {
    return color(origin, direction, seed, farthest).x;
  }
  Sample mean(const V3d& origin, const V3d& direction, int count, uint64_t seed = 1) {
    Sample sample;
    for (int i = 0; i < count; ++i) sample.add(value(origin, direction, mixBits(seed + i)));
    return sample;
  }
  // The name of the surface that a ray sees.
  std::string seen(const V3d& origin, const V3d& direction) {
    const Ray ray = tracer_.trace(origin, direction.normalized(), 0, 1);
    return ray.surface == kNone ? "" : std::string(scene_.surfaceName(scene_.surfaces[ray.surface]));
  }
  PathTracer& tracer() { return tracer_; }
  const Scene& scene() const { return scene_; }
  const Transport& transport() const { return transport_; }

 private:
  Scene scene_;
  Transport transport_;
  PathTracer tracer_;
};

// A closed room from the origin to `size` (world units), whose walls of that modifier face inwards.
inline std::string roomOf(const std::string& modifier, const V3d& size) {
  return fmt::format(
      "{0} polygon floor 0 0 12 0 0 0 {1} 0 0 {1} {2} 0 0 {2} 0\n"
      "{0} polygon ceiling 0 0 12 0 0 {3} 0 {2} {3} {1} {2} {3} {1} 0 {3}\n"
      "{0} polygon west 0 0 12 0 0 0 0 {2} 0 0 {2} {3} 0 0 {3}\n"
      "{0} polygon east 0 0 12 {1} 0 0 {1} 0 {3} {1} {2} {3} {1} {2} 0\n"
      "{0} polygon south 0 0 12 0 0 0 0 0 {3} {1} 0 {3} {1} 0 0\n"
      "{0} polygon north 0 0 12 0 {2} 0 {1} {2} 0 {1} {2} {3} 0 {2} {3}\n",
      modifier, size.x, size.y, size.z);
}

// Options for unbiased means: every path is followed and every source is tested.
inline RayOptions unbiased(int bounces = 0) {
  RayOptions o;
  o.directThreshold = 0;
  o.directJitter = 1;
  o.specularThreshold = 0;
  o.ambientBounces = bounces;
  o.ambientAccuracy = 0;
  o.ambientDivisions = 1;
  o.ambientSuperSamples = 0;
  o.reflectionLimit = -1000;
  o.weightLimit = 1e-9;
  return o;
}

}  // namespace rsphere
