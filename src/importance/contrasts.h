#pragma once
// Measures how much radiance varies on special objects, compared with the rest of the view. The rays of these
// measurements enter no estimate, so that estimates at points stay unbiased.
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "importance/seen_sources.h"
#include "importance/special_objects.h"
#include "importance/sphere_tracing.h"

namespace rsphere {

// Shared by all threads. Objects with the same modifier share one measurement, which is made when a point
// first asks for it: in a building, most objects are hidden from all points. The results depend only on the
// scene and the options.
class Contrasts {
 public:
  // Nothing is traced if there are no objects and no openings. sources: those that are integrated separately;
  // rays that hit one of them are ignored. Keeps references to all but `tracing` itself and `objects`.
  Contrasts(const SphereTracing& tracing, std::span<const SpecialObject> objects, const SeenSources& sources);

  // The objects, in the order of their modifiers.
  std::span<const SpecialObject> objects() const { return objects_; }
  // The standard deviation of the brightness on an object (W/sr/m2). object: its position in objects().
  double deviationOn(size_t object) const;

  // Relative standard deviation of the brightness along one path: the error of a single base direction. 1 if
  // it was not measured.
  double baseError() const { return baseError_; }

 private:
  // Objects that follow each other and have the same modifier.
  struct Alike {
    size_t first = 0, count = 0;
    std::once_flag measured;
    double deviation = 0;
  };

  SphereTracing tracing_;
  const SeenSources& sources_;
  std::vector<SpecialObject> objects_;
  std::vector<std::unique_ptr<Alike>> alike_;
  std::vector<uint32_t> alikeOf_;  // by object: position in alike_
  double baseError_ = 1;
};

// The photopic radiance (W/sr/m2) that points on the scene's surfaces see on average, without sources. It is
// the reference by which points are judged to be dark. It comes from few directions, so that it is right only
// within a small factor; 0 if they found no light. It depends only on the scene and the options.
double typicalRadiance(const SphereTracing& tracing, const SeenSources& sources);

}  // namespace rsphere
