#pragma once
// Smooth values over the sphere from noisy ones.
#include <Imath/ImathVec.h>

#include <cstddef>
#include <span>
#include <vector>

namespace rsphere {

using Imath::V3d;

// What the others say about each value: the directions (unit) are divided into cells of at most `most`,
// halved across their longer side until they fit; in each, a polynomial of two angles is fitted by least
// squares to all values but one and evaluated at the direction of that one. So its own noise has no part in
// the result. The polynomial is quadratic in cells of 24 or more directions, linear from 12, and constant in
// smaller ones. A value that is alone in its cell is kept. most: at least 1.
std::vector<double> fitsOfOthers(std::span<const V3d> directions, std::span<const double> values,
                                 size_t most);

}  // namespace rsphere
