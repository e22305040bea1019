#pragma once
#include <string>
#include <vector>

#include "cli/option_table.h"
#include "contrib/tracked.h"

namespace rsphere {

// A modifier named by -m or -M, with its bins and output as defined by the preceding options. The definitions
// of -e and -f are common to the bins of all modifiers, as in RADIANCE, wherever they are given.
struct TrackedName {
  std::string name;
  BinDefinitions definitions;          // -e -f -p
  std::string bin = "0";               // -b
  std::string bins;                    // -bn; empty: not given
  BinDefinitions definitionsOfBins{};  // definitions before -bn, used to evaluate it
  std::string output{};                // -o; empty: standard output
  std::string errors{};                // -oe; empty: no standard errors

  bool operator==(const TrackedName&) const = default;
};

// The options of rcontrib: its own, and those of rtrace that affect light.
struct ContributionOptions : Options {
  std::vector<TrackedName> tracked;  // -m -M, in the order given
  TrackedName next;                  // settings for the next -m, without a name
  int raysPerRecord = 1;             // -c  0: a single record, the sum over all rays
  bool values = false;               // -V  values instead of coefficients
  bool overwrites = false;           // -fo
  bool recovers = false;             // -r

  // Whether records have standard errors.
  bool hasErrors() const;
  // Whether -x and -y are numbers of records. With -c 0 there is a single record, the sum of all rays.
  bool countsRecords() const { return raysPerRecord > 0; }
  bool hasResolution() const { return countsRecords() && width > 0 && height > 0; }
};

// The modifiers with their compiled bins. Throws rad::Error if a definition or an expression is invalid, or
// if the number of bins is missing or invalid.
std::vector<TrackedModifier> trackedModifiers(const ContributionOptions& options);

// Warnings of those of -b -bn -p -o -oe that no modifier has, because they follow the last -m and -M.
// RADIANCE ignores them.
std::vector<std::string> warningsOfUnused(const ContributionOptions& options);

// Describes rcontrib for parseCompanion(), with ContributionOptions.
const Companion& contributionCompanion();

// Completes options that depend on each other. Throws rad::Error if they contradict each other or name no
// modifier.
void finish(ContributionOptions& options);

}  // namespace rsphere
