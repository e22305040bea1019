#pragma once
// Smooths noisy values on the sphere.
#include <Imath/ImathVec.h>

#include <cstddef>
#include <span>
#include <vector>

namespace rsphere {

using Imath::V3d;

// Estimates each value from the other values near it, so that its own noise has no influence (leave-one-out).
// The directions (unit) are divided into cells: each is halved across its longer side until it has at most
// `most` directions (at least 1). For each value, a polynomial of two angles is fitted by least squares to
// all other values of its cell, and evaluated at its direction. The polynomial is quadratic in cells of 24 or
// more directions, linear from 12, and constant in smaller ones. A value that is alone in its cell is kept.
std::vector<double> fitsOfOthers(std::span<const V3d> directions, std::span<const double> values,
                                 size_t most);

}  // namespace rsphere
