#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "contrib/tracked.h"
#include "rcontrib/contribution_options.h"

namespace rsphere {

// Consecutive columns of a record.
struct ColumnRange {
  uint32_t first = 0, count = 0;
};

// The contents of one output: a file, a command, or standard output.
struct OutputPlan {
  std::string name{};  // of the file, or "!command"; empty: standard output
  std::vector<ColumnRange> columns{};
  std::string modifier{};  // named in the header; empty: none
  std::string bin{};       // the number contained in its name; empty: none
  bool errors = false;     // whether it has standard errors (-oe) instead of values

  uint32_t columnCount() const;
};

// Names the outputs according to -o and -oe, in the order of first use. Throws rad::Error if one contains
// other formats than %s and %d, if a picture would have several values per pixel, or if an output would have
// values and standard errors.
std::vector<OutputPlan> planOutputs(const ContributionOptions& options, const Tracked& tracked);

}  // namespace rsphere
