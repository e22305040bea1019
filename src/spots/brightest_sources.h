#pragma once
// Finds the light sources that light a place most without examining all sources: in a tall building, the
// lamps of other storeys are far away.
#include <vector>

#include "scene/box_tree.h"
#include "spots/source_parts.h"

namespace rsphere {

class BrightestSources {
 public:
  // Keeps references.
  BrightestSources(const Scene& scene, const LightSources& lights);

  // The parts of sources that may light objects within a radius (world units) around places in a box
  // (partsThatLight()), in the order of the sources. Parts are left out only if `most` other parts have a
  // larger product of radiance and solid angle. placeFor: the place in the box from which a source is seen.
  std::vector<LightingPart> at(const Box3d& places, double radius, size_t most,
                               FunctionRef<V3d(const LightSource&)> placeFor) const;

 private:
  const Scene& scene_;
  const LightSources& lights_;
  std::vector<uint32_t> distant_;
  BoxTree tree_;
  std::vector<double> most_;  // by node: the largest product of radiance and area of a source (W/sr)
};

}  // namespace rsphere
