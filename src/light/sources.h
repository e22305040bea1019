#pragma once
// The light sources of a scene, and how they are sampled from a point: a source is split into parts that are
// small compared with their distance (-ds), and one ray is sent to each part, at its middle or jittered
// (-dj).
#include <vector>

#include "base/random.h"
#include "light/light_source.h"
#include "shade/surface_functions.h"

namespace rsphere {

// One ray towards a source. solidAngle (sr) is its weight: the sum over all samples of a source estimates the
// source's solid angle. For plane sources the weight is area * cosine / distance^2 at the sample. For spheres
// and distant sources, the estimate is exact if the surface at the point faces them.
struct SourceSample {
  V3d direction{0, 0, 0};
  double solidAngle = 0;
  double distance = 0;  // to the hit on the source or on the relay of a virtual source; 1e10 if distant
  double cosine = 1;    // at the hit, positive on the front
  V3d normal{0, 0, 0};
  LightId source;
};

struct SourceSampling {
  double largest = 0;  // the largest ratio of a part's size to its distance (-ds); 0: sources are not split
  double jitter = 0;   // size of the jittered region relative to the part (-dj), 0 to 1
  // Normal (unit) of the surface at the point. Sources that lie entirely behind its plane are omitted; 0:
  // none is omitted.
  V3d front{0, 0, 0};
  // Whether balls are split, too, if they are jittered. rtrace never splits balls. Where many rays are
  // averaged, splitting them does not pay.
  bool splitsBalls = false;
};

class LightSources {
 public:
  // Keeps a reference to the scene. Distant glow, and glow with a reach of zero or less, are not included.
  explicit LightSources(const Scene& scene);

  // Includes virtual sources, from sequences of up to `relays` relays (-dr): see relays.h.
  LightSources(const Scene& scene, int relays, const SurfaceFunctions& functions, const rad::Warn& warn);

  const ById<LightId, LightSource>& all() const { return sources_; }

  // Appends the samples of one source as seen from a point, one for each of at most 64 parts. Appends none if
  // the source cannot light the point: it faces away, or the point is beyond its reach or outside its cone. A
  // sample that misses the source is omitted. For a virtual source only the first relay is tested; a ray in
  // the sample's direction may still return no light.
  void sample(LightId source, const V3d& point, const SourceSampling& how, Random& random,
              std::vector<SourceSample>& samples) const {
    // Inline because it usually avoids a call: most sources face away or lie behind the surface, and most
    // virtual sources light other places.
    static_assert(kLightForms == 8, "Does it shine to one side only?");
    const LightSource& light = sources_[source];
    const V3d towards = light.isDistant() ? light.center : light.center - point;
    if (const auto* plane = light.as<PlaneLight>(); plane && towards.dot(plane->normal) >= 0) return;
    if (towards.dot(how.front) < -light.outermost) return;
    if (light.beam.cosine > 0 && surelyBeside(light, towards)) return;
    sampleParts(source, point, towards, how, random, samples);
  }
  // The density, per area of the source (1/m2), with which sample() aims from a point at the place that a ray
  // has hit, if the source is not split, with jitter 1. hit: its source, direction, distance and cosine.
  // REQUIRES that the source is not distant.
  double density(const SourceSample& hit, const V3d& point) const;

 private:
  // Whether a point surely lies outside a virtual source's beam, despite rounding. Uses no square root.
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
