#include "companions/compare/compare_options.h"

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
       .paragraph =
           "Tolerance: relative differences up to this value are accepted, both of the mean over all "
           "records and of single records."});
  add({.name = "-Cs",
       .arguments = "frac",
       .value = +[](Options& o) -> double& { return own(o).shareBeyond; },
       .range = {0, 1},
       .remark = "share of records that may be beyond it",
       .paragraph =
           "Share of the records that may differ by more than the tolerance and the noise explain. If more "
           "records do, the programs differ. A few records may do so without a fault, because a ray that "
           "grazes an edge can pass on either side of it."});
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
       .remark = "rays of the original per point",
       .mode = Mode::points,
       .paragraph =
           "Number of orientations of the plane whose irradiance the original computes at each point. For "
           "points (-S) only."});
  add({.name = "-Cw",
       .arguments = "N",
       .value = +[](Options& o) -> int& { return own(o).worst; },
       .range = {0, kMost},
       .unit = "records",
       .remark = "worst records shown",
       .paragraph =
           "Number of records that the report shows of those that differ most, with the surfaces that "
           "their rays hit."});
  add({.name = "-Cp",
       .arguments = "pic",
       .value = +[](Options& o) -> std::string& { return own(o).differences; },
       .remark = "picture of the differences",
       .paragraph =
           "Writes a picture of the differences, if the records form a picture (-x and -y). The extension "
           "of the name selects the format. HDR, EXR and TIFF files contain the relative differences "
           "themselves, without their sign. Other files are red where rsphere is brighter, blue where the "
           "original is brighter, and white where both are equal; colors are fully saturated at ten times "
           "the tolerance."});
  add({.name = "-Ch",
       .arguments = "file",
       .value = +[](Options& o) -> std::string& { return own(o).page; },
       .remark = "report as an HTML page",
       .paragraph =
           "Writes the report as one HTML page for a browser: the verdict, the figures, a plot of each "
           "record's answer against the original's, a histogram of the differences, the worst records, the "
           "options, the date and the versions. If the records form a picture (-x and -y), the page has both "
           "pictures and their difference, too. It needs no other file, no network and no scripts, and can "
           "be printed."});
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
