#pragma once
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace rad {

// Numbers distinct words. They are appended to the caller's list, which must be empty at first, and are never
// removed. This is an open-addressing hash table with 8 bytes a slot. Memory is in proportion to the number
// of words.
class WordTable {
 public:
  static constexpr uint32_t kNone = 0xffffffff;

  explicit WordTable(std::deque<std::string>& words);

  // The index of a word in the list; a new word is appended.
  uint32_t intern(std::string_view word);

  // The index of the word, or kNone.
  uint32_t find(std::string_view word) const;

 private:
  struct Slot {
    uint32_t word = kNone;
    uint32_t hash = 0;  // compared before the words, which are therefore rarely accessed
  };

  uint32_t add(std::string_view word);
  size_t slotOf(std::string_view word, uint32_t hash) const;
  void grow();

  std::deque<std::string>& words_;
  std::vector<Slot> slots_;  // their number is a power of two; at most half of them are used
  size_t interned_ = 0;      // number of slots in use
};

}  // namespace rad
