#include "compare/compare_options.h"

namespace rsphere {
namespace {

constexpr double kMost = 1e6;

CompareOptions& own(Options& options) { return static_cast<CompareOptions&>(options); }

std::vector<OptionEntry> makeTable() {
  std::vector<OptionEntry> table;
  const auto add = [&table](const OptionEntry& entry) { table.push_back(entry); };
  add({.name = "-Ct",
       .arguments = "frac",
       .value = +[](Options& o) -> double& { return own(o).tolerance; },
       .range = {0, 1},
       .remark = "tolerance of relative differences",
       .paragraph = "Tolerance: relative differences up to this do not matter, neither of the mean over all "
                    "records nor of a single record."});
  add({.name = "-Cs",
       .arguments = "frac",
       .value = +[](Options& o) -> double& { return own(o).shareBeyond; },
       .range = {0, 1},
       .remark = "share of records that may be beyond it",
       .paragraph =
           "Share of the records that may differ by more than the tolerance and noise explain. If more "
           "do, the programs differ. A few records may, because a ray that grazes an edge can pass on "
           "either side of it."});
  add({.name = "-Cr",
       .arguments = "N",
       .value = +[](Options& o) -> int& { return own(o).repeats; },
       .range = {2, 10000},
       .unit = "repeats",
       .remark = "repeats with other random numbers",
       .paragraph =
           "Number of times that both programs answer each record, with other random numbers each time. "
           "The means of these answers are compared; their variance distinguishes bias from noise."});
  add({.name = "-Cn",
       .arguments = "N",
       .value = +[](Options& o) -> int& { return own(o).orientations; },
       .range = {8, kMost},
       .unit = "rays",
       .remark = "rays a point, of the original",
       .paragraph = "For points (-S) only: number of orientations of the plane whose irradiance the original "
                    "computes at each point."});
  add({.name = "-Cw",
       .arguments = "N",
       .value = +[](Options& o) -> int& { return own(o).worst; },
       .range = {0, kMost},
       .unit = "records",
       .remark = "worst records shown",
       .paragraph =
           "Number of records shown of those that differ most, with the surfaces that their rays hit."});
  add({.name = "-Cp",
       .arguments = "pic",
       .value = +[](Options& o) -> std::string& { return own(o).differences; },
       .remark = "picture of the differences",
       .paragraph =
           "Write a picture of the differences, if the records form a picture (-x and -y). The extension "
           "of the name gives the format. HDR, EXR and TIFF files hold the relative differences "
           "themselves, without their sign. Other files are red where rsphere is brighter, blue where the "
           "original is brighter, and white where both are equal; colors are full at ten times the "
           "tolerance."});
  for (OptionEntry& entry : table) entry.group = Group::companion;
  return table;
}

}  // namespace

const Companion& compareCompanion() {
  static const std::vector<OptionEntry> table = makeTable();
  static const Companion companion{table, "[options] scene... records", false, "rsphere-compare",
                                   static_cast<int>(CompareStatus::trouble)};
  return companion;
}

}  // namespace rsphere
