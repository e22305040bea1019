#pragma once
// How much radiance varies on special objects, compared with how much it varies elsewhere. It is
// measured once per scene with rays whose values are used for nothing else, so that the estimates
// at points stay unbiased.
#include <span>
#include <vector>

#include "importance/seen_sources.h"
#include "importance/special_objects.h"

namespace rsphere {

struct Contrasts {
  struct Object {
    SpecialObject object;
    double deviation = 0;  // standard deviation of the brightness on it, without light sources, W/sr/m2
  };
  std::vector<Object> objects;
  // Standard deviation of the brightness that one base direction finds, without light sources, relative to
  // the mean brightness. 1 where it was not measured.
  double surroundings = 1;
};

// Objects that share a modifier share a measurement. The answer depends on the scene and the options of
// transport alone. Without special objects nothing is traced.
// sources: those integrated apart, which do not enter. spots: what indirect rays are aimed at, or null.
Contrasts measureContrasts(const Transport& transport, std::span<const SpecialObject> objects,
                           const SeenSources& sources, const BrightSpots* spots);

}  // namespace rsphere
