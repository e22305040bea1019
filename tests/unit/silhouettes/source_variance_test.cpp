#include "silhouettes/source_variance.h"

#include <gtest/gtest.h>

#include <vector>

#include "base/random.h"
#include "tests/unit/support/statistics.h"

namespace rsphere::source_variance_test {
namespace {

// Independent values of variance 1/12 in a grid of `side` by `side` cells of solid angle 1.
std::vector<SeenSources::Sample> grid(size_t side, Random& random) {
  std::vector<SeenSources::Sample> samples(side * side);
  for (size_t i = 0; i < samples.size(); ++i) {
    const double value = random.uniform();
    samples[i].direction.value = Radiance(value);
    samples[i].part = samples[i].direction.solidAngle = 1;
    samples[i].row = i / side;
  }
  return samples;
}

// Half the variance of independent values: tuning::ErrorEstimate::kEvenParts.
TEST(SourceVariance, PartsOfASourceHaveHalfTheVarianceOfIndependentOnes) {
  Random random(1);
  Sample ratio;
  for (int i = 0; i < 400; ++i) ratio.add(partsVariance(grid(8, random), nullptr).brightness / (64 / 12.));
  expectMean(ratio, .5, 1.1);
}

// A cell half of whose four shadow rays are blocked has the variance 1/4 / 4 of a mean of four.
TEST(SourceVariance, PartlyHiddenPartsVary) {
  SeenSources::Sample half;
  half.direction.value = Radiance(1);
  half.part = 1;
  half.aimed = 4;
  half.clear = 2;
  EXPECT_NEAR(partsVariance(std::vector{half}, nullptr).brightness, .5 * .25 / 4, 1e-12);
}

}  // namespace
}  // namespace rsphere::source_variance_test
