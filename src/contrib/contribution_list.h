#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace rsphere {

// Sums of the contributions of rays. Only columns with contributions are stored, so that the memory does not
// depend on the number of columns in a record.
class ContributionList {
 public:
  // components: number of values of a contribution, 3 or one for each band.
  explicit ContributionList(int components);

  // Adds a contribution to a column. REQUIRES components() values.
  void add(uint32_t column, std::span<const double> contribution);

  int components() const { return static_cast<int>(components_); }
  // The columns in the order of their first contribution.
  std::span<const uint32_t> columns() const { return columns_; }
  // components() values for each element of columns().
  std::span<const double> values() const { return values_; }

  // Its position in columns(). A new column is added, with values of 0.
  size_t positionOf(uint32_t column);

  void clear();

 private:
  void grow();

  size_t components_;
  std::vector<uint32_t> columns_;
  std::vector<double> values_;
  // A hash table with linear probing: position in columns_ + 1; 0: empty. Its size is a power of 2.
  std::vector<uint32_t> slots_;
};

}  // namespace rsphere
