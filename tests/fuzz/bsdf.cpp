// Reads BSDF files and evaluates them.
#include "shade/bsdf.h"

#include <cmath>
#include <cstdlib>
#include <optional>
#include <string_view>

#include "rad_parser/error.h"
#include "rad_parser/tables/bsdf_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  using namespace rsphere;
  std::optional<BsdfData> bsdf;
  try {
    bsdf.emplace(rad::BsdfFile::parse(text, "fuzz.xml"), "fuzz.xml", rad::Warn{});
  } catch (const rad::Error&) {
    return 0;
  }
  const V3d directions[] = {{0, 0, 1}, {0, 0, -1}, {.6, 0, .8}, {.6, 0, -.8}, {-.48, .64, .6}, {0, 1, 0}};
  for (const V3d& view : directions) {
    static_cast<void>(bsdf->through(view));
    static_cast<void>(bsdf->resolution(view));
    for (const V3d& other : directions)
      if (const DirectedScattering* part = bsdf->between(view, other))
        if (!(part->cell(view, other).value.y >= 0)) std::abort();
    for (const DirectedScattering* part : {bsdf->reflection(view.z > 0), bsdf->transmission(view.z > 0)}) {
      if (!part || !(part->albedo(view) > 0)) continue;
      for (double u : {0., .3, 1 - 0x1p-53})
        if (!(std::abs(part->sample(view, u, .5).length() - 1) < 1e-6)) std::abort();
    }
  }
  return 0;
}
