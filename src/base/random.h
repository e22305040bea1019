#pragma once
#include <bit>
#include <cstdint>
#include <span>

namespace rsphere {

// Mixes 64 bits so that every input bit affects every output bit (SplitMix64's finalizer; Steele,
// Lea, Flood 2014).
inline uint64_t mixBits(uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

// The seed of a record, computed from its numbers only, so that its answer does not depend on neighbouring
// records. -0 and 0 give the same seed.
inline uint64_t seedOf(std::span<const double> numbers, uint64_t seed = 0) {
  for (double x : numbers) seed = mixBits(seed ^ std::bit_cast<uint64_t>(x == 0 ? 0. : x));
  return seed;
}

// A stream of uniform random numbers: xoroshiro128+ (Blackman and Vigna 2018), of which 53 of 64 bits are
// used; period 2^128 - 1. The state is filled by SplitMix64, so that streams with different seeds are
// independent for Monte Carlo integration.
class Random {
 public:
  explicit Random(uint64_t seed) : a_(mixBits(seed)), b_(mixBits(seed + 0x9e3779b97f4a7c15u)) {}

  uint64_t bits() {
    const uint64_t sum = a_ + b_;
    const uint64_t x = a_ ^ b_;
    a_ = std::rotl(a_, 24) ^ x ^ (x << 16);
    b_ = std::rotl(x, 37);
    return sum;
  }
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }  // in [0, 1)

 private:
  uint64_t a_, b_;
};

}  // namespace rsphere
