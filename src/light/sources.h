#pragma once
// The light sources of a scene and how they are sampled from a point: a source is split into parts that are
// small compared with their distance (-ds), and one ray goes to each part, at its middle or jittered (-dj).
#include <vector>

#include "light/light_source.h"
#include "scene/random.h"
#include "shade/spot_cone.h"
#include "shade/surface_functions.h"

namespace rsphere {

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
  // Balls are split as well if they are jittered. rtrace never splits them, and where many rays are averaged
  // it would not pay.
  bool splitsBalls = false;
  // Jittered samples of cylinders lie on the side that faces the point. Otherwise they lie in the plane
  // through the axis, as in rtrace, so that rays aimed past the rim miss, and a short wide cylinder loses
  // much of its light ("source aspect too small").
  bool tubesInDepth = false;
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
    const V3d towards = light.isDistant() ? light.center : light.center - point;
    if (const auto* plane = light.as<PlaneLight>(); plane && towards.dot(plane->normal) >= 0) return;
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

  const Scene& scene_;
  ById<LightId, LightSource> sources_;
};

}  // namespace rsphere
