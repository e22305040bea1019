#pragma once
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace rad {

// Numbers distinct words. The words are appended to a list of the caller, which must be empty at first. The
// table is an open-addressing hash table of 8 bytes a slot. Words are never removed. Memory is in
// proportion to the number of words.
class WordTable {
 public:
  static constexpr uint32_t kNone = 0xffffffff;

  explicit WordTable(std::deque<std::string>& words);

  // The index of the word in the list, to which it is appended if it is new.
  uint32_t intern(std::string_view word);

  // The index of the word, or kNone.
  uint32_t find(std::string_view word) const;

 private:
  struct Slot {
    uint32_t word = kNone;
    uint32_t hash = 0;  // compared first, so that a probe rarely accesses the words
  };

  uint32_t add(std::string_view word);
  size_t slotOf(std::string_view word, uint32_t hash) const;
  void grow();

  std::deque<std::string>& words_;
  std::vector<Slot> slots_;  // the number of slots is a power of two; at most half are used
  size_t interned_ = 0;      // number of slots in use
};

}  // namespace rad
