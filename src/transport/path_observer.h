#pragma once
// What a path is asked for, and what it finds, besides its radiance.
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
  thatArrive,        // these, and those that reach their source with nothing in their way
  all                // those that are blocked, too
};

// What differs from path to path. Leaving something out changes the expected radiance; nothing else here
// does.
struct PathRequest {
  // Is shown every ray: descendants before their ancestors, and the primary ray last (except under -I, where
  // it hits nothing). Null: no observer. Changes no answer.
  const RayObserver* observer = nullptr;
  ShownShadows shadows = ShownShadows::thatPassSurfaces;
  // The surface that the primary ray hits is shown without its indirect light, and without the samples of its
  // rough reflections and transmissions.
  bool leavesOutIndirect = false, leavesOutLobes = false;
  // Paths from both ends bring light to the plain surfaces (plain_surfaces.h) that the path meets before its
  // first diffuse reflection: their indirect light comes from here. One that the primary ray shows straight
  // or through panes is shown without its diffuse reflection and without the shadow rays of its rough
  // highlight. Null: they are shaded as others.
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
