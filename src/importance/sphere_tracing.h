#pragma once
#include <memory>

#include "transport/path_tracer.h"

namespace rsphere {

// The objects that the tracers of sphere mode refer to. Shared by all threads; keeps references.
struct SphereTracing {
  const PreparedScene& prepared;
  const Caches& caches;
  Aims aims{};                                       // of indirect rays
  std::shared_ptr<const VertexLight> vertexLight{};  // PathRequest::vertexLight; null: none
  FoundAims ofPoints{};                              // owns those of `aims` that were found for points alone

  // Each thread needs its own.
  PathTracer tracer() const {
    return PathTracer(prepared, caches, aims, {FirstBounce::fromPatches, true, true});
  }
};

}  // namespace rsphere
