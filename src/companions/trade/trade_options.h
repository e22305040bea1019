#pragma once
#include <string>

#include "cli/option_table.h"

namespace rsphere {

// The options of rsphere-trade: its own and those of rsphere.
struct TradeOptions : Options {
  int repeats = 4;            // -Tr
  int mostPoints = 32;        // -Tm
  double referenceError = 0;  // -Te  0: a tenth of the requested accuracy
  bool bounces = false;       // -Tb
  std::string ladder;         // -Tl
  std::string table;          // -Tc
  std::string plot;           // -Tp
  std::string page;           // -Th
};

// Describes rsphere-trade for parseCompanion(), with TradeOptions.
const Companion& tradeCompanion();

}  // namespace rsphere
