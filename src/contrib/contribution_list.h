#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace rsphere {

// Sums of what rays contribute, for those columns only that something was added to. Its memory is in
// proportion to their number, however many columns a record has.
class ContributionList {
 public:
  // components: numbers of a contribution, 3 or one for each band.
  explicit ContributionList(int components);

  // Adds a contribution to a column. REQUIRES components() numbers.
  void add(uint32_t column, std::span<const double> contribution);

  int components() const { return static_cast<int>(components_); }
  // In the order in which something was first added to them.
  std::span<const uint32_t> columns() const { return columns_; }
  // components() numbers for each of these columns.
  std::span<const double> values() const { return values_; }

  void clear();

 private:
  size_t positionOf(uint32_t column);
  void grow();

  size_t components_;
  std::vector<uint32_t> columns_;
  std::vector<double> values_;
  // A hash table with linear probing: position in columns_ + 1; 0: empty. Its size is a power of 2.
  std::vector<uint32_t> slots_;
};

}  // namespace rsphere
