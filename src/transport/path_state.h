#pragma once
// The state of a path while it is traced.
#include "field/coarse_solution.h"
#include "scene/random.h"
#include "trace/tracer.h"
#include "transport/path_observer.h"
#include "transport/transport.h"

namespace rsphere {

class LocalGuess;

// How a tracer traces all of its paths.
struct PathSettings {
  Aims aims;
  const LocalGuess* guess = nullptr;  // control variate of indirect rays; null: none
  RayObserver observer;
  bool observesAllShadowRays = false;
  bool sharesHighlights = false;  // PathTracer::shareHighlights()
  bool coarseAtFirst = false;     // PathTracer::useCoarseSolutionAtFirst()
  bool boundsWork = false;        // PathTracer::boundWork()
};

// Each path begins with a new state, and so does each gather: no answer can depend on an earlier path.
struct PathState {
  Random random{0};
  V3d primaryDirection{0, 0, 1};  // unit
  ShownSource shown;
  Hit firstHit;                            // of the primary ray
  bool glimpses = false;                   // one direction for each gather
  int followed = 0;                        // rays so far, without shadow rays, where work is bounded
  CoarseSolution::Links* links = nullptr;  // of a path from a patch: collects the light that it finds
};

}  // namespace rsphere
