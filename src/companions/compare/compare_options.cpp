#include "companions/compare/compare_options.h"

namespace rsphere {
namespace {

constexpr OptionEntry kCompareOptions[] = {
    {{"-Ct", "frac", "tolerance of relative differences", Group::companion, of<&CompareOptions::tolerance>,
      Range{0, 1}}},
    {{"-Cs", "frac", "fraction of records that may exceed it", Group::companion,
      of<&CompareOptions::shareBeyond>, Range{0, 1}}},
    {{"-Cr", "N", "repeats with other random numbers", Group::companion, of<&CompareOptions::repeats>,
      Range{2, 10000}, "repeats"}},
    {{"-Cn", "N", "rays of the original per point", Group::companion, of<&CompareOptions::orientations>,
      Range{8, 1e6}, "rays"},
     pointsOnly()},
    {{"-Cw", "N", "worst records shown", Group::companion, of<&CompareOptions::worst>, Range{0, 1e6},
      "records"}},
    {{"-Cp", "pic", "picture of the differences", Group::companion, of<&CompareOptions::differences>}},
    {{"-Ch", "file", "report as an HTML page", Group::companion, of<&CompareOptions::page>}},
};

}  // namespace

const Companion& compareCompanion() {
  static const Companion companion{kCompareOptions, "[options] scene... records", false, "rsphere-compare",
                                   static_cast<int>(CompareStatus::trouble)};
  return companion;
}

}  // namespace rsphere
