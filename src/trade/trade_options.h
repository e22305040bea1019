#pragma once
#include <string>

#include "cli/option_table.h"

namespace rsphere {

// The options of rsphere-trade: those of rsphere, and its own.
struct TradeOptions : Options {
  int repeats = 4;            // -Tr
  int mostPoints = 32;        // -Tm
  double referenceError = 0;  // -Te  0: a tenth of the accuracy asked for
  bool bounces = false;       // -Tb
  std::string ladder;         // -Tl
  std::string table;          // -Tc
  std::string plot;           // -Tp
  std::string page;           // -Th
};

// rsphere-trade, for parseCompanion() with a TradeOptions.
const Companion& tradeCompanion();

}  // namespace rsphere
