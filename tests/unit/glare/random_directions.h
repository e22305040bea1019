#pragma once
#include <Imath/ImathVec.h>

#include <random>
#include <vector>

namespace rsphere {

// Spread over the sphere at random.
inline std::vector<Imath::V3d> randomDirections(size_t count, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  std::vector<Imath::V3d> directions;
  for (size_t i = 0; i < count; ++i) {
    const double x = normal(generator), y = normal(generator), z = normal(generator);
    directions.push_back(Imath::V3d(x, y, z).normalized());
  }
  return directions;
}

}  // namespace rsphere
