#pragma once
#include "transport/path_tracer.h"

namespace rsphere {

// What the paths of sphere mode are traced with. Shared by all threads; keeps references.
struct SphereTracing {
  const PreparedScene& prepared;
  const Caches& caches;
  Aims aims{};                               // of indirect rays
  const VertexLight* vertexLight = nullptr;  // PathRequest::vertexLight
  FoundAims ofPoints{};                      // those of `aims` that gathers have not looked for

  // Each thread needs its own.
  PathTracer tracer() const {
    return PathTracer(prepared, caches, aims, {FirstBounce::fromPatches, true, true});
  }
};

}  // namespace rsphere
