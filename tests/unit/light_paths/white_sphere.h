#pragma once
#include "light_paths/vertex_light.h"
#include "tests/unit/transport/transport_fixture.h"

namespace rsphere::white_sphere {

// The inside of a sphere of radius 1 and a small lamp in its middle: an integrating sphere. Each bounce
// multiplies the even light by the reflectance, but for the share of the sphere that the lamp hides.
constexpr double kReflectance = .5, kRadius = .02, kLamp = 1000;  // kLamp: radiance, W/sr/m2

inline const std::string kScene =
    "void plastic white 0 0 5 .5 .5 .5 0 0\nwhite bubble wall 0 0 4 0 0 0 1\n"
    "void light glowing 0 0 3 1000 1000 1000\nglowing sphere lamp 0 0 4 0 0 0 .02\n";

// Of the wall, from the lamp (W/m2).
constexpr double kIrradiance = kPi * kLamp * kRadius * kRadius;

inline SourceEmission emissionOf(const Traced& room, const PlainSurfaces& surfaces, size_t paths) {
  return SourceEmission(room.prepared(), surfaces, paths);
}

}  // namespace rsphere::white_sphere
