#pragma once
// The occlusion that rtrace assumes without tracing a shadow ray. Before tracing one, rtrace looks up the
// ray's cell in a grid around the source:
// - distant sources: 40 x 40 cells over the scene's cube as seen from the source,
// - other sources: 20 x 20 cells on each face of a cube of directions around the source.
// A cell stores one surface: the first opaque one on the line from the source through the middle of the cell.
// If that surface intersects the straight line from the point to the source, rtrace treats the source as
// hidden, even if the shadow ray would be refracted past the surface.
//
// Without this rule, places behind thick dielectric slabs would be brighter than with rtrace. In a scene of
// small boards on a slab, they would be .7% brighter on average, and wrong at half of the places between the
// straight and the refracted shadow of a board. rtrace also adds surfaces to its cells when it finds shadows.
// These are left out here, because they depend on the order of its rays.
#include "light/sources.h"
#include "trace/tracer.h"

namespace rsphere {

class PresumedShadows {
 public:
  // Keeps references to all three.
  PresumedShadows(const Scene& scene, const Tracer& tracer, const LightSources& lights);

  // Whether rtrace assumes that the source is hidden from the point along a straight line. direction: unit,
  // towards the source; distance: to the source's surface, or kFarAway. Takes one ray, or a few if surfaces
  // that are not opaque lie in front.
  bool hide(LightId source, const V3d& point, const V3d& direction, double distance) const;

 private:
  bool middleOfCell(const LightSource& light, const V3d& point, const V3d& direction, V3d& origin,
                    V3d& onward) const;
  bool isOpaque(const Hit& hit) const;

  const Scene& scene_;
  const Tracer& tracer_;
  const LightSources& lights_;
  V3d corner_{0, 0, 0};  // lowest corner of the scene's cube
  double size_ = 0;
};

}  // namespace rsphere
