#pragma once
#include <Imath/ImathVec.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

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

// A step between two points of evenly(): from any point i to point i + ahead, if the square continues at its
// opposite side.
struct EvenStep {
  std::size_t ahead;
  Imath::V2d step;
};
// The `most` shortest steps between the first `count` points.
inline std::vector<EvenStep> shortestSteps(std::size_t count, std::size_t most) {
  std::vector<EvenStep> steps;
  for (std::size_t k = 1; k < count; ++k) {
    const Imath::V2d to = evenly(k, 0, 0);
    steps.push_back({k, to - Imath::V2d(std::round(to.x), std::round(to.y))});
  }
  most = std::min(most, steps.size());
  std::partial_sort(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(most), steps.end(),
                    [](const EvenStep& a, const EvenStep& b) { return a.step.length2() < b.step.length2(); });
  steps.resize(most);
  return steps;
}

}  // namespace rsphere
