#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

#include "scene/scene.h"
#include "shade/ray_kind.h"
#include "shade/scattering.h"
#include "trace/tracer.h"

namespace rsphere {

// Light sources whose light is scattered into a ray, as positions in Transport::scatterers(). What is not
// used is neither set nor copied.
struct ScatteringSources {
  static constexpr size_t kMost = 32;  // RADIANCE's own figure
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
  // False where there is no room for another.
  bool add(uint16_t s) {
    if (contains(s)) return true;
    if (count == kMost) return false;
    source[count++] = s;
    return true;
  }
  // Whether it was there.
  bool remove(uint16_t s) {
    const auto last = source.begin() + count;
    const auto kept = std::remove(source.begin(), last, s);
    count = static_cast<uint8_t>(kept - source.begin());
    return kept != last;
  }
  const uint16_t* begin() const { return source.data(); }
  const uint16_t* end() const { return source.data() + count; }
};

// A ray, what it hit, and what comes back along it.
struct Ray {
  V3d origin{0, 0, 0}, direction{0, 0, 1};  // world; direction unit
  double farthest = 0;                      // where it ends whatever there is (-ld, world units); 0: nowhere
  RayKind kind = kPrimary;
  unsigned kinds = kPrimary;    // its own kind and those of its ancestors
  double weight = 1;            // most that its radiance can count for in the answer
  int level = 0;                // reflections that led to it
  int depth = 0;                // rays that led to it
  int ambientLevel = 0;         // indirect bounces that led to it
  double pathLength = 0;        // of its ancestors
  double shadowLength = 0;      // of those of them that were shadow rays
  int32_t aimedAt = kNone;      // light source that a shadow ray goes to
  int32_t mirror = kNone;       // the flat surface that mirrored the primary ray into this one, nothing else
                                // having turned it; an index in Scene::surfaces
  bool unobstructed = false;    // of a shadow ray: it meets what it is aimed at, and nothing else
  const Ray* parent = nullptr;  // null: a primary ray, or one that what came before does not matter to
  Medium medium{};              // that it passes
  ScatteringSources scatterers;
  const Ray* mist = nullptr;  // that entered the innermost mist around this one
  uint64_t clips = 0;         // Surface::clip of surfaces that are not there for it
  uint64_t clipsBeyond = 0;   // and for what goes on beyond the surface it hits
  Rgb contribution{1, 1, 1};  // share of its radiance, at its origin, in that of the primary ray

  int32_t surface = kNone;  // hit, index in Scene::surfaces
  double length = kFarAway;
  V3d point{0, 0, 0};       // where it hit, or its end (farthest); its origin where nothing local was hit
  V3d normal{0, 0, 0};      // on the side that it came from, once shaded
  double cosine = 1;        // -normal . direction; negative until a hit from behind is turned round
  bool fromBehind = false;  // normal, cosine and perturbation were turned round for a hit from behind
  bool insideOut = false;  // they were turned round where antimatter shows its cut, whose front is the inside
  V3d perturbation{0, 0, 0};
  Rgb pattern{1, 1, 1};
  double u = 0, v = 0;
  PlacementPath path;  // what the surface's modifiers are placed by

  Rgb value{0, 0, 0};     // radiance, W/sr/m2
  Rgb mirrored{0, 0, 0};  // the part of it that was mirrored
  double mirroredLength = kFarAway, unmirroredLength = kFarAway;
};

}  // namespace rsphere
