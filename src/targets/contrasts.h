#pragma once
// Measures how much radiance varies on special objects, compared with the rest of the view. No estimate uses
// the rays of these measurements, so that estimates at points stay unbiased.
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "glances/sphere_tracing.h"
#include "occluders/hidden_boxes.h"
#include "silhouettes/seen_sources.h"
#include "silhouettes/special_objects.h"

namespace rsphere {

// Shared by all threads. Objects that share a modifier share one measurement, which is made when a point
// first needs it. In a building, there is one for each region of points, with the objects that can be seen
// from the region: other objects are in other rooms, under other light. The results depend only on the
// region, the scene and the options.
class Contrasts {
 public:
  // Nothing is traced if there are no objects and no openings. sources: those that are integrated separately;
  // rays that hit one of them are ignored. Keeps references to all but `tracing` itself and `objects`.
  Contrasts(const SphereTracing& tracing, std::span<const SpecialObject> objects, const SeenSources& sources);

  // The objects, in the order of their modifiers.
  std::span<const SpecialObject> objects() const { return objects_; }
  // Measurements for the points of a region.
  class Region;
  // The objects that are not hidden from a point, as positions in objects(), and the region of the point.
  struct View {
    std::span<const uint32_t> objects;
    std::shared_ptr<const Region> region;
  };
  View from(const V3d& point) const;
  // The standard deviation of the brightness on an object (W/sr/m2). object: its position in objects().
  double deviationOn(size_t object, const Region& region) const;

  // Relative standard deviation of the brightness along one path: the error of a single base direction. 1 if
  // it was not measured.
  double baseError() const { return baseError_; }

 private:
  std::shared_ptr<const VertexLight> lightFor(const Region& region) const;

  SphereTracing tracing_;
  const SeenSources& sources_;
  std::vector<SpecialObject> objects_;
  std::vector<uint32_t> alikeOf_;  // by object: number of its modifier among those of all objects
  HiddenBoxes hidden_;             // the boxes around objects_
  mutable std::mutex making_;      // guards regions_
  // By the objects that can be seen from a region: HiddenBoxes keeps one list for each region.
  mutable std::map<const uint32_t*, std::shared_ptr<const Region>> regions_;
  double baseError_ = 1;
};

// The average photopic radiance (W/sr/m2) in view of points on the scene's surfaces, without sources: the
// reference by which points are called dark. It is estimated from few directions and right only within a
// small factor; 0 if they find no light. It depends only on the scene and the options.
double typicalRadiance(const SphereTracing& tracing, const SeenSources& sources);

}  // namespace rsphere
