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
};

// The descendants of one ray of a gather for interpolation: how many there are, and where they begin.
struct Descendants {
  double weight = 0;  // of the ray that they descend from; 0: they are not limited
  int depth = 0;      // of that ray
  int rays = 0;       // followed so far
};

// Each path begins with a new state, and so does each gather: no answer can depend on an earlier path.
struct PathState {
  Random random{0};
  V3d primaryDirection{0, 0, 1};  // unit
  ShownSource shown;
  Hit firstHit;                            // of the primary ray
  bool glimpses = false;                   // one direction for each gather
  Descendants descendants;                 // limited by continueRay()
  CoarseSolution::Links* links = nullptr;  // of a path from a patch: collects the light that it finds
};

}  // namespace rsphere
