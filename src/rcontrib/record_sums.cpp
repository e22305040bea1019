#include "rcontrib/record_sums.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace rsphere {

// Format: the number of columns, the columns, the values of each, and as many variances or none.
void appendContributions(std::string& bytes, const ContributionList& list,
                         std::span<const double> variances) {
  const auto count = static_cast<uint32_t>(list.columns().size());
  const auto append = [&bytes](const void* from, size_t size) {
    bytes.append(static_cast<const char*>(from), size);
  };
  append(&count, sizeof count);
  append(list.columns().data(), list.columns().size_bytes());
  append(list.values().data(), list.values().size_bytes());
  append(variances.data(), variances.size_bytes());
}

RecordSums::RecordSums(ContributionOutputs& outputs, size_t columns, size_t components, uint64_t rays,
                       uint64_t skipped, bool errors)
    : outputs_(outputs),
      components_(components),
      rays_(rays),
      skipped_(skipped),
      sums_(columns * components, 0),
      squares_(errors ? sums_.size() : 0, 0) {}

void RecordSums::write(std::string_view bytes) {
  while (!bytes.empty()) {
    bytes.remove_prefix(addRay(bytes));
    if (++added_ == rays_) writeRecord();
  }
}

// Returns the number of bytes used by the ray.
size_t RecordSums::addRay(std::string_view bytes) {
  uint32_t count = 0, column = 0;
  std::memcpy(&count, bytes.data(), sizeof count);
  const bool hasVariances = !squares_.empty() && rays_ == 1;
  const size_t size = components_ * sizeof(double);
  const char* const columns = bytes.data() + sizeof count;
  const char* const values = columns + count * sizeof column;
  const char* const variances = values + count * size;
  for (size_t i = 0; i < count; ++i) {
    std::memcpy(&column, columns + i * sizeof column, sizeof column);
    for (size_t c = 0; c < components_; ++c) {
      double x = 0;
      std::memcpy(&x, values + i * size + c * sizeof x, sizeof x);
      sums_[column * components_ + c] += x;
      if (squares_.empty()) continue;
      double square = x * x;
      if (hasVariances) std::memcpy(&square, variances + i * size + c * sizeof square, sizeof square);
      squares_[column * components_ + c] += square;
    }
  }
  return sizeof count + count * (sizeof column + (hasVariances ? 2 : 1) * size);
}

void RecordSums::writeRecord() {
  const auto n = static_cast<double>(added_);
  const double factor = rays_ == 0 ? 1 : 1 / n;
  for (size_t i = 0; i < squares_.size(); ++i) {
    // The variance of the sum of n rays is n s^2.
    if (rays_ != 1) squares_[i] = n > 1 ? (squares_[i] * n - sums_[i] * sums_[i]) / (n - 1) : 0;
    squares_[i] = factor * std::sqrt(std::max(0., squares_[i]));
  }
  for (double& sum : sums_) sum *= factor;
  if (skipped_ > 0)
    --skipped_;
  else
    outputs_.write(sums_, squares_);
  std::ranges::fill(sums_, 0);
  std::ranges::fill(squares_, 0);
  added_ = 0;
}

uint64_t RecordSums::end() {
  if (rays_ == 0) writeRecord();
  const uint64_t missing = added_ > 0 ? rays_ - added_ : 0;
  if (missing > 0) writeRecord();
  return missing;
}

}  // namespace rsphere
