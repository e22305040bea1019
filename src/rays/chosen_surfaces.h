#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "scene/ids.h"

namespace rsphere {

// A small subset of many surfaces, numbered in order of their ids. It takes 2 bits for each surface of the
// scene, and finds the number of a surface in constant time.
class ChosenSurfaces {
 public:
  explicit ChosenSurfaces(size_t surfaces) : words_(surfaces / 64 + 1) {}

  // Adds a surface to the subset. REQUIRES: its id is above those added before.
  void add(SurfaceId surface) {
    const size_t word = surface.index() / 64;
    for (; last_ < word; ++last_) words_[last_ + 1].before = count_;
    words_[word].bits |= uint64_t{1} << surface.index() % 64;
    ++count_;
  }

  // The number of a surface in the subset; empty if it is not in the subset.
  std::optional<uint32_t> numberOf(SurfaceId surface) const {
    const Word& word = words_[surface.index() / 64];
    const uint64_t bit = uint64_t{1} << surface.index() % 64;
    if (!(word.bits & bit)) return std::nullopt;
    return word.before + static_cast<uint32_t>(std::popcount(word.bits & (bit - 1)));
  }

 private:
  struct Word {
    uint64_t bits = 0;
    uint32_t before = 0;  // number of chosen surfaces in all preceding words; valid up to last_
  };

  std::vector<Word> words_;
  size_t last_ = 0;
  uint32_t count_ = 0;
};

}  // namespace rsphere
