#pragma once
#include <string>
#include <vector>

#include "cli/option_table.h"
#include "contrib/tracked.h"

namespace rsphere {

// A modifier that -m or -M names, with what the options before it say of its bins and its output.
struct TrackedName {
  std::string name;
  BinDefinitions definitions;          // -e -f -p
  std::string bin = "0";               // -b
  std::string bins;                    // -bn; empty: not given
  BinDefinitions definitionsOfBins{};  // those before -bn, which is evaluated with them
  std::string output{};                // -o; empty: standard output
};

// The options of rcontrib: those of rtrace that concern light, and its own.
struct ContributionOptions : Options {
  std::vector<TrackedName> tracked;  // -m -M, in their order
  TrackedName next;                  // what the next -m gets; without a name
  int raysPerRecord = 1;             // -c  0: one record of all rays, their sum
  bool values = false;               // -V  values instead of coefficients
  bool overwrites = false;           // -fo
  bool recovers = false;             // -r
};

// The modifiers with their bins compiled. Throws rad::Error if a definition or an expression is wrong, or if
// a number of bins is missing or is none.
std::vector<TrackedModifier> trackedModifiers(const ContributionOptions& options);

// rcontrib, for parseCompanion() with a ContributionOptions.
const Companion& contributionCompanion();

// Sets what the options together mean. Throws rad::Error if they contradict each other or leave nothing to be
// tracked.
void finish(ContributionOptions& options);

}  // namespace rsphere
