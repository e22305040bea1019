#include "contrib/contribution_list.h"

#include <algorithm>

namespace rsphere {
namespace {

constexpr size_t kFirstSlots = 64;

// Fibonacci hashing.
size_t hashOf(uint32_t column) { return static_cast<size_t>((column * 0x9e3779b97f4a7c15u) >> 32); }

}  // namespace

ContributionList::ContributionList(int components)
    : components_(static_cast<size_t>(components)), slots_(kFirstSlots, 0) {}

void ContributionList::add(uint32_t column, std::span<const double> contribution) {
  const size_t first = positionOf(column) * components_;
  double* const sum = values_.data() + first;
  for (size_t c = 0; c < components_; ++c) sum[c] += contribution[c];
}

size_t ContributionList::positionOf(uint32_t column) {
  if (2 * (columns_.size() + 1) > slots_.size()) grow();
  const size_t mask = slots_.size() - 1;
  size_t slot = hashOf(column) & mask;
  for (; slots_[slot] != 0; slot = (slot + 1) & mask)
    if (columns_[slots_[slot] - 1] == column) return slots_[slot] - 1;
  columns_.push_back(column);
  values_.resize(values_.size() + components_, 0);
  slots_[slot] = static_cast<uint32_t>(columns_.size());
  return columns_.size() - 1;
}

void ContributionList::grow() {
  slots_.assign(2 * slots_.size(), 0);
  const size_t mask = slots_.size() - 1;
  for (size_t i = 0; i < columns_.size(); ++i) {
    size_t slot = hashOf(columns_[i]) & mask;
    while (slots_[slot] != 0) slot = (slot + 1) & mask;
    slots_[slot] = static_cast<uint32_t>(i + 1);
  }
}

void ContributionList::clear() {
  // The table keeps its size, unless it is much larger than its contents were.
  if (slots_.size() > kFirstSlots && columns_.size() * 16 < slots_.size()) slots_.resize(slots_.size() / 2);
  std::ranges::fill(slots_, 0);
  columns_.clear();
  values_.clear();
}

}  // namespace rsphere
