#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

#include "base/radiometry.h"
#include "scene/scene.h"
#include "shade/ray_kind.h"
#include "shade/scattering.h"
#include "trace/tracer.h"

namespace rsphere {

// Light sources whose light is scattered into a ray, as positions in PreparedScene::scatterers(). Unused elements
// are neither set nor copied.
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

// A ray, its hit, and the radiance that returns along it. It ends at `farthest` even if it hits nothing.
struct Ray {
  V3d origin{0, 0, 0}, direction{0, 0, 1};  // world; direction unit
  double farthest = 0;                      // largest length (-ld, world units); 0: no limit
  RayKind kind = kPrimary;
  unsigned kinds = kPrimary;    // its own kind and those of its ancestors
  double weight = 1;            // largest share that its radiance can have in the answer
  int level = 0;                // number of reflections that led to it
  int depth = 0;                // number of its ancestors
  int ambientLevel = 0;         // number of indirect bounces that led to it
  double pathLength = 0;        // total length of its ancestors
  double shadowLength = 0;      // total length of those ancestors that are shadow rays
  LightId aimedAt;              // light source that a shadow ray is aimed at
  SurfaceId mirror;             // the flat surface that mirrored the primary ray into this one, if nothing
                                // else deflected it
  bool unobstructed = false;    // of a shadow ray: it hits its target, whatever else is in its way
  const Ray* parent = nullptr;  // null: a primary ray, or one that does not depend on earlier rays
  Medium medium{};              // that it travels through
  ScatteringSources scatterers;
  const Ray* mist = nullptr;    // the ancestor that entered the innermost mist around this ray
  uint64_t clips = 0;           // Surface::clip of the surfaces that are cut away for this ray
  uint64_t clipsBeyond = 0;     // the same for a ray that continues beyond the surface that it hits
  Coefficient contribution{1};  // share of its radiance, at its origin, in that of the primary ray

  SurfaceId surface;  // hit
  double length = kFarAway;
  V3d point{0, 0, 0};       // the hit or the end (farthest); the origin if no hit or a distant source
  V3d normal{0, 0, 0};      // once shaded, on the side that the ray came from
  double cosine = 1;        // -normal . direction; negative for a hit from behind until it is turned round
  bool fromBehind = false;  // normal, cosine and perturbation were flipped because of a hit from behind
  bool insideOut = false;   // they were flipped at a cut by antimatter, whose front is the inside
  V3d perturbation{0, 0, 0};
  Color pattern{1, 1, 1};
  double u = 0, v = 0;
  PlacementPath path;  // the placements of the surface's modifiers in the world

  Radiance value;     // that returns along it
  Radiance mirrored;  // the part of it that was mirrored
  double mirroredLength = kFarAway, unmirroredLength = kFarAway;
};

}  // namespace rsphere
