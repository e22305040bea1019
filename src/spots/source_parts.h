#pragma once
// Divides light sources into parts so small that the highlight of each part on a curved surface is nearly
// straight.
#include <vector>

#include "light/sources.h"
#include "trace/tracer.h"

namespace rsphere {

// A source, or a part of one.
struct SourcePart {
  bool distant = false;
  V3d center{0, 0, 0};         // a direction (unit) if distant
  V3d u{0, 0, 0}, v{0, 0, 0};  // half its extents (world units; sines if distant)
  double variance = 1. / 3;    // variance of its points along u and v, relative to |u|^2 and |v|^2
  double radius = 0;           // of the bounding ball around the center

  V3d towards(const V3d& from) const { return distant ? center : center - from; }
};

// A part of a source that lights a surface.
struct LightingPart {
  SourcePart part;
  const LightSource* source;
  double radiance;  // brightness, W/sr/m2
  double share;     // fraction of the source's area

  // The solid angle (sr) as seen from a place that is not near the source; 0 behind a flat source.
  double solidAngle(const V3d& from) const;
};

// The parts of a source that may light objects within a radius (world units) around a place. None if the
// source is virtual, black or too far away. The parts refer to the source.
std::vector<LightingPart> partsThatLight(const LightSource& source, const V3d& from, double radius,
                                         const Scene& scene);

// Whether the middle of a part, or one of four points halfway to its corners, is visible from a place.
bool seesPart(const Tracer& tracer, const LightingPart& part, const V3d& from);

// An estimate of the mean brightness (W/sr/m2) of all surfaces under the light of the sources.
double usualRadiance(const Scene& scene, const Tracer& tracer, const LightSources& lights);

}  // namespace rsphere
