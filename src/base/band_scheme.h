#pragma once
// The meaning of the values that a color may have in addition to red, green and blue.
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rsphere {

struct BandScheme {
  std::vector<uint8_t> channel;  // of each value: 0 red, 1 green, 2 blue
  // False: the values are the bands of a spectrum. True: each three values (red, green, blue) are the part of
  // the color due to one contributor, such as a goal or a lamp. The parts add up to the color, except for
  // light without a contributor.
  bool ofContributors = false;

  size_t count() const { return channel.size(); }
};

// The scheme for the parts of this number of contributors. Calls with the same number return the same object,
// which exists until the program ends. Thread-safe.
const BandScheme& partsOf(size_t contributors);

}  // namespace rsphere
