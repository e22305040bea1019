#pragma once
// The data that all path tracers of a run share: the prepared scene, the aims of gathers, and the caches of
// interpolated light.
#include "rays/prepared_scene.h"
#include "transport/aims.h"
#include "transport/caches.h"
#include "transport/find_aims.h"
#include "transport/path_tracer.h"

namespace rsphere {

// Shared by all threads. Constant after construction, except for the caches. Keeps a reference to the scene.
class Transport {
 public:
  // Parameters: see PreparedScene. If there is indirect light (-ab) and the scene has panes or holes, traces
  // some paths to find the openings through which daylight enters. Throws the exceptions of PreparedScene.
  Transport(const Scene& scene, const RayOptions& options, IrradianceAt irradiance,
            bool basicRadiance = false, const rad::Warn& warn = {})
      : prepared_(scene, options, irradiance, basicRadiance, warn),
        caches_(makeCaches(prepared_, aims_, warn)) {}
  // Prepares the scene of `other` for radiance, with other options, without warnings. REQUIRES that both have
  // the same -bv.
  Transport(const Transport& other, const RayOptions& options)
      : prepared_(other.prepared_, options), caches_(makeCaches(prepared_, aims_, {})) {}

  const PreparedScene& prepared() const { return prepared_; }
  Aims aims() const { return aims_; }
  const Caches& caches() const { return caches_; }

  // A tracer for one thread. Its gathers use the aims.
  PathTracer pathTracer(const TracingMode& mode = {}) const {
    return PathTracer(prepared_, caches_, aims_, mode);
  }

 private:
  PreparedScene prepared_;
  FoundAims aims_ = findAimsOfGathers(prepared_);
  Caches caches_;
};

}  // namespace rsphere
