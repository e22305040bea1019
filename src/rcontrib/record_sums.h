#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "contrib/contribution_list.h"
#include "rcontrib/contribution_outputs.h"
#include "records/record_writer.h"

namespace rsphere {

// Appends the contributions of a ray to `bytes`, in the format that RecordSums reads. variances: of its
// values, or none.
void appendContributions(std::string& bytes, const ContributionList& list,
                         std::span<const double> variances = {});

// Sums the contributions of rays, in their order, to records. It stores all bins of a single record,
// regardless of the number of threads. The data passed by threads only contain the bins that a ray has
// reached.
//
// The standard errors (-oe) of a record of one ray are those of the ray. Those of a record of several rays
// follow from the spread of the rays, which are samples of the place or the pixel that the record stands for.
class RecordSums final : public RecordSink {
 public:
  // columns: in a record. rays: a record is the mean over this number of rays; 0: it is the sum over all
  // rays. skipped: number of records at the start that are not written. errors: whether records have standard
  // errors. Keeps a reference.
  RecordSums(ContributionOutputs& outputs, size_t columns, size_t components, uint64_t rays, uint64_t skipped,
             bool errors);

  void write(std::string_view bytes) override;
  void flush() override { outputs_.flush(); }
  void holdUntilFlush(bool hold) override { outputs_.holdUntilFlush(hold); }

  // Writes the last record, if it is the sum, or if some of its rays are missing (as the mean over the
  // others). Returns the number of missing rays.
  uint64_t end();

 private:
  size_t addRay(std::string_view bytes);
  void writeRecord();

  ContributionOutputs& outputs_;
  const size_t components_;
  const uint64_t rays_;
  uint64_t skipped_;
  std::vector<double> sums_;
  std::vector<double> squares_;  // of rays, or variances of one ray; empty without errors
  uint64_t added_ = 0;           // rays in the current record
};

}  // namespace rsphere
