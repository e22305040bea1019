#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rad {

// Gives each distinct word one number, in a list of the caller's that is empty at first: an open hash table
// of 8 bytes a slot. Words are never removed. Memory is in proportion to the words in the list.
class WordTable {
 public:
  static constexpr uint32_t kNone = 0xffffffff;

  explicit WordTable(std::vector<std::string>& words);

  // The word's index in the list; appended where it is new.
  uint32_t intern(std::string_view word);

  // Appends a word that nobody will look for, without a place in the table: for surfaces' names, which differ
  // from one another in most scenes, a look there is a cache miss each, a sixth of the time to load. The same
  // word again and again is one entry.
  uint32_t append(std::string_view word);

  // The word's index, or kNone.
  uint32_t find(std::string_view word) const;

 private:
  struct Slot {
    uint32_t word = kNone;
    uint32_t hash = 0;  // compared first, so that a probe seldom touches the words themselves
  };

  uint32_t add(std::string_view word);
  size_t slotOf(std::string_view word, uint32_t hash) const;
  void grow();

  std::vector<std::string>& words_;
  std::vector<Slot> slots_;  // a power of two of them, at most half full
  size_t interned_ = 0;      // of them full
  uint32_t appended_ = kNone;
};

}  // namespace rad
