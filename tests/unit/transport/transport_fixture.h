#pragma once
#include <fmt/format.h>

#include <string>
#include <utility>

#include "tests/unit/support/scene_of.h"
#include "tests/unit/support/statistics.h"
#include "transport/transport.h"

namespace rsphere {

// A scene, prepared for tracing, and a tracer.
class Traced {
 public:
  explicit Traced(const std::string& text, const RayOptions& options = {},
                  IrradianceAt irradiance = IrradianceAt::none)
      : scene_(sceneOf(text)), transport_(scene_, options, irradiance), tracer_(tracerWith({})) {}

  Color color(const V3d& origin, const V3d& direction, uint64_t seed = 1, double farthest = 0,
              const PathRequest& request = {}) {
    return tracer_.trace(origin, direction.normalized(), farthest, seed, request).value.color;
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
    const TracedRay ray = tracer_.trace(origin, direction.normalized(), 0, 1);
    return ray.surface == kNone ? "" : std::string(scene_.surfaceName(scene_.surfaces[ray.surface]));
  }
  // Aims at nothing where light is gathered instead of interpolated.
  PathTracer& tracer() { return tracer_; }
  PathTracer tracerWith(const Aims& aims, const TracingMode& mode = {}) const {
    return PathTracer(transport_.prepared(), transport_.caches(), aims, mode);
  }
  const Scene& scene() const { return scene_; }
  const Transport& transport() const { return transport_; }
  const PreparedScene& prepared() const { return transport_.prepared(); }

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

// A room of 4 x 4 x 3 with a pane of 1 x 1 in its south wall, on a wide ground, under a sun of 45 degrees: it
// shines on the floor at 1.5 <= x <= 2.5, 1 <= y <= 2.
inline const std::string kSunlitRoom =
    "void plastic white 0 0 5 .6 .6 .6 0 0\nvoid glass clear 0 0 3 .96 .96 .96\n"
    "void glow sky 0 0 4 1 1 1 0\nsky source heaven 0 0 4 0 0 1 180\n"
    "void light sunlight 0 0 3 1e6 1e6 1e6\nsunlight source sun 0 0 4 0 -1 1 .53\n"
    "white polygon ground 0 0 12 -400 -400 -.01 400 -400 -.01 400 400 -.01 -400 400 -.01\n"
    "white polygon floor 0 0 12 0 0 0 4 0 0 4 4 0 0 4 0\n"
    "white polygon ceiling 0 0 12 0 0 3 0 4 3 4 4 3 4 0 3\n"
    "white polygon west 0 0 12 0 0 0 0 4 0 0 4 3 0 0 3\n"
    "white polygon east 0 0 12 4 0 0 4 0 3 4 4 3 4 4 0\n"
    "white polygon north 0 0 12 0 4 0 4 4 0 4 4 3 0 4 3\n"
    "white polygon south 0 0 30 0 0 0 4 0 0 4 0 3 0 0 3 0 0 0 1.5 0 1 1.5 0 2 2.5 0 2 2.5 0 1 1.5 0 1\n"
    "clear polygon window 0 0 12 1.5 0 1 2.5 0 1 2.5 0 2 1.5 0 2\n";

// A room of 3 x 5 x 2.7 whose wall at y = 0 has a window without a pane, at 1.1 <= x <= 1.9 and 1 <= z <=
// 1.7. All around it is a sky of 1 W/sr/m2.
inline const std::string kRoomWithAWindow =
    "void plastic white 0 0 5 .6 .6 .6 0 0\nvoid glow sky 0 0 4 1 1 1 0\nsky source heaven 0 0 4 0 0 1 360\n"
    "white polygon floor 0 0 12 0 0 0 3 0 0 3 5 0 0 5 0\n"
    "white polygon ceiling 0 0 12 0 0 2.7 0 5 2.7 3 5 2.7 3 0 2.7\n"
    "white polygon west 0 0 12 0 0 0 0 5 0 0 5 2.7 0 0 2.7\n"
    "white polygon east 0 0 12 3 0 0 3 0 2.7 3 5 2.7 3 5 0\n"
    "white polygon north 0 0 12 0 5 0 3 5 0 3 5 2.7 0 5 2.7\n"
    "white polygon south 0 0 30 0 0 0 3 0 0 3 0 2.7 0 0 2.7 0 0 0 "
    "1.1 0 1 1.1 0 1.7 1.9 0 1.7 1.9 0 1 1.1 0 1\n";

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
