#include "trade/trade_options.h"

namespace rsphere {
namespace {

TradeOptions& own(Options& options) { return static_cast<TradeOptions&>(options); }

std::vector<OptionEntry> makeTable() {
  std::vector<OptionEntry> table;
  const auto add = [&table](OptionEntry entry) {
    entry.group = Group::companion;
    table.push_back(entry);
  };
  add({.name = "-Tr",
       .arguments = "N",
       .value = +[](Options& o) -> int& { return own(o).repeats; },
       .range = {2, 10000},
       .unit = "repeats",
       .remark = "repeats of a setting",
       .paragraph = "How often each setting answers each point, with other rotations and random numbers each "
                    "time. Errors are known to about one part in the square root of twice the answers."});
  add({.name = "-Tm",
       .arguments = "N",
       .value = +[](Options& o) -> int& { return own(o).mostPoints; },
       .range = {1, 1e6},
       .unit = "points",
       .remark = "most points measured",
       .paragraph =
           "Of a file with more points, so many of them are measured, from its beginning to its end."});
  add({.name = "-Te",
       .arguments = "frac",
       .value = +[](Options& o) -> double& { return own(o).referenceError; },
       .range = {0, 1},
       .remark = "error of the reference",
       .paragraph =
           "The reference is the mean of answers with ever other rotations, until its relative standard "
           "error (root mean square over the points) is below this. 0: a tenth of the accuracy asked for."});
  add({.name = "-Tb",
       .value = +[](Options& o) -> bool& { return own(o).bounces; },
       .remark = "fewer bounces on|fewer bounces off",
       .paragraph =
           "Switch for settings with fewer bounces than -ab has. What they leave out shows as a bias "
           "against the reference, which has them all."});
  add({.name = "-Tl",
       .arguments = "file",
       .value = +[](Options& o) -> std::string& { return own(o).ladder; },
       .remark = "settings of one's own",
       .paragraph =
           "Settings to measure instead of the usual ones, each a line of rsphere's options. From # on a "
           "line is a remark."});
  add({.name = "-Tc",
       .arguments = "file",
       .value = +[](Options& o) -> std::string& { return own(o).table; },
       .remark = "table as a CSV file",
       .paragraph =
           "Write the figures to a file of comma-separated values; errors are shares, not per cent."});
  add({.name = "-Tp",
       .arguments = "file",
       .value = +[](Options& o) -> std::string& { return own(o).plot; },
       .remark = "plot as an SVG file",
       .paragraph = "Draw error against time as an SVG file."});
  return table;
}

}  // namespace

const Companion& tradeCompanion() {
  static const std::vector<OptionEntry> table = makeTable();
  static const Companion companion{table, "[options] scene... points", true};
  return companion;
}

}  // namespace rsphere
