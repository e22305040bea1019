#include "glare/local_fits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/unit/glare/random_directions.h"

namespace rsphere {
namespace {

// Directions of a slat: wide and flat.
std::vector<V3d> slat(size_t count) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<V3d> directions;
  for (size_t i = 0; i < count; ++i) {
    const double x = .4 * uniform(generator), z = .006 * uniform(generator);
    directions.push_back(V3d(x, 1, z).normalized());
  }
  return directions;
}

TEST(FitsOfOthers, FollowAQuadratic) {
  const std::vector<V3d> directions = slat(400);
  std::vector<double> values;
  for (const V3d& d : directions) {
    const double z = d.z / .006;
    values.push_back(2000 + 1000 * z + 400 * z * z + 300 * d.x * z);
  }
  const std::vector<double> fits = fitsOfOthers(directions, values, 64);
  for (size_t i = 0; i < fits.size(); ++i) EXPECT_NEAR(fits[i], values[i], 2) << i;
}

TEST(FitsOfOthers, OfEqualValuesAreThem) {
  for (const size_t count : {1, 2, 11, 12, 23, 24, 200}) {
    const std::vector<double> fits =
        fitsOfOthers(randomDirections(count, 1), std::vector<double>(count, 7.), 32);
    for (const double fit : fits) EXPECT_NEAR(fit, 7, 1e-6) << count;
  }
}

// Whatever a value is, it does not change its own fit, but that of others.
TEST(FitsOfOthers, LeaveOutTheirOwnValue) {
  const std::vector<V3d> directions = slat(60);
  std::vector<double> values;
  for (size_t i = 0; i < directions.size(); ++i) values.push_back(static_cast<double>(i % 7));
  const std::vector<double> before = fitsOfOthers(directions, values, 30);
  for (const size_t i : {0, 17, 59}) {
    std::vector<double> changed = values;
    changed[i] += 1000;
    const std::vector<double> after = fitsOfOthers(directions, changed, 30);
    EXPECT_NEAR(after[i], before[i], 1e-6);
    double most = 0;
    for (size_t k = 0; k < after.size(); ++k) most = std::max(most, std::abs(after[k] - before[k]));
    EXPECT_GT(most, 10);
  }
}

// Noise of variance 1 leaves less than a third of it with cells of 64 and more, and more than none.
TEST(FitsOfOthers, HaveLessNoise) {
  const std::vector<V3d> directions = slat(2000);
  std::mt19937 generator(6);
  std::normal_distribution<double> normal;
  std::vector<double> values;
  for (size_t i = 0; i < directions.size(); ++i) values.push_back(normal(generator));
  double squares = 0;
  for (const double fit : fitsOfOthers(directions, values, 128))
    squares += fit * fit / static_cast<double>(directions.size());
  EXPECT_GT(squares, .02);
  EXPECT_LT(squares, .3);
}

TEST(FitsOfOthers, OfDirectionsInALineAndTheSame) {
  std::vector<V3d> line, same(100, V3d(0, 0, 1));
  for (int i = 0; i < 100; ++i) line.push_back(V3d(.01 * i, 1, 0).normalized());
  std::vector<double> values;
  for (int i = 0; i < 100; ++i) values.push_back(i);
  const std::vector<double> onLine = fitsOfOthers(line, values, 50),
                            together = fitsOfOthers(same, values, 128);
  for (size_t i = 0; i < 100; ++i) {
    EXPECT_NEAR(onLine[i], values[i], .5) << i;
    EXPECT_NEAR(together[i], (4950 - values[i]) / 99, 1e-3) << i;
  }
  EXPECT_TRUE(fitsOfOthers({}, {}, 8).empty());
}

}  // namespace
}  // namespace rsphere
