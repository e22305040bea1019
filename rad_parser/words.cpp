#include "rad_parser/words.h"

#include <functional>

#include "rad_parser/error.h"

namespace rad {
namespace {

uint32_t hashOf(std::string_view word) {
  const uint64_t h = std::hash<std::string_view>{}(word);
  return static_cast<uint32_t>(h ^ (h >> 32));
}

}  // namespace

WordTable::WordTable(std::deque<std::string>& words) : words_(words), slots_(1024) {}

size_t WordTable::slotOf(std::string_view word, uint32_t hash) const {
  const size_t mask = slots_.size() - 1;
  size_t i = hash & mask;
  while (slots_[i].word != kNone && (slots_[i].hash != hash || words_[slots_[i].word] != word))
    i = (i + 1) & mask;
  return i;
}

uint32_t WordTable::find(std::string_view word) const { return slots_[slotOf(word, hashOf(word))].word; }

uint32_t WordTable::intern(std::string_view word) {
  const uint32_t hash = hashOf(word);
  size_t at = slotOf(word, hash);
  if (slots_[at].word != kNone) return slots_[at].word;
  if (2 * (interned_ + 1) > slots_.size()) {
    grow();
    at = slotOf(word, hash);
  }
  slots_[at] = {add(word), hash};
  ++interned_;
  return slots_[at].word;
}

uint32_t WordTable::add(std::string_view word) {
  if (words_.size() >= kNone) throw Error("too many different words");
  words_.emplace_back(word);
  return static_cast<uint32_t>(words_.size() - 1);
}

void WordTable::grow() {
  std::vector<Slot> larger(2 * slots_.size());
  const size_t mask = larger.size() - 1;
  for (const Slot& slot : slots_) {
    if (slot.word == kNone) continue;
    size_t i = slot.hash & mask;
    while (larger[i].word != kNone) i = (i + 1) & mask;
    larger[i] = slot;
  }
  slots_ = std::move(larger);
}

}  // namespace rad
