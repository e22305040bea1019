#pragma once
// The state of a path while it is traced.
#include <cstdint>

#include "field/coarse_solution.h"
#include "scene/random.h"
#include "trace/tracer.h"
#include "transport/path_observer.h"
#include "transport/transport.h"

namespace rsphere {

class LocalGuess;

// Where the indirect light of the first diffuse surface of a path comes from, with -aa above 0. That of later ones
// comes from the coarse solution.
enum class FirstBounce : uint8_t {
  interpolated,  // from cache records
  fromPatches,   // from the coarse solution
  gathered       // from rays, and beyond a rough reflection from the coarse solution
};

// How a tracer traces all of its paths.
struct PathSettings {
  Aims aims;
  const LocalGuess* guess = nullptr;  // control variate of indirect rays; null: none
  RayObserver observer;
  bool observesAllShadowRays = false;
  bool sharesHighlights = false;                           // PathTracer::shareHighlights()
  FirstBounce firstBounce = FirstBounce::interpolated;     // PathTracer::takeFirstBounce()
  bool leavesOutIndirect = false, leavesOutLobes = false;  // PathTracer::leaveOut()
};

// Each path begins with a new state, and so does each gather: no answer can depend on an earlier path.
struct PathState {
  Random random{0};
  V3d primaryDirection{0, 0, 1};  // unit
  ShownSource shown;
  Hit firstHit;                            // of the primary ray
  bool glimpses = false;                   // one direction for each gather
  CoarseSolution::Links* links = nullptr;  // of a path from a patch: collects the light that it finds
};

}  // namespace rsphere
