#pragma once
// What the values are that a color may have besides red, green and blue.
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rsphere {

struct BandScheme {
  std::vector<uint8_t> channel;  // of each value: 0 red, 1 green, 2 blue
  // False: the values are the bands of a spectrum. True: each three of them, red, green and blue, are the
  // part of the color that one contributor gives, such as a goal or a lamp. Parts add up to the color, but
  // for light that has no contributor.
  bool ofContributors = false;

  size_t count() const { return channel.size(); }
};

// The parts of this number of contributors. Equal numbers have the same result, which exists until the
// program ends. Thread-safe.
const BandScheme& partsOf(size_t contributors);

}  // namespace rsphere
