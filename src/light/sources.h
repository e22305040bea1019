#pragma once
// The light sources of a scene and how they are sampled from a point: a source is split into parts that are
// small compared with their distance (-ds), and one ray goes to each part, at its middle or jittered (-dj).
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "light/beam.h"
#include "scene/random.h"
#include "scene/scene.h"
#include "shade/spot_cone.h"
#include "shade/surface_functions.h"

namespace rsphere {

// A surface that is sampled by the direct calculation (next-event estimation): light, spotlight, illum, and
// glow within its reach. If the scene has importance goals, the goals are the only sources.
//
// Virtual sources follow the real ones: images of other sources in a relay (mirror, prism1, prism2). An image
// has a position and an extent, and can only be seen through its relay.
struct LightSource {
  SurfaceId surface;    // of a virtual source, its relay, which a ray to it hits first
  LightId relayed;      // the source that a ray reaches from the relay; kNone: a real source
  int32_t image = 0;    // which of its relay's images, from 0
  V3d center{0, 0, 0};  // of a distant source, the direction to it (unit)
  double radius = 0;    // of its bounding sphere around center (world units)
  double reach = 0;     // beyond this distance (world units) it lights nothing directly; 0: no limit
  bool distant = false;
  double sinHalfAngle = 0, cosHalfAngle = 1;  // distant only
  std::optional<Spotlight> spot;
  // Of a virtual source: every point that it lights lies in the beam, as seen from the image's center. A
  // distant image has no center; its beam holds all directions.
  Beam beam;

  bool isVirtual() const { return relayed != kNone; }
  bool isPlane() const { return map <= Map::fan; }

  // How the unit square lies on the source.
  enum class Map : uint8_t {
    parallelogram,  // center + (2s-1) u + (2t-1) v
    square,         // the same for a concave polygon: a square of equal area, partly outside the polygon
    disk,           // area-preserving on the disk with radii u, v
    fan,            // a convex polygon as a fan of triangles around its first vertex, by area
    ball,           // no map: the cone of directions that the sphere subtends
    tube,           // s along the axis (half-length u), t across as seen
    cone            // distant
  } map = Map::parallelogram;
  V3d u{0, 0, 0}, v{0, 0, 0};
  double extentU = 0, extentV = 0;  // half its size along u and v, which decides how it is split
  double outermost = 0;             // the largest distance of its points from center; a sine if distant
  V3d normal{0, 0, 0};              // of plane sources
  double area = 0;                  // of plane sources; of a tube, its length times its diameter
  std::vector<double> fanArea;      // cumulative shares of the fan's triangles
  std::vector<V3d> fanVertices;
  // Rays need no intersection test with the source. Either it is real and flat, and the unit square maps into
  // it, so that a ray hits it exactly where it was aimed; or it is a sphere that shines outward.
  bool hitsWhereAimed = false;
};

// One ray towards a source. solidAngle (sr) is its weight: the sum over a source's samples estimates the
// solid angle of the source. The estimate uses area * cosine / distance^2 at the sample for plane sources,
// and is exact for spheres and distant sources as seen by a surface that faces them.
struct SourceSample {
  V3d direction{0, 0, 0};
  double solidAngle = 0;
  double distance = 0;  // to the hit on the source, or on a virtual source's relay; 1e10 for distant sources
  double cosine = 1;    // of the hit, positive on the front
  V3d normal{0, 0, 0};
  LightId source;
};

// How a source is sampled.
struct SourceSampling {
  double largest = 0;  // the largest ratio of a part's size to its distance (-ds); 0: sources are not split
  double jitter = 0;   // the share of a part that its ray is spread over (-dj), 0 to 1
  // Sources that lie entirely behind the plane through the point with this normal (unit) are omitted. If it
  // is 0, none is omitted.
  V3d front{0, 0, 0};
};

class LightSources {
 public:
  // Keeps a reference to the scene. Distant glow, and glow whose reach is zero or negative, are not included.
  explicit LightSources(const Scene& scene);

  // The same, with virtual sources from sequences of up to `relays` relays (-dr): see relays.h.
  LightSources(const Scene& scene, int relays, const SurfaceFunctions& functions, const rad::Warn& warn);

  const ById<LightId, LightSource>& all() const { return sources_; }

  // Appends the samples of one source as seen from a point, one for each of at most 64 parts. There are none
  // if the source cannot light the point: it faces away, or the point is beyond its reach or outside its
  // spot. A sample that misses the source it was aimed at is omitted. A sample of a virtual source is only
  // tested against the first relay; a ray in its direction may still return no light.
  void sample(LightId source, const V3d& point, const SourceSampling& how, Random& random,
              std::vector<SourceSample>& samples) const {
    // Most sources face away or lie behind the surface, and most images shine elsewhere. These tests are
    // inline because they save the call in most cases.
    const LightSource& light = sources_[source];
    const V3d towards = light.distant ? light.center : light.center - point;
    if (light.isPlane() && towards.dot(light.normal) >= 0) return;
    if (towards.dot(how.front) < -light.outermost) return;
    if (light.beam.cosine > 0 && surelyBeside(light, towards)) return;
    sampleParts(source, point, towards, how, random, samples);
  }

 private:
  // Whether a point lies outside a virtual source's beam by more than rounding. Needs no square root.
  static bool surelyBeside(const LightSource& light, const V3d& towards) {
    const double along = -towards.dot(light.beam.axis), cosine = light.beam.cosine;
    return along < 0 || along * along < (1 - 1e-12) * cosine * cosine * towards.length2();
  }
  void sampleParts(LightId source, const V3d& point, const V3d& towards, const SourceSampling& how,
                   Random& random, std::vector<SourceSample>& samples) const;
  void findSources();
  void measureParts();

  const Scene& scene_;
  ById<LightId, LightSource> sources_;
};

}  // namespace rsphere
