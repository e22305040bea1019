#pragma once
// Next-event estimation: direct light from the light sources, with its shadows.
//
// All sources are sampled, and the brightest contributions are tested for shadows first. Contributions too
// weak to matter are estimated without a shadow ray (-dt, -dc). With -Ss, a random selection of sources is
// sampled.
#include <vector>

#include "base/function_ref.h"
#include "light_paths/plain_surfaces.h"
#include "rays/ray_follower.h"

namespace rsphere {

// The fraction of a source's radiance that a surface scatters back along a ray. toSource: direction to the
// source (unit); solidAngle: of the source sample (sr).
using DirectCoefficient = FunctionRef<Coefficient(const V3d& toSource, double solidAngle)>;

// The part of a DirectCoefficient that is estimated by samples of the lobe instead of shadow rays
// (shared_highlights.h). It is subtracted for a source sample only if the sample is not occluded.
using PartOfLobe = FunctionRef<Coefficient(const SourceSample& sample)>;

class DirectLight : PathPart {
  // Binary logarithm of the size of the table of blockers, which takes 16 kB, half of a core's first-level
  // cache.
  static constexpr int kBlockerBits = 12;

 public:
  // Shadow rays are followed through surfaces that may transmit light.
  explicit DirectLight(const PathPart& path)
      : PathPart(path), blockers_(size_t{1} << kBlockerBits, Tracer::kNoBlocker) {}

  // The place that is lit: the end of a ray, or the far side of a thick surface that transmits light (world).
  struct Receiver {
    const RayEnd& end;
    const V3d& point;
    // If not null, light from known sources is omitted, because paths from both ends estimate it
    // (plain_surfaces.h), unless it has passed a surface that is not known.
    const PlainSurfaces* leftToBothEnds = nullptr;
  };

  // Adds the direct light to the radiance of the ray (W/sr/m2). The brighter the radiance already is, the
  // fewer sources are tested for shadows. front: normal of a surface that transmits no light, behind which
  // all coefficients are 0; otherwise the null vector. partOfLobe: null if shadow rays estimate all of the
  // light.
  void add(Receiver at, DirectCoefficient coefficientOf, const V3d& front, const PartOfLobe* partOfLobe,
           Radiance& value);

  // add(), estimated from -Ss randomly selected sources.
  void addOfChosen(Receiver at, DirectCoefficient coefficientOf, const V3d& front, Radiance& value);

  // Adds the light of one source that is scattered at the end of a ray (W/sr/m2).
  void addFromSource(const RayEnd& end, LightId source, DirectCoefficient coefficientOf, Radiance& value);

 private:
  struct Contribution {
    const SourceSample* sample;
    Coefficient coefficient;
    Radiance value;
  };

  size_t lookAheadOf(size_t count);
  void rankByBrightness(uint32_t count);
  Radiance sourceValue(Receiver at, const SourceSample& sample);
  bool aim(NextRay& next, Receiver at, const Contribution& to);
  Radiance valueFromSource(Receiver at, const Contribution& to);
  void show(Receiver at, const Contribution& to);
  std::span<const uint32_t> notHiddenFrom(const V3d& point, const V3d& front) const;
  uint32_t findContributions(Receiver at, DirectCoefficient coefficientOf, const V3d& front,
                             const PartOfLobe* partOfLobe);
  void addSamples(Receiver at, LightId source, const SourceSampling& how, DirectCoefficient coefficientOf,
                  double factor, Radiance& value);
  void addOneOf(Receiver at, size_t first, uint32_t count, Radiance& value);
  bool arrives(Receiver at, Contribution& to, Radiance& value);
  bool isWhole(const SourceSample& sample) const;
  bool isLeftOut(Receiver at, const SourceSample& sample) const {
    return at.leftToBothEnds &&
           bringLightOf(sample.source, t_, *at.leftToBothEnds, at.point, sample.direction);
  }
  uint32_t& blockerOf(SurfaceId surface, LightId source) {
    const uint64_t both =
        (uint64_t{static_cast<uint32_t>(surface.number())} << 32) | static_cast<uint32_t>(source.number());
    // Fibonacci hashing.
    return blockers_[(both * 0x9e3779b97f4a7c15u) >> (64 - kBlockerBits)];
  }

  // Memory that all calls reuse, so that none is allocated. Calls do not nest, because shadow rays never
  // compute direct light. Elements after those of the current call are left over from earlier calls.
  struct Scratch {
    std::vector<SourceSample> samples;
    std::vector<Contribution> contributions;
    std::vector<double> brightness;  // of the contributions
    // For each contribution, the part of its coefficient that PartOfLobe gave; empty without a PartOfLobe.
    std::vector<Coefficient> ofLobe;
    std::vector<uint32_t> order;  // of the contributions; brightest first if not all of them are tested
    std::vector<double> remaining;
    std::vector<double> sourceWeights;
  };
  Contribution& ranked(size_t i) { return scratch_.contributions[scratch_.order[i]]; }
  double rankedBrightness(size_t i) const { return scratch_.brightness[scratch_.order[i]]; }

  Scratch scratch_;
  // A hash table: the last blocker of a shadow ray between a surface and a source, which is tested first.
  std::vector<uint32_t> blockers_;
  std::vector<size_t> lookAheads_;  // results of lookAheadOf(), by its argument; computed when needed
};

}  // namespace rsphere
