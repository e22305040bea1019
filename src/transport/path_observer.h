#pragma once
// The request for a path, and its results besides radiance.
#include <functional>

#include "trace/tracer.h"
#include "transport/ray_functions.h"

namespace rsphere {

class VertexLight;

// The light source that a primary ray showed, and the surface that mirrored it;
// kNone if there is none.
struct ShownSource {
  SurfaceId source;
  SurfaceId mirror;
  bool operator==(const ShownSource&) const = default;
};

// Called with every finished ray of a path (rtrace's -ot, -oT). The attenuation by the medium in front of its
// hit is not yet in its result.
using RayObserver = std::function<void(const RayEnd& end, const RayResult& result)>;

// The shadow rays that an observer is shown.
enum class ShownShadows : uint8_t {
  thatPassSurfaces,  // those that hit a surface that may transmit light
  thatArrive,        // the above, and those that reach their source unobstructed
  all                // the above, and those that are blocked
};

// What differs from path to path. Leaving something out changes the expected radiance; nothing else here
// does.
struct PathRequest {
  // Is shown every ray: descendants before their ancestors, and the primary ray last (except under -I, where
  // it hits nothing). Null: no observer. Changes no answer.
  const RayObserver* observer = nullptr;
  ShownShadows shadows = ShownShadows::thatPassSurfaces;
  // leavesOutIndirect: the surface that the primary ray hits is shown without its indirect light.
  // leavesOutLobes: it is shown without the samples of its rough reflections and transmissions.
  bool leavesOutIndirect = false, leavesOutLobes = false;
  // The source of indirect light, by paths from both ends, for plain surfaces (plain_surfaces.h) that the
  // path meets before its first diffuse reflection. If the primary ray hits such a surface straight or
  // through panes, the surface's diffuse reflection is left out, and so are shadow rays for its rough
  // highlight. Null: plain surfaces are shaded like others.
  const VertexLight* vertexLight = nullptr;
};

// What PathRequest::leavesOutIndirect and leavesOutLobes left out of a path.
struct LeftOut {
  bool indirect = false, lobes = false;
};

// A ray that was traced: the question, what it hit, and the answer.
struct TracedRay : RayQuery, SurfaceHit, RayResult {
  TracedRay() = default;
  TracedRay(const RayEnd& end, const RayResult& result)
      : RayQuery(end.ray),
        SurfaceHit(end.hit),
        RayResult(result),
        contribution(end.context.contribution * passedBy(end)) {}

  Coefficient contribution{1};  // share of its result in that of the primary ray
  // Of a primary ray:
  Hit firstHit;  // as Tracer::nearest found it
  // The light source that the ray showed: one that it hit, directly or straight through panes that also
  // transmit shadow rays, after at most one reflection by a flat surface; a distant one also through slabs of
  // parallel faces. If there are several, the one that was not mirrored, otherwise the first.
  ShownSource shown;
  LeftOut leftOut;  // the parts that the request left out, if the surface has them
};

}  // namespace rsphere
