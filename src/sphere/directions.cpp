#include "sphere/directions.h"

#include <cmath>
#include <numbers>

namespace rsphere {
namespace {

// SplitMix64 (Steele, Lea, Flood 2014). Its output is well mixed for any 64-bit state, even a small one.
std::uint64_t mixed(std::uint64_t& state) {
  std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

// In [0, 1), multiples of 2^-53.
double unitInterval(std::uint64_t& state) { return static_cast<double>(mixed(state) >> 11) * 0x1p-53; }

}  // namespace

std::vector<V3d> baseDirections(std::size_t n) {
  // Turns are integers in units of 2^-64, so that multiples of the golden angle wrap around without rounding.
  constexpr std::uint64_t kGoldenTurn = 0x9e3779b97f4a7c15u;  // 2^64 (sqrt(5) - 1) / 2
  std::vector<V3d> directions;
  directions.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double below =
        static_cast<double>(2 * i + 1) / static_cast<double>(n);  // 1 - z, without cancellation
    const double r = std::sqrt(below * (2 - below));
    const double phi = 2 * std::numbers::pi * 0x1p-64 * static_cast<double>(i * kGoldenTurn);
    directions.push_back(V3d(r * std::cos(phi), r * std::sin(phi), 1 - below).normalized());
  }
  return directions;
}

Imath::M33d randomRotation(std::uint64_t number) {
  if (number == 0) return {};
  const double u = unitInterval(number), v = 2 * std::numbers::pi * unitInterval(number),
               w = 2 * std::numbers::pi * unitInterval(number);
  const double s = std::sqrt(1 - u), t = std::sqrt(u);
  const double x = s * std::sin(v), y = s * std::cos(v), z = t * std::sin(w), c = t * std::cos(w);
  return Imath::M33d(1 - 2 * (y * y + z * z), 2 * (x * y + z * c), 2 * (x * z - y * c),  //
                     2 * (x * y - z * c), 1 - 2 * (x * x + z * z), 2 * (y * z + x * c),  //
                     2 * (x * z + y * c), 2 * (y * z - x * c), 1 - 2 * (x * x + y * y));
}

std::vector<V3d> rotatedDirections(std::span<const V3d> directions, std::uint64_t rotation) {
  std::vector<V3d> rotated(directions.begin(), directions.end());
  if (rotation == 0) return rotated;
  const Imath::M33d m = randomRotation(rotation);
  for (V3d& d : rotated) d = (d * m).normalized();
  return rotated;
}

}  // namespace rsphere
