#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "base/radiometry.h"
#include "scene/scene.h"
#include "shade/ray_kind.h"
#include "shade/scattering.h"
#include "trace/tracer.h"

namespace rsphere {

// Light sources whose light is scattered into a ray, as positions in MistSources::all(). Unused
// elements are neither set nor copied.
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
  // Returns false if there is no room for another.
  bool add(uint16_t s) {
    if (contains(s)) return true;
    if (count == kMost) return false;
    source[count++] = s;
    return true;
  }
  // Returns whether it was there.
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

// What fills the space that a ray passes through.
struct RaySpace {
  Medium medium{};
  ScatteringSources scatterers;  // of light that the medium scatters into the ray
  const RayEnd* mist = nullptr;  // the ancestor that entered the innermost mist around the ray; null: none
};

// The question that a ray asks: the radiance that arrives at a point from a direction.
struct RayQuery {
  V3d origin{0, 0, 0}, direction{0, 0, 1};  // world; direction unit
  double farthest = 0;        // the ray ends there even if it hits nothing (-ld, world units); 0: no limit
  SurfaceId from = kNone;     // surface that it leaves
  LightId aimedAt = kNone;    // light source that a shadow ray is aimed at
  bool unobstructed = false;  // for shadow rays: surfaces between the origin and the source are ignored
};

// Whether only surfaces that paths from both ends know (PlainSurfaces) have led to a ray; if so, whether
// those paths bring light that arrives at the last diffuse surface by a reflection.
enum class Known : uint8_t {
  no,
  joined,   // they bring it: light vertices there are joined to the eye, or to the surface before
  unjoined  // they do not: the surface is seen in a reflection, through which vertices are not joined
};

// What a ray inherits from its ancestors. It does not change once the ray is followed.
struct PathContext {
  RayKind kind = kPrimary;
  unsigned kinds = kPrimary;  // its own kind and those of its ancestors
  double weight = 1;          // largest share that its radiance can have in the answer
  int level = 0;              // number of reflections that led to it
  int depth = 0;              // number of its ancestors
  int ambientLevel = 0;       // number of indirect bounces that led to it
  double pathLength = 0;      // total length of its ancestors
  double shadowLength = 0;    // total length of those ancestors that are shadow rays
  SurfaceId mirror = kNone;   // the flat surface that mirrored the primary ray into this one, if nothing
                              // else deflected it
  Known known = Known::no;
  const RayEnd* parent = nullptr;  // null: a primary ray, or one that does not depend on earlier rays
  RaySpace space{};
  uint64_t clips = 0;           // Surface::clip of the surfaces that are cut away for this ray
  Coefficient contribution{1};  // share of its radiance, at its origin, in that of the primary ray
};

// The hit of a ray. Shading turns the normal, and the values that depend on it, towards the ray, and adds
// textures and patterns.
struct SurfaceHit {
  SurfaceId surface;  // kNone: nothing
  double length = kFarAway;
  // The point of the hit, or the end of the ray (RayQuery::farthest). The origin if nothing or a distant
  // source is hit.
  V3d point{0, 0, 0};
  double u = 0, v = 0;
  PlacementPath path;       // the placements of the surface's modifiers in the world
  V3d normal{0, 0, 0};      // shading turns it towards the ray's origin
  double cosine = 1;        // -normal . direction; negative for a hit from behind until it is turned round
  bool fromBehind = false;  // normal, cosine and perturbation were flipped because of a hit from behind
  bool insideOut = false;   // they were flipped at a cut by antimatter, whose front is the inside
  // The perturbation of the normal. It begins with that of a smooth mesh. Apart from turning it round, only
  // modifiers change it. The same is true of the pattern, which meters (-i) ignore (SurfaceShading).
  V3d perturbation{0, 0, 0};
  Color pattern{1, 1, 1};
};

// The answer: radiance (W/sr/m2) and lengths (world units).
struct RayResult {
  Radiance value;                                                 // all that returns along the ray
  Radiance mirrored;                                              // the part of it that was mirrored
  double mirroredLength = kFarAway, unmirroredLength = kFarAway;  // of the path to the object seen
};

// The end of a ray, where it is shaded. Rays that begin there refer to it, so that it must outlive them.
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
  uint64_t clipsBeyond;  // PathContext::clips of a ray that continues beyond the surface
  // Set if the surface that was hit implies that the ray began in another space than the inherited one.
  std::optional<RaySpace> beganIn;
  Known known = Known::no;  // of the rays that begin here; set when the surface is shaded

  const RaySpace& space() const { return beganIn ? *beganIn : context.space; }
  const Medium& medium() const { return space().medium; }
  RaySpace& changedSpace() { return beganIn ? *beganIn : beganIn.emplace(context.space); }
};

// A ray that continues a path, ready to be followed.
struct NextRay {
  // Sets what rays of all kinds inherit. The direction is still to be set.
  NextRay(const RayEnd& parent, RayKind kind, const Coefficient& coefficient);

  RayQuery query;
  PathContext context;
  Coefficient coefficient;  // factor on its radiance in that of its parent
};

}  // namespace rsphere
