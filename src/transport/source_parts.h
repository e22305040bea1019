#pragma once
// Divides light sources into parts so small that the highlight of each on a curved surface is hardly curved.
#include <vector>

#include "light/sources.h"
#include "trace/tracer.h"

namespace rsphere {

// A source, or a part of one.
struct SourcePart {
  bool distant = false;
  V3d center{0, 0, 0};         // a direction (unit) if distant
  V3d u{0, 0, 0}, v{0, 0, 0};  // half its extent (world units; sines if distant)
  double variance = 1. / 3;    // variance of its points along u and v, relative to |u|^2 and |v|^2
  double radius = 0;           // of the ball around the center that contains the part

  V3d towards(const V3d& from) const { return distant ? center : center - from; }
};

// A part that lights a surface.
struct LightingPart {
  SourcePart part;
  const LightSource* source;
  double radiance;  // brightness, W/sr/m2
  double share;     // of the source's area

  // The solid angle (sr) as seen from a place that is not near to the source; 0 behind a flat one.
  double solidAngle(const V3d& from) const;
};

// The parts of a source that may light objects within a radius (world units) of a place; none if the source
// is virtual, black, or too far away. The parts refer to the source.
std::vector<LightingPart> partsThatLight(const LightSource& source, const V3d& from, double radius,
                                         const Scene& scene);

// Whether a place sees the middle of a part, or one of the places halfway to its ends.
bool seesPart(const Tracer& tracer, const LightingPart& part, const V3d& from);

// An estimate of the mean brightness (W/sr/m2) of all surfaces, as lit by the sources.
double usualRadiance(const Scene& scene, const Tracer& tracer, const LightSources& lights);

}  // namespace rsphere
