#pragma once
// Next-event estimation: direct light from the light sources, with its shadows.
//
// All sources are sampled, the brightest contributions are tested for shadows first, and those too weak to
// matter are estimated without a shadow ray (-dt, -dc). With -Ss sources are drawn at random instead.
#include <vector>

#include "transport/function_ref.h"
#include "transport/path_state.h"
#include "transport/plain_surfaces.h"
#include "transport/prepared_scene.h"
#include "transport/ray_follower.h"

namespace rsphere {

// The share of a source's radiance that a surface scatters back along a ray, given the direction to the
// source (unit) and the solid angle (sr) of a sample of it.
using DirectCoefficient = FunctionRef<Coefficient(const V3d& toSource, double solidAngle)>;

// The part of a DirectCoefficient that samples of a highlight's lobe estimate instead of shadow rays
// (shared_highlights.h). It is left out for a sample of the source only if nothing lies between it and the
// surface.
using PartOfLobe = FunctionRef<Coefficient(const SourceSample& sample)>;

class DirectLight {
  // The binary logarithm of the number of blockers that are kept: 16 kB, half of a core's first cache.
  static constexpr int kBlockerBits = 12;

 public:
  // Keeps references. follower: follows shadow rays through surfaces that may transmit light.
  DirectLight(const PreparedScene& prepared, const PathSettings& settings, PathState& state,
              RayFollower& follower)
      : t_(prepared),
        settings_(settings),
        state_(state),
        follower_(follower),
        blockers_(size_t{1} << kBlockerBits, Tracer::kNoBlocker) {}

  // Where light arrives: at the end of a ray, or beyond it for light that a thick surface transmits (world).
  struct Receiver {
    const RayEnd& end;
    const V3d& point;
    // If not null, light of known sources is left out, unless it has met a surface that is not known: paths
    // from both ends bring it (plain_surfaces.h).
    const PlainSurfaces* leftToBothEnds = nullptr;
  };

  // Adds the direct light to the radiance of the ray (W/sr/m2). The brighter that radiance already is, the
  // fewer sources are tested. front: for a surface that transmits no light, its normal, because all
  // coefficients are 0 behind it; otherwise the null vector. partOfLobe: null if shadow rays estimate all of
  // the light.
  void add(Receiver at, DirectCoefficient coefficientOf, const V3d& front, const PartOfLobe* partOfLobe,
           Radiance& value);

  // The same, but estimated from -Ss sources drawn at random.
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
  uint32_t findContributions(Receiver at, DirectCoefficient coefficientOf, const V3d& front,
                             const PartOfLobe* partOfLobe);
  void addSamples(Receiver at, LightId source, const SourceSampling& how, DirectCoefficient coefficientOf,
                  double factor, Radiance& value);
  void addOneOf(Receiver at, size_t first, uint32_t count, Radiance& value);
  bool arrives(Receiver at, Contribution& to, Radiance& value);
  bool isWhole(const SourceSample& sample) const;
  static bool isLeftOut(Receiver at, LightId source) {
    return at.leftToBothEnds && at.leftToBothEnds->knows(source);
  }
  uint32_t& blockerOf(SurfaceId surface, LightId source) {
    const uint64_t both =
        (uint64_t{static_cast<uint32_t>(surface.number())} << 32) | static_cast<uint32_t>(source.number());
    // Fibonacci hashing.
    return blockers_[(both * 0x9e3779b97f4a7c15u) >> (64 - kBlockerBits)];
  }

  const PreparedScene& t_;
  const PathSettings& settings_;
  PathState& state_;
  RayFollower& follower_;
  // Memory of one call. Calls do not nest, because shadow rays never compute direct light. Elements beyond
  // those of the current call are left over from earlier calls.
  struct Scratch {
    std::vector<SourceSample> samples;
    std::vector<Contribution> contributions;
    std::vector<double> brightness;  // of the contributions
    // The part of each contribution's coefficient that PartOfLobe left to samples of the lobe; empty if none.
    std::vector<Coefficient> ofLobe;
    std::vector<uint32_t> order;  // of the contributions, brightest first where not all are tested
    std::vector<double> remaining;
    std::vector<double> sourceWeights;
  };
  Contribution& ranked(size_t i) { return scratch_.contributions[scratch_.order[i]]; }
  double rankedBrightness(size_t i) const { return scratch_.brightness[scratch_.order[i]]; }

  Scratch scratch_;
  // The index is a hash of a surface and a source, the value what blocked the last shadow ray between them.
  std::vector<uint32_t> blockers_;
  std::vector<size_t> lookAheads_;  // values of lookAheadOf(), by its argument; computed as far as needed
};

}  // namespace rsphere
