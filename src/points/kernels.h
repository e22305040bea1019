#pragma once
// The weights of directions in the integrals, besides the mean, that have standard errors of their own: the
// zones of -Sz, and the quantities other than the mean.
#include <Imath/ImathVec.h>

#include <algorithm>
#include <bitset>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>

#include "sphere/direction_bins.h"

namespace rsphere {

using Imath::V3d;

struct Kernels {
  // Definitions: point_answer.h. faces: +x -x +y -y +z -z; vector: x y z, of the light vector.
  enum Quantity : size_t {
    cylindrical,
    semicylindrical,
    hemispherical,
    faces,
    vector = faces + 6,
    kQuantities = vector + 3
  };

  using Some = std::bitset<kQuantities>;

  std::shared_ptr<const DirectionBins> zones{};  // of -Sz, or bins; null: not requested
  Some quantities{};                             // those with standard errors
  V3d facing{1, 0, 0};                           // -So  unit

  size_t zoneCount() const { return zones ? zones->count() : 0; }
  // The zones come before the quantities, among which those without errors have numbers, too.
  size_t count() const { return zoneCount() + (quantities.any() ? size_t{kQuantities} : 0); }

  // The weight of a direction (unit, world) in a quantity.
  double weight(size_t quantity, const V3d& d) const {
    const double sine = std::sqrt(std::max(0., 1 - d.z * d.z));
    if (quantity == cylindrical) return sine / std::numbers::pi;
    if (quantity == semicylindrical) return (sine + d.dot(facing)) / std::numbers::pi;
    if (quantity == hemispherical) return (1 + d.z) / 4;
    if (quantity >= vector) return d[static_cast<int>(quantity - vector)];
    const double cosine = d[static_cast<int>((quantity - faces) / 2)];
    return std::max(0., (quantity - faces) % 2 == 0 ? cosine : -cosine);
  }
  // Calls f(number, weight) for each zone and quantity in which the direction has a weight.
  template <class F>
  void weigh(const V3d& d, const F& f) const {
    if (zones) zones->divide(d, 0, f);
    for (size_t i = 0; quantities.any() && i < kQuantities; ++i)
      if (quantities[i])
        if (const double w = weight(i, d); w != 0) f(zoneCount() + i, w);
  }
};

}  // namespace rsphere
