#pragma once
// The state of a path while it is traced.
#include <cstdint>

#include "base/random.h"
#include "field/patch_links.h"
#include "rays/path_observer.h"
#include "trace/tracer.h"
#include "transport/aims.h"
#include "transport/caches.h"

namespace rsphere {

// The origin of the indirect light at the first diffuse surface of a path with -aa above 0. The light at
// later surfaces comes from the coarse solution. If thousands of directions are averaged, the errors of
// single patches matter less than the cost of a gather at each surface. In a picture, however, patches would
// be visible. And where furniture is dense, cache records would outnumber the pixels.
enum class FirstBounce : uint8_t {
  interpolated,  // from records of the irradiance cache
  fromPatches,   // from the coarse solution
  gathered       // from traced rays; after a rough reflection, from the coarse solution
};

// Settings that a tracer uses for all of its paths.
struct TracingMode {
  FirstBounce firstBounce = FirstBounce::interpolated;
  // Whether the light of sources in rough highlights is estimated partly by shadow rays and partly by samples
  // of the lobes (shared_highlights.h). The mean does not change.
  bool sharesHighlights = false;
  // Whether the number of descendants of a primary ray is limited, to bound the time for each record. Inside
  // a closed metal cylinder, for example, paths branch at each surface, into thousands of rays. The mean does
  // not change.
  bool boundsWork = false;
  // Whether FirstBounce::interpolated uses the irradiance cache. If not, the light of the first diffuse
  // surface is gathered, and that of later ones comes from the coarse solution.
  bool interpolates = true;
  int solution = 0;  // of interpolated light: FieldOptions::solutions
};

// Tracers of sphere mode use another value of firstBounce.
inline bool isRayMode(const TracingMode& mode) { return mode.firstBounce == FirstBounce::interpolated; }

// Everything that determines how a tracer traces its paths.
struct PathSettings {
  const Caches& caches;
  Aims aims;
  TracingMode mode;
};

// Counts the descendants of one ray: of a gather for interpolation, or of a primary ray in sphere mode.
struct Descendants {
  double most = 0;       // beyond this number, weak rays are subject to Russian roulette; 0: no limit
  double weight = 0;     // of the ray from which they descend
  int depth = 0;         // of that ray
  int ambientLevel = 0;  // of that ray
  int rays = 0;          // followed so far, without shadow rays
  int patches = 0;       // used so far by this ray, or by the latest ray of a patch
};

// Each path and each gather begins with a new state, so that no answer can depend on an earlier path.
struct PathState {
  Random random{0};
  V3d primaryDirection{0, 0, 1};  // unit
  PathRequest request;
  ShownSource shown;            // along the primary ray
  Hit firstHit;                 // of the primary ray
  LeftOut leftOut;              // of the primary ray
  bool gathers = false;         // at the first diffuse surface
  bool glimpses = false;        // gathers send one direction each (PathTracer::glimpse())
  Descendants descendants;      // limited by goesOnAlong()
  PatchLinks* links = nullptr;  // of a path from a patch: receives the links and the light that it finds
};

}  // namespace rsphere
