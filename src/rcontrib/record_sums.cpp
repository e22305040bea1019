#include "rcontrib/record_sums.h"

#include <algorithm>
#include <cstring>

namespace rsphere {

// Format: the number of columns, the columns, and the values of each.
void appendContributions(std::string& bytes, const ContributionList& list) {
  const auto count = static_cast<uint32_t>(list.columns().size());
  const auto append = [&bytes](const void* from, size_t size) {
    bytes.append(static_cast<const char*>(from), size);
  };
  append(&count, sizeof count);
  append(list.columns().data(), list.columns().size_bytes());
  append(list.values().data(), list.values().size_bytes());
}

RecordSums::RecordSums(ContributionOutputs& outputs, size_t columns, size_t components, uint64_t rays,
                       uint64_t skipped)
    : outputs_(outputs),
      components_(components),
      rays_(rays),
      skipped_(skipped),
      sums_(columns * components, 0) {}

void RecordSums::write(std::string_view bytes) {
  while (!bytes.empty()) {
    bytes.remove_prefix(addRay(bytes));
    if (++added_ == rays_) writeRecord(1 / static_cast<double>(rays_));
  }
}

// Returns the number of bytes used by the ray.
size_t RecordSums::addRay(std::string_view bytes) {
  uint32_t count = 0, column = 0;
  std::memcpy(&count, bytes.data(), sizeof count);
  const char* const columns = bytes.data() + sizeof count;
  const char* const values = columns + count * sizeof column;
  const size_t size = components_ * sizeof(double);
  for (size_t i = 0; i < count; ++i) {
    std::memcpy(&column, columns + i * sizeof column, sizeof column);
    for (size_t c = 0; c < components_; ++c) {
      double x = 0;
      std::memcpy(&x, values + i * size + c * sizeof x, sizeof x);
      sums_[column * components_ + c] += x;
    }
  }
  return sizeof count + count * (sizeof column + size);
}

void RecordSums::writeRecord(double factor) {
  if (skipped_ > 0)
    --skipped_;
  else
    outputs_.write(sums_, factor);
  std::fill(sums_.begin(), sums_.end(), 0);
  added_ = 0;
}

uint64_t RecordSums::end() {
  if (rays_ == 0) writeRecord(1);
  const uint64_t missing = added_ > 0 ? rays_ - added_ : 0;
  if (missing > 0) writeRecord(1 / static_cast<double>(added_));
  return missing;
}

}  // namespace rsphere
