#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "answer/record_writer.h"
#include "contrib/contribution_list.h"
#include "rcontrib/contribution_outputs.h"

namespace rsphere {

// Appends what a ray contributes to `bytes`, as RecordSums reads it.
void appendContributions(std::string& bytes, const ContributionList& list);

// Adds up the contributions of rays, in their order, into records. It holds the bins of one record, however
// many threads trace rays: what they hand over is as long as the number of bins that a ray has reached.
class RecordSums final : public RecordSink {
 public:
  // columns: of a record. rays: whose mean is a record; 0: a record is the sum of all. skipped: records whose
  // rays count as none. Keeps a reference.
  RecordSums(ContributionOutputs& outputs, size_t columns, size_t components, uint64_t rays,
             uint64_t skipped);

  void write(std::string_view bytes) override;
  void flush() override { outputs_.flush(); }
  void holdUntilFlush(bool hold) override { outputs_.holdUntilFlush(hold); }

  // Writes the last record, if some of its rays are missing (the mean of those that are there), or if it is
  // the sum. Returns the number of rays that are missing.
  uint64_t end();

 private:
  size_t addRay(std::string_view bytes);
  void writeRecord(double factor);

  ContributionOutputs& outputs_;
  const size_t components_;
  const uint64_t rays_;
  uint64_t skipped_;
  std::vector<double> sums_;
  uint64_t added_ = 0;  // rays of the present record
};

}  // namespace rsphere
