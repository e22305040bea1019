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

// What is written to one file, to one command, or to standard output.
struct OutputPlan {
  std::string name{};  // of the file, or "!command"; empty: standard output
  std::vector<ColumnRange> columns{};
  std::string modifier{};  // empty: several
  std::string bin{};       // the number in its name; empty: none

  uint32_t columnCount() const;
};

// Names the outputs as -o says, in the order in which they are first needed. Throws rad::Error if a -o has
// another format than %s and %d, or if a picture would have several values at a pixel.
std::vector<OutputPlan> planOutputs(const ContributionOptions& options, const Tracked& tracked);

}  // namespace rsphere
