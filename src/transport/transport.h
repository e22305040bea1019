#pragma once
// All that the path tracers of a run share: the scene prepared for tracing, the aims of gathers, and the
// caches of interpolated light.
#include "transport/aims.h"
#include "transport/caches.h"
#include "transport/path_tracer.h"
#include "transport/prepared_scene.h"

namespace rsphere {

// Shared by all threads. Constant once constructed, except for the caches. Keeps a reference to the scene.
class Transport {
 public:
  // See PreparedScene. If there is indirect light (-ab) and the scene has panes or holes, the constructor
  // traces some paths to find the openings that daylight enters through. Throws what PreparedScene throws.
  Transport(const Scene& scene, const RayOptions& options, IrradianceAt irradiance,
            bool basicRadiance = false, const rad::Warn& warn = {});
  // Prepares the scene of `other` with other options, without warnings. REQUIRES: -bv is the same.
  Transport(const Transport& other, const RayOptions& options);

  const PreparedScene& prepared() const { return prepared_; }
  Aims aims() const { return aims_; }
  const Caches& caches() const { return caches_; }

  // A tracer for one thread, whose gathers are aimed.
  PathTracer pathTracer(const TracingMode& mode = {}) const {
    return PathTracer(prepared_, caches_, aims_, mode);
  }

 private:
  PreparedScene prepared_;
  FoundAims aims_;
  Caches caches_;
};

}  // namespace rsphere
