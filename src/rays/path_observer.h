#pragma once
// What a caller requests of a path, and the results of a path besides its radiance.
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "rays/ray_functions.h"
#include "trace/tracer.h"

namespace rsphere {

class VertexLight;

// The light source that is visible along a primary ray, and the surface that mirrors it; kNone if there is
// none.
struct ShownSource {
  SurfaceId source;
  SurfaceId mirror;
  bool operator==(const ShownSource&) const = default;
};

// Called for every finished ray of a path (rtrace's -ot, -oT). The result is not yet attenuated by the medium
// along the ray.
using RayObserver = std::function<void(const RayEnd& end, const RayResult& result)>;

// Selects the shadow rays that the observer is called for.
enum class ShownShadows : uint8_t {
  thatPassSurfaces,  // those that hit a surface that may transmit light
  thatArrive,        // also those that reach their source unoccluded
  all                // also those that are blocked
};

// The number of gathers of different paths whose directions can be interleaved (PathRequest::interleaved).
constexpr int kInterleavedGathers = 2;

// The options of a single path. Only those that leave something out change the expected radiance.
struct PathRequest {
  // Called for every ray. Descendants come before their ancestors, and the primary ray comes last (except
  // with -I, where it hits nothing). Null: no observer. It does not change any answer.
  const RayObserver* observer = nullptr;
  ShownShadows shadows = ShownShadows::thatPassSurfaces;
  // leavesOutIndirect: the indirect light of the surface hit by the primary ray is left out.
  // leavesOutLobes: the samples of rough reflection and transmission at that surface are left out.
  bool leavesOutIndirect = false, leavesOutLobes = false;
  // The number of rays of the gathers at the first diffuse surface; 0: -ad plus -as.
  int rays = 0;
  // If set, the directions of these gathers and those of paths with the other numbers (below
  // kInterleavedGathers) and the same `lattice` form one lattice. REQUIRES that all have the same `rays`.
  struct Interleaved {
    uint64_t lattice;
    int number;
  };
  std::optional<Interleaved> interleaved = std::nullopt;
  // If not null, paths from both ends provide the indirect light of plain surfaces (plain_surfaces.h) that
  // the path hits before its first diffuse reflection. If the primary ray hits a plain surface directly or
  // through panes, the surface's diffuse reflection is left out, and so are shadow rays for its rough
  // highlight. Farther along the path, light that has another owner is left out, too (owners.h). Null: plain
  // surfaces are shaded like others.
  const VertexLight* vertexLight = nullptr;
  // If not null, by LightId, whether shadow rays are sent to a light source. The light of others is left out.
  const std::vector<bool>* sampledLights = nullptr;
};

// The parts of the light that were left out because of PathRequest::leavesOutIndirect and leavesOutLobes.
struct LeftOut {
  bool indirect = false, lobes = false;
};

struct TracedRay : RayQuery, SurfaceHit, RayResult {
  TracedRay() = default;
  TracedRay(const RayEnd& end, const RayResult& result)
      : RayQuery(end.ray),
        SurfaceHit(end.hit),
        RayResult(result),
        contribution(end.context.contribution * passedBy(end)) {}

  Coefficient contribution{1};  // factor on its result in the result of the primary ray
  // The remaining members describe a primary ray.
  Hit firstHit;  // the hit that Tracer::nearest() found
  // The light source that the ray shows. It is hit directly, or after one reflection by a flat surface, or
  // straight through panes that also transmit shadow rays; a distant source also through parallel-sided
  // slabs. If it shows several, this is the one that is not mirrored, otherwise the first.
  ShownSource shown;
  bool gathers = false;  // whether the light of its first diffuse surface was gathered
  LeftOut leftOut;       // the parts of the surface's light that the request left out
};

}  // namespace rsphere
