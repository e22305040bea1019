#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "base/random.h"

namespace rsphere {

// A stream of random numbers. The first kDimensions are a point of Sobol's sequence in the unit cube,
// scrambled by Owen's method with hashing (Burley 2020, "Practical hash-based Owen scrambling"). The points
// of one seed are spread evenly, best in blocks of 2^k points that begin at a multiple of 2^k. Each point is
// uniform over the cube.
class ScrambledPoint {
 public:
  static constexpr size_t kDimensions = 5;

  // index: of the point. rest: gives the numbers after the first kDimensions; kept as a reference.
  ScrambledPoint(uint32_t index, uint64_t seed, Random& rest) : rest_(rest) {
    std::array<uint32_t, kDimensions> x{};
    for (size_t bit = 0; index != 0; index >>= 1, ++bit)
      if (index & 1)
        for (size_t d = 0; d < kDimensions; ++d) x[d] ^= kDirections[bit][d];
    for (size_t d = 0; d < kDimensions; ++d)
      numbers_[d] = scrambled(x[d], static_cast<uint32_t>(mixBits(seed + d))) * 0x1p-32;
  }

  double uniform() { return next_ < kDimensions ? numbers_[next_++] : rest_.uniform(); }

 private:
  using Directions = std::array<std::array<uint32_t, kDimensions>, 32>;
  // Direction numbers by their recurrence, with the initial values of Joe and Kuo 2008.
  static constexpr Directions directions() {
    struct Polynomial {
      uint32_t degree, inner;  // coefficients between the first and the last
      std::array<uint32_t, 3> first;
    };
    constexpr std::array<Polynomial, kDimensions - 1> kPolynomials{
        {{1, 0, {1}}, {2, 1, {1, 3}}, {3, 1, {1, 3, 1}}, {3, 2, {1, 1, 1}}}};
    Directions v{};
    for (uint32_t i = 0; i < 32; ++i) v[i][0] = 1u << (31 - i);
    for (size_t d = 1; d < kDimensions; ++d) {
      const auto& [degree, inner, first] = kPolynomials[d - 1];
      for (uint32_t i = 0; i < degree; ++i) v[i][d] = first[i] << (31 - i);
      for (uint32_t i = degree; i < 32; ++i) {
        v[i][d] = v[i - degree][d] ^ (v[i - degree][d] >> degree);
        for (uint32_t k = 1; k < degree; ++k)
          if (inner >> (degree - 1 - k) & 1) v[i][d] ^= v[i - k][d];
      }
    }
    return v;
  }
  static constexpr uint32_t reversed(uint32_t x) {
    x = (x >> 1 & 0x55555555u) | (x & 0x55555555u) << 1;
    x = (x >> 2 & 0x33333333u) | (x & 0x33333333u) << 2;
    x = (x >> 4 & 0x0f0f0f0fu) | (x & 0x0f0f0f0fu) << 4;
    return __builtin_bswap32(x);
  }
  // Each bit is flipped by a hash of the bits above it (Laine and Karras 2011).
  static constexpr uint32_t scrambled(uint32_t x, uint32_t seed) {
    x = reversed(x) + seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return reversed(x);
  }
  static const Directions kDirections;

  std::array<double, kDimensions> numbers_;
  size_t next_ = 0;
  Random& rest_;
};

inline constexpr ScrambledPoint::Directions ScrambledPoint::kDirections = ScrambledPoint::directions();

}  // namespace rsphere
