#pragma once
#include <array>
#include <cstdint>

#include "base/radiometry.h"

namespace rsphere {

// A place where a light path (light_vertices.h) hits a diffuse surface.
struct LightVertex {
  enum Way : uint8_t {  // the last step of the light to the vertex
    direct,             // straight from a source
    unweighed,          // directly from the sky or from a source that is not even (source_emission.h)
    diffuse,            // directly from a diffuse reflection
    highlight,          // directly from a source's highlight on a rough surface
    // From a diffuse reflection or from beyond a portal, by sharp reflections at panes, mirrors and polished
    // surfaces. The diffuse surface did not receive the light directly from a highlight or from any other
    // sharp reflection.
    mirrored,
    sharp  // from any other highlight, or from any other sharp reflection
  };
  // Light paths are divided into this number of batches. The differences between the batches give an estimate
  // of the error that the vertices cause.
  static constexpr int kBatches = 32;

  double place[3];  // world; in double precision, for scenes far from the origin
  float facing[3];  // world; the normal (unit) on the side that the light came from
  float power = 0;  // brightness of the diffusely reflected light, W
  // Number of diffuse surfaces on the path from the source, including this one. 1 more if a highlight lights
  // the first surface.
  uint8_t bounces = 0;
  Way way = direct;
  uint8_t batch = 0;

  // Whether the light of the vertex is added with the unbounded kernel 1 / d^2 (vertex_light.h), because rays
  // towards near surfaces do not sample this light.
  bool isUnbounded() const { return isUnbounded(way); }
  static bool isUnbounded(Way way) { return way == highlight || way == mirrored || way == sharp; }
  V3d point() const { return V3d(place[0], place[1], place[2]); }
  V3d normal() const { return V3d(facing[0], facing[1], facing[2]); }
};

// Sums of contributions to an estimate. Index: the batch of the light path.
using BatchSums = std::array<Irradiance, LightVertex::kBatches>;

}  // namespace rsphere
