#include "companions/trade/trade_options.h"

namespace rsphere {
namespace {

TradeOptions& own(Options& options) { return static_cast<TradeOptions&>(options); }

std::vector<OptionEntry> makeTable() {
  std::vector<OptionEntry> table;
  const auto add = [&table](const OptionEntry& entry) { table.push_back(entry); };
  add({.name = "-Tr",
       .arguments = "N",
       .value = +[](Options& o) -> int& { return own(o).repeats; },
       .range = {2, 10000},
       .unit = "repeats",
       .remark = "repeats of a setting",
       .paragraph =
           "Number of times that each setting answers each point, with other rotations and random numbers "
           "each time. The relative uncertainty of a measured error is about one over the square root of "
           "twice the number of answers."});
  add({.name = "-Tm",
       .arguments = "N",
       .value = +[](Options& o) -> int& { return own(o).mostPoints; },
       .range = {1, 1e6},
       .unit = "points",
       .remark = "most points measured",
       .paragraph =
           "Largest number of points that are measured. If the file has more, points spread evenly over "
           "it are used."});
  add({.name = "-Te",
       .arguments = "frac",
       .value = +[](Options& o) -> double& { return own(o).referenceError; },
       .range = {0, 1},
       .remark = "error of the reference",
       .paragraph =
           "Relative standard error of the reference (root mean square over the points). Answers with other "
           "rotations are added to the reference until its error is below this value. 0 selects a tenth of "
           "the requested accuracy."});
  add({.name = "-Tb",
       .value = +[](Options& o) -> bool& { return own(o).bounces; },
       .remark = "fewer bounces on|fewer bounces off",
       .paragraph =
           "Toggles settings with fewer bounces than -ab, besides the usual ones or those of -Tl. The light "
           "that they leave out appears as a bias against the reference, which has the bounces of -ab. To "
           "measure how much light the bounces after the third add, for example, use -Tb -ab 8 and read the "
           "line of -ab 3."});
  add({.name = "-Tl",
       .arguments = "file",
       .value = +[](Options& o) -> std::string& { return own(o).ladder; },
       .remark = "user-defined settings",
       .paragraph = "File of settings to measure instead of the usual ones. Each line has the options of one "
                    "setting; the text after # is a comment."});
  add({.name = "-Tc",
       .arguments = "file",
       .value = +[](Options& o) -> std::string& { return own(o).table; },
       .remark = "table as a CSV file",
       .paragraph = "Writes the table to a file of comma-separated values. Errors are fractions there, not "
                    "percentages."});
  add({.name = "-Tp",
       .arguments = "file",
       .value = +[](Options& o) -> std::string& { return own(o).plot; },
       .remark = "plot as an SVG file",
       .paragraph =
           "Writes a plot of error against time, as an SVG file. Names with another picture extension are "
           "refused."});
  add({.name = "-Th",
       .arguments = "file",
       .value = +[](Options& o) -> std::string& { return own(o).page; },
       .remark = "report as an HTML page",
       .paragraph =
           "Writes the report as one HTML page for a browser: the recommended command, the plot, the table "
           "with the recommended setting marked, the points and their mean radiance, the options, the date "
           "and the version. The page needs no other file, no network and no scripts, and can be printed."});
  for (OptionEntry& entry : table) entry.group = Group::companion;
  return table;
}

}  // namespace

const Companion& tradeCompanion() {
  static const std::vector<OptionEntry> table = makeTable();
  static const Companion companion{table, "[options] scene... points", true, "rsphere-trade"};
  return companion;
}

}  // namespace rsphere
