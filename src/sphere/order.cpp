#include "sphere/order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace rsphere {
namespace {

// Table for processing four bits of each coordinate at a time. Index: [orientation of the curve][x][y].
// Value: 8 bits of the position, and above them the next orientation.
constexpr int kSteps = 3, kBits = 4 * kSteps;
constexpr std::array<std::uint16_t, 4 * 256> kCurve = [] {
  std::array<std::uint16_t, 4 * 256> table{};
  for (unsigned turn = 0; turn < 4; ++turn) {
    for (unsigned xy = 0; xy < 256; ++xy) {
      bool swapped = turn & 1, inverted = turn & 2;
      unsigned place = 0;
      for (int bit = 3; bit >= 0; --bit) {
        bool x = xy >> (4 + bit) & 1, y = xy >> bit & 1;
        if (swapped) std::swap(x, y);
        if (inverted) x = !x, y = !y;
        place = place << 2 | ((x ? 3u : 0u) ^ (y ? 1u : 0u));
        if (!y) {
          inverted = inverted != x;
          swapped = !swapped;
        }
      }
      table[turn << 8 | xy] =
          static_cast<std::uint16_t>(place | (swapped ? 256u : 0u) | (inverted ? 512u : 0u));
    }
  }
  return table;
}();

}  // namespace

std::uint32_t placeOnCurve(const V3d& d) {
  // The order of the faces is x y z -x -y -z, so that each is adjacent to the preceding one.
  const double ax = std::abs(d.x), ay = std::abs(d.y), az = std::abs(d.z);
  const bool xIsGreatest = ax >= ay && ax >= az, yIsGreater = ay >= az;
  const double m = xIsGreatest ? d.x : yIsGreater ? d.y : d.z;
  const double s = xIsGreatest ? d.y : yIsGreater ? d.z : d.x, t = xIsGreatest ? d.z : yIsGreater ? d.x : d.y;
  const unsigned face = (xIsGreatest ? 0 : yIsGreater ? 1 : 2) + (m < 0 ? 3 : 0);
  const double half = 1 << (kBits - 1), scale = 0.9999 * half / std::abs(m);
  const auto x = static_cast<unsigned>(half + s * scale), y = static_cast<unsigned>(half + t * scale);
  unsigned place = face, turn = 0;
  for (int step = kSteps - 1; step >= 0; --step) {
    const unsigned next = kCurve[turn << 8 | (x >> 4 * step & 15) << 4 | (y >> 4 * step & 15)];
    place = place << 8 | (next & 255);
    turn = next >> 8;
  }
  return place;
}

void orderAlongCurve(std::span<const Site> sites, OrderScratch& scratch, std::vector<std::uint32_t>& order) {
  // The lower half of a key is the index of the site.
  scratch.keys.resize(sites.size());
  for (std::size_t i = 0; i < sites.size(); ++i)
    scratch.keys[i] = std::uint64_t{placeOnCurve(sites[i].at)} << 32 | i;
  std::ranges::sort(scratch.keys);
  order.resize(sites.size());
  for (std::size_t i = 0; i < sites.size(); ++i) order[i] = static_cast<std::uint32_t>(scratch.keys[i]);
}

void orderForBuild(std::span<const Site> sites, OrderScratch& scratch, std::vector<std::uint32_t>& order) {
  orderAlongCurve(sites, scratch, order);
  if (order.empty()) return;
  std::array<std::uint32_t, 6> extreme{};
  for (std::uint32_t i = 0; i < sites.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      if (sites[i].at[axis] > sites[extreme[axis]].at[axis]) extreme[axis] = i;
      if (sites[i].at[axis] < sites[extreme[3 + axis]].at[axis]) extreme[3 + axis] = i;
    }
  }
  // Every 64th direction along the curve, as a uniform sample. Values from 16 to 128 work equally well.
  constexpr std::size_t kSample = 64;
  auto& reordered = scratch.order;
  reordered.clear();
  std::ranges::sort(extreme);
  reordered.insert(reordered.end(), extreme.begin(), std::unique(extreme.begin(), extreme.end()));
  for (const bool sample : {true, false}) {
    for (std::size_t k = 0; k < order.size(); ++k) {
      if ((k % kSample == 0) != sample) continue;
      if (std::ranges::find(extreme, order[k]) == extreme.end()) reordered.push_back(order[k]);
    }
  }
  order.swap(reordered);
}

}  // namespace rsphere
