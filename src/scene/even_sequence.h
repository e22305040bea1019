#pragma once
#include <Imath/ImathVec.h>

#include <cmath>
#include <cstddef>

namespace rsphere {

// Point i of an additive low-discrepancy sequence in the unit square, well distributed for any number of
// points. shift1, shift2: where the sequence starts; with uniform random shifts in [0, 1), each point is
// uniform over the square. Source: Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018
// (the plastic number).
inline Imath::V2d evenly(std::size_t i, double shift1, double shift2) {
  const double a = shift1 + .7548776662466927 * static_cast<double>(i);
  const double b = shift2 + .5698402909980532 * static_cast<double>(i);
  return {a - std::floor(a), b - std::floor(b)};
}

}  // namespace rsphere
