#pragma once
#include <array>
#include <cstdint>

#include "base/radiometry.h"

namespace rsphere {

// A place at which a light path (light_vertices.h) arrives on a diffuse surface.
struct LightVertex {
  enum Way : uint8_t {  // by which the light has arrived
    direct,             // straight from a source
    unweighed,          // the same, from a source whose shadow rays have no known density
    diffuse,            // straight from a diffuse reflection
    highlight,          // straight from the rough highlight that a source has on a surface
    sharp               // from another highlight or a sharp reflection
  };
  // Paths are dealt out to this number of batches, by whose differences the error of the vertices is
  // estimated.
  static constexpr int kBatches = 32;

  double place[3];  // world; in double precision, for scenes far from the origin
  float facing[3];  // world; the normal (unit) on the side that the light came from
  float power = 0;  // brightness of what is reflected diffusely, W
  // Diffuse surfaces on the way from the source, this one included, and a highlight that lights the first.
  uint8_t bounces = 0;
  Way way = direct;
  uint8_t batch = 0;

  // Rays that look for near surfaces do not bring its light on to others.
  bool isUnbounded() const { return way == highlight || way == sharp; }
  V3d point() const { return V3d(place[0], place[1], place[2]); }
  V3d normal() const { return V3d(facing[0], facing[1], facing[2]); }
};

// Sums of contributions to an estimate, by the batch of the light path.
using BatchSums = std::array<Irradiance, LightVertex::kBatches>;

}  // namespace rsphere
