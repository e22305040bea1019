#pragma once
// The light sources of a scene and how they are sampled from a point: split into parts that look small from
// there
// (-ds), one ray to each part, at its middle or jittered over it (-dj).
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "scene/random.h"
#include "scene/scene.h"
#include "shade/surface_functions.h"

namespace rsphere {

// A surface that lights others by the direct calculation: light, spotlight, illum, and glow within its reach;
// with goals in the scene, those goals alone.
//
// Virtual sources follow them: what a relay (mirror, prism1, prism2) makes of another source, as an image of
// its own place and extent that is seen through the relay alone.
struct LightSource {
  int32_t surface =
      kNone;  // index in Scene::surfaces; the relay of a virtual one: what a ray to it hits first
  int32_t relayed = kNone;  // index of the source that a ray goes on to from the relay; kNone: a real one
  int32_t image = 0;        // which of its relay's images, from 0
  V3d center{0, 0, 0};      // direction to it (unit) where distant
  double radius = 0;        // of a sphere around it (world units)
  double reach = 0;         // farther from the sphere it lights nothing directly; 0: no limit
  bool distant = false;
  double sinHalfAngle = 0, cosHalfAngle = 1;  // distant only
  std::optional<Spotlight> spot;
  // The beam of a virtual source that is not distant: from the image's center, every direction of its light
  // lies in a cone around beam (unit).
  V3d beam{0, 0, 1};
  double cosBeam = -1;

  bool isVirtual() const { return relayed != kNone; }
  bool isPlane() const { return map <= Map::fan; }

  // How the unit square lies on the source.
  enum class Map : uint8_t {
    parallelogram,  // center + (2s-1) u + (2t-1) v
    square,         // the same, of equal area, for a polygon that is not convex: some of it is outside
    disk,           // area-preserving on the disk with radii u, v
    fan,            // a convex polygon as triangles around its first vertex, by area
    ball,           // no map: the cone of directions that the sphere fills
    tube,           // s along the axis (half-length u), t across as seen
    cone            // distant
  } map = Map::parallelogram;
  V3d u{0, 0, 0}, v{0, 0, 0};
  double extentU = 0, extentV = 0;  // half of what its parts are measured by
  double outermost = 0;             // how far its points are out from center, along any direction
  V3d normal{0, 0, 0};              // of plane sources
  double area = 0;                  // of plane sources; of a tube's length times its diameter
  std::vector<double> fanArea;      // cumulative shares of the fan's triangles
  std::vector<V3d> fanVertices;
  // A real one, plane and whole: what is aimed at the square's image on it hits it there. Or a sphere that
  // shines outward.
  bool hitsWhereAimed = false;
};

// One ray towards a source. solidAngle (sr) is what it stands for; the sum over a source's samples estimates
// the solid angle of the source (exactly for spheres and distant sources as seen by a surface that faces
// them; for plane ones by area * cosine / distance^2 at the sample).
struct SourceSample {
  V3d direction{0, 0, 0};
  double solidAngle = 0;
  double distance =
      0;              // to where the source is hit, or the relay of a virtual one; kFarAway for distant ones
  double cosine = 1;  // of the hit, positive on the front
  V3d normal{0, 0, 0};
  uint32_t source = 0;  // index in LightSources
};

// How a source is sampled.
struct SourceSampling {
  double largest = 0;  // size over distance of a part, at most; 0: not split
  double jitter = 0;   // share of a part that its ray may lie in, 0 to 1
  // Not 0: sources that lie wholly behind the plane through the point with this normal (unit) are left out.
  V3d front{0, 0, 0};
};

class LightSources {
 public:
  // Keeps a reference to the scene. Glow of zero or negative reach and distant glow are no light sources
  // here.
  explicit LightSources(const Scene& scene);

  // The same, and virtual sources by way of up to `relays` relays one after the other (-dr): see relays.h.
  LightSources(const Scene& scene, int relays, const SurfaceFunctions& functions, const rad::Warn& warn);

  std::span<const LightSource> all() const { return sources_; }

  // Appends the samples of one source as seen from a point; none where the source cannot light it: behind it,
  // beyond its reach, outside its spot. At most 64 parts. A sample that misses the source it was aimed at is
  // left out; one to a virtual source is only followed to the first relay: what comes back from there may be
  // nothing.
  void sample(uint32_t source, const V3d& point, const SourceSampling& how, Random& random,
              std::vector<SourceSample>& samples) const {
    // Most are turned away or behind the surface, and most images shine elsewhere: told here, without a call.
    const LightSource& light = sources_[source];
    const V3d towards = light.distant ? light.center : light.center - point;
    if (light.isPlane() && towards.dot(light.normal) >= 0) return;
    if (towards.dot(how.front) < -light.outermost) return;
    if (light.cosBeam > 0 && surelyBeside(light, towards)) return;
    sampleParts(source, point, towards, how, random, samples);
  }

 private:
  // Whether a point is out of a virtual source's beam, by more than rounding. Without a root.
  static bool surelyBeside(const LightSource& light, const V3d& towards) {
    const double along = -towards.dot(light.beam);
    return along < 0 || along * along < (1 - 1e-12) * light.cosBeam * light.cosBeam * towards.length2();
  }
  void sampleParts(uint32_t source, const V3d& point, const V3d& towards, const SourceSampling& how,
                   Random& random, std::vector<SourceSample>& samples) const;
  void findSources();
  void measureParts();

  const Scene& scene_;
  std::vector<LightSource> sources_;
};

// Whether a spotlight's cone leaves out the direction towards it (unit).
inline bool outsideSpot(const Spotlight& spot, const V3d& towards) {
  constexpr double kTwoPi = 6.283185307179586;
  return spot.solidAngle < kTwoPi * (1 + spot.aim.dot(towards));
}

}  // namespace rsphere
