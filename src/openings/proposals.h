#pragma once
// Regions at which directions from a point are aimed (importance sampling), with estimates of the light from
// each.
#include <array>
#include <cstddef>
#include <cstdint>

#include "base/constants.h"
#include "scene/shape.h"

namespace rsphere {

// Regions of one kind (rectangles, cones, lobes), identified by numbers that their finder assigns. One of
// them is selected with a probability proportional to the light expected from it.
template <size_t kRoom>
struct Proposals {
  // Expected mean radiance over the hemisphere from these regions, W/sr/m2, without occlusion.
  double mean = 0;
  size_t count = 0;
  V3d point{0, 0, 0};
  std::array<uint32_t, kRoom> number;
  std::array<double, kRoom> upTo;  // cumulative contributions

  void clear() {
    count = 0;
    mean = 0;
  }
  // REQUIRES: count < kRoom.
  void add(uint32_t region, double contribution) {
    number[count] = region;
    upTo[count] = before(count) + contribution;
    ++count;
  }
  void finish(const V3d& from) {
    point = from;
    mean = before(count) / kPi;
  }
  // The sum of the contributions before region i; before(count) is the total.
  double before(size_t i) const { return i > 0 ? upTo[i - 1] : 0; }
  // The index selected by u; u: uniform in [0, 1). REQUIRES: count > 0.
  size_t chosen(double u) const {
    const double due = u * upTo[count - 1];
    size_t i = 0;
    while (i + 1 < count && !(due < upTo[i])) ++i;
    return i;
  }
};

}  // namespace rsphere
