#include "companions/trade/trade_options.h"

namespace rsphere {
namespace {

constexpr OptionEntry kTradeOptions[] = {
    {{"-Tr", "N", "repeats of a setting", Group::companion, of<&TradeOptions::repeats>, Range{2, 10000},
      "repeats"}},
    {{"-Tm", "N", "most points measured", Group::companion, of<&TradeOptions::mostPoints>, Range{1, 1e6},
      "points"}},
    {{"-Te", "frac", "error of the reference", Group::companion, of<&TradeOptions::referenceError>,
      Range{0, 1}}},
    {{"-Tb", "", "fewer bounces on|fewer bounces off", Group::companion, of<&TradeOptions::bounces>}},
    {{"-Tl", "file", "user-defined settings", Group::companion, of<&TradeOptions::ladder>}},
    {{"-Tc", "file", "table as a CSV file", Group::companion, of<&TradeOptions::table>}},
    {{"-Tp", "file", "plot as an SVG file", Group::companion, of<&TradeOptions::plot>}},
    {{"-Th", "file", "report as an HTML page", Group::companion, of<&TradeOptions::page>}},
};

}  // namespace

const Companion& tradeCompanion() {
  static const Companion companion{kTradeOptions, "[options] scene... points", true, "rsphere-trade"};
  return companion;
}

}  // namespace rsphere
