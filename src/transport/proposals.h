#pragma once
// The regions at which directions from a point are aimed, each with the light that is expected from it.
#include <array>
#include <cstddef>
#include <cstdint>

#include "base/constants.h"
#include "scene/shape.h"

namespace rsphere {

// The regions of one kind (rectangles, cones, lobes), by the numbers that their finder knows them by. One of
// them is chosen in proportion to its light.
template <size_t kRoom>
struct Proposals {
  double mean = 0;  // radiance over the hemisphere that is expected from them, W/sr/m2, without occlusion
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
  // The sum of the contributions before region i. before(count): the sum of all.
  double before(size_t i) const { return i > 0 ? upTo[i - 1] : 0; }
  // The one that is chosen by u, uniform in [0, 1). REQUIRES: count > 0.
  size_t chosen(double u) const {
    const double due = u * upTo[count - 1];
    size_t i = 0;
    while (i + 1 < count && !(due < upTo[i])) ++i;
    return i;
  }
};

// The fraction of the directions of a mixture that is aimed at a finder's proposals. A finder has the members
//   Aim                          its proposals at a point
//   sample(aim, u1, u2, u3)      one of the aimed directions (unit), for uniform u1, u2, u3 in [0, 1)
//   density(aim, direction)      of these directions, per sr
template <class Finder>
struct ShareOfMixture {
  const Finder* finder;
  typename Finder::Aim aim;
  double share = 0;

  explicit ShareOfMixture(const Finder* of) : finder(of) {}
  // u: uniform in [0, share).
  V3d sample(double u, double u2, double u3) const { return finder->sample(aim, u / share, u2, u3); }
  double density(const V3d& direction) const {
    return share > 0 ? share * finder->density(aim, direction) : 0;
  }
};

}  // namespace rsphere
