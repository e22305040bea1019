#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rad {

// Gives each distinct word one number, in a list of the caller's that is empty at first: an open hash table
// of 8 bytes a slot. Words are never removed. Memory is in proportion to the distinct words.
class WordTable {
 public:
  static constexpr uint32_t kNone = 0xffffffff;

  explicit WordTable(std::vector<std::string>& words);

  // The word's index in the list; appended where it is new.
  uint32_t intern(std::string_view word);

  // The word's index, or kNone.
  uint32_t find(std::string_view word) const;

 private:
  struct Slot {
    uint32_t word = kNone;
    uint32_t hash = 0;  // compared first, so that a probe seldom touches the words themselves
  };

  size_t slotOf(std::string_view word, uint32_t hash) const;
  void grow();

  std::vector<std::string>& words_;
  std::vector<Slot> slots_;  // a power of two of them, at most half full
};

}  // namespace rad
