#pragma once
#include <Imath/ImathVec.h>

#include <cstdint>
#include <random>
#include <string>
#include <vector>

// Sets of directions that are hard on purpose.
namespace rsphere {

using Imath::V3d;

struct Set {
  std::string name;
  std::vector<V3d> directions;
};

V3d randomDirection(std::mt19937_64& random);
std::vector<V3d> randomDirections(std::size_t n, std::uint64_t seed);

// The five regular solids: 4, 6, 8, 12 and 20 corners.
std::vector<V3d> regularSolid(int corners);

// Everything from four directions to crowded poles, each as built and in a random rotation.
std::vector<Set> hardSets();

// A small set, from the seed, of directions with few different coordinates, equal ones, antipodes, rings and
// arcs.
std::vector<V3d> degenerateSet(std::uint64_t seed);

}  // namespace rsphere
