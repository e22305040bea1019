#pragma once
#include <array>
#include <cstdint>

#include "base/radiometry.h"

namespace rsphere {

// A place at which a light path (light_vertices.h) arrives on a diffuse surface.
struct LightVertex {
  enum Way : uint8_t {  // how the light has arrived
    direct,             // straight from a source
    unweighed,          // likewise, but the density of shadow rays to the source is unknown
    diffuse,            // straight from a diffuse reflection
    highlight,          // straight from the rough highlight that a source has on a surface
    sharp               // from any other highlight, or a sharp reflection
  };
  // Light paths are divided into this number of batches. The differences between batches give an estimate of
  // the error that is due to the vertices.
  static constexpr int kBatches = 32;

  double place[3];  // world; in double precision, for scenes far from the origin
  float facing[3];  // world; the normal (unit) on the side that the light came from
  float power = 0;  // brightness of the diffusely reflected light, W
  // Number of diffuse surfaces on the way from the source, including this one; plus 1 if a highlight lights
  // the first of them.
  uint8_t bounces = 0;
  Way way = direct;
  uint8_t batch = 0;

  // Whether the light of the vertex arrives with the unbounded kernel 1 / d^2 (vertex_light.h), because rays
  // that look for near surfaces do not bring it.
  bool isUnbounded() const { return way == highlight || way == sharp; }
  V3d point() const { return V3d(place[0], place[1], place[2]); }
  V3d normal() const { return V3d(facing[0], facing[1], facing[2]); }
};

// Sums of contributions to an estimate, by the batch of the light path.
using BatchSums = std::array<Irradiance, LightVertex::kBatches>;

}  // namespace rsphere
