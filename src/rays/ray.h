#pragma once
// A ray: the query, the context that it inherits from its ancestors, its hit and its result. The other
// headers of this folder have the data that all rays of a run share: options, the prepared scene with its
// light sources, and the observer of a path. Later folders compute the light.
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "base/radiometry.h"
#include "shade/ray_kind.h"
#include "shade/scattering.h"
#include "trace/tracer.h"

namespace rsphere {

// Light sources whose light is scattered into a ray, as indices in MistSources::all(). Unused elements are
// neither initialized nor copied.
struct ScatteringSources {
  static constexpr size_t kMost = 32;  // the limit in RADIANCE
  uint8_t count = 0;
  std::array<uint16_t, kMost> source;

  ScatteringSources() {}
  ScatteringSources(const ScatteringSources& other) { *this = other; }
  ScatteringSources& operator=(const ScatteringSources& other) {
    count = other.count;
    for (uint8_t i = 0; i < count; ++i) source[i] = other.source[i];
    return *this;
  }

  bool contains(uint16_t s) const { return std::find(begin(), end(), s) != end(); }
  // Returns false if the limit is reached.
  bool add(uint16_t s) {
    if (contains(s)) return true;
    if (count == kMost) return false;
    source[count++] = s;
    return true;
  }
  // Returns whether it was present.
  bool remove(uint16_t s) {
    const auto last = source.begin() + count;
    const auto kept = std::remove(source.begin(), last, s);
    count = static_cast<uint8_t>(kept - source.begin());
    return kept != last;
  }
  const uint16_t* begin() const { return source.data(); }
  const uint16_t* end() const { return source.data() + count; }
};

struct RayEnd;

// The medium that a ray passes through.
struct RaySpace {
  Medium medium{};
  ScatteringSources scatterers;  // sources of the light that the medium scatters into the ray
  const RayEnd* mist = nullptr;  // the ancestor that entered the innermost mist around the ray; null: none
};

// A query for the radiance that arrives at a point from a direction.
struct RayQuery {
  V3d origin{0, 0, 0}, direction{0, 0, 1};  // world; direction unit
  double farthest = 0;     // the ray ends at this distance even without a hit (-ld, world units); 0: no limit
  SurfaceId from = kNone;  // surface on which it starts
  LightId aimedAt = kNone;    // light source that a shadow ray is aimed at
  bool unobstructed = false;  // of shadow rays: surfaces between the origin and the source are ignored
};

// Whether a path has met only "known" surfaces, which bidirectional estimation can handle (PlainSurfaces),
// and if so, whether paths from both ends estimate the reflected light that arrives at the last diffuse
// surface.
enum class Known : uint8_t {
  no,
  joined,   // they do: light vertices there are connected to the eye, or to the previous surface
  unjoined  // they do not: the surface is seen in a reflection, through which vertices are not connected
};

// Data that a ray inherits from its ancestors. They do not change after the ray is followed.
struct PathContext {
  RayKind kind = kPrimary;
  unsigned kinds = kPrimary;  // its own kind and those of its ancestors
  double weight = 1;          // upper bound on the fraction of the answer that its radiance may contribute
  int level = 0;              // number of reflections that led to it
  int depth = 0;              // number of its ancestors
  int ambientLevel = 0;       // number of indirect bounces that led to it
  double pathLength = 0;      // total length of its ancestors
  double shadowLength = 0;    // total length of those ancestors that are shadow rays
  SurfaceId mirror = kNone;   // if only a flat mirror has deflected the primary ray: that mirror
  Known known = Known::no;
  const RayEnd* parent = nullptr;  // null: a primary ray, or a ray that does not depend on earlier ones
  RaySpace space{};
  uint64_t clips = 0;           // bits (Surface::clip) of the surfaces that antimatter cuts away for this ray
  Coefficient contribution{1};  // factor on its radiance, at its origin, in the radiance of the primary ray
};

// The hit of a ray. Shading turns the normal and the values that depend on it towards the ray, and applies
// textures and patterns.
struct SurfaceHit {
  SurfaceId surface;  // kNone: nothing
  double length = kFarAway;
  // The hit, or the end of a ray with a limit (RayQuery::farthest). If the ray hits nothing, or a distant
  // source: its origin.
  V3d point{0, 0, 0};
  double u = 0, v = 0;
  PlacementPath path;   // the instances that contain the surface
  V3d normal{0, 0, 0};  // shading turns it towards the ray's origin
  double cosine = 1;    // -normal . direction; negative for a hit from behind, until shading flips it
  // Whether normal, cosine and perturbation were flipped: because the surface was hit from behind, or because
  // antimatter cuts it, so that its front is the inside.
  bool fromBehind = false, insideOut = false;
  // The perturbation of the normal: first that of a smooth mesh, to which textures add; a flip reverses it.
  // `pattern` is the product of all patterns. Irradiance (-i) ignores the changes by modifiers
  // (SurfaceShading).
  V3d perturbation{0, 0, 0};
  Color pattern{1, 1, 1};
};

// The result of a ray: radiance (W/sr/m2) and lengths (world units).
struct RayResult {
  Radiance value;                                                 // total radiance along the ray
  Radiance mirrored;                                              // the mirrored part of value
  double mirroredLength = kFarAway, unmirroredLength = kFarAway;  // length of the path to the visible object
};

// The end of a ray, where it is shaded. It must outlive rays that start there, because they refer to it.
struct RayEnd {
  RayEnd(const RayQuery& asked, const PathContext& inherited)
      : ray(asked), context(inherited), clipsBeyond(inherited.clips) {}
  // A copy of another end, for a ray with another context.
  RayEnd(const RayEnd& other, const PathContext& inherited)
      : ray(other.ray),
        context(inherited),
        hit(other.hit),
        clipsBeyond(other.clipsBeyond),
        beganIn(other.beganIn),
        known(other.known) {}

  const RayQuery& ray;
  const PathContext& context;
  SurfaceHit hit;
  uint64_t clipsBeyond;  // PathContext::clips for rays that continue beyond the surface
  // Set if the surface that was hit shows that the ray started in another medium than the inherited one.
  std::optional<RaySpace> beganIn;
  Known known = Known::no;  // for the rays that start here; set when the surface is shaded

  const RaySpace& space() const { return beganIn ? *beganIn : context.space; }
  const Medium& medium() const { return space().medium; }
  RaySpace& changedSpace() { return beganIn ? *beganIn : beganIn.emplace(context.space); }
};

// A ray that continues a path and has not been followed yet.
struct NextRay {
  // Sets the data that rays of all kinds inherit. The caller sets the direction.
  NextRay(const RayEnd& parent, RayKind kind, const Coefficient& coefficient);

  RayQuery query;
  PathContext context;
  Coefficient coefficient;  // factor on its radiance in the radiance of its parent
};

}  // namespace rsphere
