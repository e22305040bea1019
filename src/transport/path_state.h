#pragma once
// The state of a path while it is traced.
#include <cstdint>

#include "field/patch_links.h"
#include "scene/random.h"
#include "trace/tracer.h"
#include "transport/aims.h"
#include "transport/caches.h"
#include "transport/path_observer.h"

namespace rsphere {

// Where the indirect light of the first diffuse surface of a path comes from, with -aa above 0. The light of
// later surfaces comes from the coarse solution. If thousands of directions are averaged, the errors of
// single patches matter less than what a gather at each surface costs. In a picture, patches would be
// visible, and cache records would outnumber its pixels where furniture is dense.
enum class FirstBounce : uint8_t {
  interpolated,  // from cache records
  fromPatches,   // from the coarse solution
  gathered       // from rays; behind a rough reflection, from the coarse solution
};

// Choices that a tracer makes for all of its paths.
struct TracingMode {
  FirstBounce firstBounce = FirstBounce::interpolated;
  // The light of sources in rough highlights is divided between shadow rays and samples of the lobes
  // (shared_highlights.h). The mean stays the same.
  bool sharesHighlights = false;
  // The number of descendants of a primary ray is limited, so that the time for a record is limited wherever
  // its point lies: within a closed metal cylinder paths would branch at each surface, into thousands of
  // rays. The mean stays the same.
  bool boundsWork = false;
};

// Tracers of sphere mode have other choices for the first bounce.
inline bool isRayMode(const TracingMode& mode) { return mode.firstBounce == FirstBounce::interpolated; }

// How a tracer traces all of its paths.
struct PathSettings {
  const Caches& caches;
  Aims aims;
  TracingMode mode;
};

// The descendants of one ray: of a gather for interpolation, or of a primary ray in sphere mode.
struct Descendants {
  double most = 0;       // above this number, weak ones are followed by Russian roulette; 0: no limit
  double weight = 0;     // of the ray at their root
  int depth = 0;         // of that ray
  int ambientLevel = 0;  // of that ray
  int rays = 0;          // followed so far, without shadow rays
  int patches = 0;       // that the ray, or the latest ray of a patch, has used so far
};

// Each path begins with a new state, and so does each gather: no answer can depend on an earlier path.
struct PathState {
  Random random{0};
  V3d primaryDirection{0, 0, 1};  // unit
  PathRequest request;
  ShownSource shown;            // by the primary ray
  Hit firstHit;                 // of the primary ray
  LeftOut leftOut;              // of the primary ray
  bool glimpses = false;        // gathers send one direction each (PathTracer::glimpse())
  Descendants descendants;      // limited by goesOnAlong()
  PatchLinks* links = nullptr;  // set for a path from a patch: collects the links and the light that it finds
};

}  // namespace rsphere
