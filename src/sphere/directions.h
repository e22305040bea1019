#pragma once
#include <Imath/ImathMatrix.h>
#include <Imath/ImathVec.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rsphere {

using Imath::V3d;

// A uniform set of n unit directions, the Fibonacci lattice: direction i has height 1 - (2i+1)/n and is
// turned by i golden angles about z. The set depends only on n.
//
// n: any number; 0 gives an empty set. Takes 20 ns per direction.
//
// Two alternatives were rejected. 200 steps of Lloyd's relaxation form grains of hexagons. Moving the 24
// directions next to each pole along z equalizes the areas but integrates smooth functions less
// accurately. For n = 2048:
//
//                                                     lattice   relaxed   poles moved
//   deviation of cell areas from 4 pi/n, rms            0.51%      3.7%         0.34%
//   largest deviation (lattice: the two polar cells)       6%       16%          2.2%
//   error of exp(20 cos) about random axes, rms        2.5e-6                  3.5e-6
//   the same, weighted by cells                        1.8e-6                  2.0e-6
//   error of caps                                     1.05e-3                 1.05e-3
//
// Source: Gonzalez, "Measurement of areas on a sphere using Fibonacci and latitude-longitude lattices", 2010.
std::vector<V3d> baseDirections(std::size_t n);

// A pseudorandom rotation determined by a number; 0 gives the identity. Uniform numbers give uniform
// rotations. For row vectors, as in Imath: v * randomRotation(k). Orthonormal to 4e-16. Source: Shoemake,
// "Uniform random rotations", Graphics Gems III, 1992.
Imath::M33d randomRotation(std::uint64_t number);

// The directions, rotated by randomRotation(rotation) and normalized again. If rotation is 0 they are
// unchanged.
std::vector<V3d> rotatedDirections(std::span<const V3d> directions, std::uint64_t rotation);

}  // namespace rsphere
