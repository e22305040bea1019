#pragma once

#include "glances/light_pools.h"
#include "transport/path_tracer.h"

namespace rsphere {

// Objects used by the tracers of sphere mode. Shared by all threads; keeps references.
struct SphereTracing {
  const PreparedScene& prepared;
  const Caches& caches;
  Aims aims{};                        // where indirect rays are aimed
  const LightPools* pools = nullptr;  // of light vertices; null: none
  FoundAims ofPoints{};               // owns the members of `aims` that were found for points only

  // Each thread needs its own.
  PathTracer tracer() const {
    return PathTracer(prepared, caches, aims, {FirstBounce::fromPatches, true, true});
  }
};

}  // namespace rsphere
