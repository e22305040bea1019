#include "sphere/order.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rsphere {
namespace {

constexpr int kBits = 14;

// Least significant byte first, stable; keys hold the number of the direction in their lower half.
void radixSort(OrderScratch& scratch) {
  auto &keys = scratch.keys, &spare = scratch.spare;
  spare.resize(keys.size());
  constexpr int kDigit = 11;
  for (int shift = 32; shift < 64; shift += kDigit) {
    std::array<std::uint32_t, 1 << kDigit> start{};
    const auto digit = [shift](std::uint64_t key) { return (key >> shift) & ((1u << kDigit) - 1); };
    for (std::uint64_t key : keys) ++start[digit(key)];
    std::uint32_t before = 0;
    for (std::uint32_t& s : start) {
      const std::uint32_t count = s;
      s = before;
      before += count;
    }
    for (std::uint64_t key : keys) spare[start[digit(key)]++] = key;
    keys.swap(spare);
  }
}

}  // namespace

std::uint32_t placeOnCurve(const V3d& d) {
  // Faces follow each other around the cube.
  const double ax = std::abs(d.x), ay = std::abs(d.y), az = std::abs(d.z);
  double m, s, t;
  std::uint32_t face;
  if (ax >= ay && ax >= az) {
    m = ax, s = d.y, t = d.z, face = d.x > 0 ? 0 : 3;
  } else if (ay >= az) {
    m = ay, s = d.z, t = d.x, face = d.y > 0 ? 1 : 4;
  } else {
    m = az, s = d.x, t = d.y, face = d.z > 0 ? 2 : 5;
  }
  const double scale = (1 << (kBits - 1)) * 0.9999 / m;
  auto x = static_cast<std::uint32_t>((1 << (kBits - 1)) + s * scale);
  auto y = static_cast<std::uint32_t>((1 << (kBits - 1)) + t * scale);
  std::uint32_t place = face;
  for (std::uint32_t bit = 1u << (kBits - 1); bit != 0; bit >>= 1) {
    const bool right = x & bit, up = y & bit;
    place = place << 2 | (3 * right ^ up);
    if (!up) {
      if (right) {
        x = ~x;
        y = ~y;
      }
      std::swap(x, y);
    }
  }
  return place;
}

void orderAlongCurve(std::span<const Site> sites, OrderScratch& scratch, std::vector<std::uint32_t>& order) {
  scratch.keys.resize(sites.size());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    scratch.keys[i] = std::uint64_t{placeOnCurve(sites[i].at)} << 32 | i;
  }
  radixSort(scratch);
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
  // One in 32 along the curve is even over the directions; full builds were fastest with it.
  constexpr std::size_t kSample = 32;
  auto& reordered = scratch.order;
  reordered.clear();
  std::sort(extreme.begin(), extreme.end());
  reordered.insert(reordered.end(), extreme.begin(), std::unique(extreme.begin(), extreme.end()));
  for (const bool sample : {true, false}) {
    for (std::size_t k = 0; k < order.size(); ++k) {
      if ((k % kSample == 0) != sample) continue;
      if (std::find(extreme.begin(), extreme.end(), order[k]) == extreme.end()) reordered.push_back(order[k]);
    }
  }
  order.swap(reordered);
}

}  // namespace rsphere
