#pragma once
// Materials and surfaces of scenes for one test each.
#include <fmt/format.h>

#include <string>

#include "tests/unit/transport/transport_fixture.h"

namespace rsphere::small_scenes {

inline const V3d kOrigin(0, 0, 0), kUp(0, 0, 1), kDown(0, 0, -1);

inline std::string plastic(const char* name, double reflectance) {
  return fmt::format("void plastic {}\n0\n0\n5 {r} {r} {r} 0 0\n", name, fmt::arg("r", reflectance));
}
inline std::string light(double radiance) {
  return fmt::format("void light lamp\n0\n0\n3 {r} {r} {r}\n", fmt::arg("r", radiance));
}
inline std::string glow(double radiance, double reach) {
  return fmt::format("void glow sky\n0\n0\n4 {r} {r} {r} {}\n", reach, fmt::arg("r", radiance));
}
// A horizontal square of half-size 10 that faces up.
inline std::string floor(const char* modifier, double z = 0, double half = 10, bool up = true) {
  const double a = up ? -half : half;
  return fmt::format("{} polygon floor\n0\n0\n12 {a} {n} {z} {b} {n} {z} {b} {p} {z} {a} {p} {z}\n", modifier,
                     fmt::arg("a", a), fmt::arg("b", -a), fmt::arg("n", -half), fmt::arg("p", half),
                     fmt::arg("z", z));
}
// Irradiance as with -I on the command line: the ray comes down to the point from a little above.
inline double irradianceAt(Traced& traced, const V3d& point, const V3d& normal, uint64_t seed = 1) {
  return traced.value(point + 1.1e-4 * normal, -normal, seed);
}

}  // namespace rsphere::small_scenes
