#include "compare/compare_options.h"

namespace rsphere {
namespace {

constexpr double kMost = 1e6;

CompareOptions& own(Options& options) { return static_cast<CompareOptions&>(options); }

std::vector<OptionEntry> makeTable() {
  std::vector<OptionEntry> table;
  const auto add = [&table](OptionEntry entry) {
    entry.group = Group::companion;
    table.push_back(entry);
  };
  add({.name = "-Ct",
       .arguments = "frac",
       .value = +[](Options& o) -> double& { return own(o).tolerance; },
       .range = {0, 1},
       .remark = "tolerance of relative differences",
       .paragraph =
           "Relative difference that does not matter: of the mean over all records, and of each record."});
  add({.name = "-Cs",
       .arguments = "frac",
       .value = +[](Options& o) -> double& { return own(o).shareBeyond; },
       .range = {0, 1},
       .remark = "share of records that may be beyond it",
       .paragraph = "Share of the records that may differ by more than the tolerance and noise before the "
                    "programs are said to differ: rays that graze an edge may go to either side of it."});
  add({.name = "-Cr",
       .arguments = "N",
       .value = +[](Options& o) -> int& { return own(o).repeats; },
       .range = {2, 10000},
       .unit = "repeats",
       .remark = "repeats with other random numbers",
       .paragraph =
           "How often both programs answer each record, with other random numbers each time. What is "
           "compared are the means of these answers; how much they vary tells noise from bias."});
  add({.name = "-Cn",
       .arguments = "N",
       .value = +[](Options& o) -> int& { return own(o).orientations; },
       .range = {8, kMost},
       .unit = "rays",
       .remark = "rays a point, of the original",
       .paragraph = "Points only: orientations of the plane whose irradiance the original computes at each "
                    "point."});
  add({.name = "-Cw",
       .arguments = "N",
       .value = +[](Options& o) -> int& { return own(o).worst; },
       .range = {0, kMost},
       .unit = "records",
       .remark = "worst records shown",
       .paragraph = "How many of the records that differ most are shown, with what their rays hit."});
  add({.name = "-Cp",
       .arguments = "pic",
       .value = +[](Options& o) -> std::string& { return own(o).differences; },
       .remark = "picture of the differences",
       .paragraph =
           "Where the records form a picture (-x and -y): write their differences, in the format that the "
           "name says: how large they are in HDR, EXR and TIFF; else red where rsphere is brighter, blue "
           "where "
           "the original is, white where they are equal, and full color at ten times the tolerance."});
  return table;
}

}  // namespace

const Companion& compareCompanion() {
  static const std::vector<OptionEntry> table = makeTable();
  static const Companion companion{table, "[options] scene... records", false};
  return companion;
}

}  // namespace rsphere
