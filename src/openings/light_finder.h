#pragma once
// The interface of a way to find light at which gathers aim rays.
#include <concepts>
#include <cstdint>

#include "scene/shape.h"

namespace rsphere {

// The kinds of places at which rays are aimed. Finders of one kind share a limit on the aimed rays, which
// gather_directions.cpp has for each kind.
enum class AimedAt : uint8_t { openings, spots, highlights };

// A place of a diffuse surface that sends the rays of a gather.
struct AimFrom {
  V3d point, normal;  // world; unit, on the side where the light arrives
  int rays = 0;       // approximate number of rays of the gather
  // For finders of highlights: an estimate of the mean radiance over the hemisphere (W/sr/m2) without
  // highlights. 0 for other finders, whose light is a part of it.
  double all = 0;
};

// Contains the places that it has found in a scene, and proposes directions to them from any point. Missed
// and misplaced places change the variance of gathers, not their mean.
template <class Finder>
concept LightFinder = requires(const Finder& finder, const AimFrom& from, typename Finder::Aim& aim,
                               const V3d& direction, double u) {
  { Finder::kKind } -> std::convertible_to<AimedAt>;
  { finder.empty() } -> std::same_as<bool>;
  // Sets the proposals for a place. aim.mean is the mean radiance over the hemisphere from them, without
  // occlusion (W/sr/m2). aim.seen, if it exists, is the fraction of the hemisphere that they fill.
  finder.aim(from, aim);
  { aim.mean } -> std::convertible_to<double>;
  // A direction towards a proposal (unit), or 0 if the sample misses it; each u: uniform in [0, 1). REQUIRES
  // aim.mean > 0.
  { finder.sample(aim, u, u, u) } -> std::same_as<V3d>;
  // The density of the directions of sample(), per sr.
  { finder.density(aim, direction) } -> std::same_as<double>;
};

// A finder with its fraction of a mixture of directions. finder: null if there is none; its share is then 0.
template <LightFinder Finder>
struct ShareOfMixture {
  static constexpr AimedAt kKind = Finder::kKind;
  const Finder* finder;
  typename Finder::Aim aim;
  double share = 0;

  explicit ShareOfMixture(const Finder* of) : finder(of) {}
  // The fraction of the hemisphere that the proposals fill; 0 for proposals that are small.
  double seen() const {
    if constexpr (requires { aim.seen; }) return aim.seen;
    return 0;
  }
  // u: uniform in [0, share).
  V3d sample(double u, double u2, double u3) const { return finder->sample(aim, u / share, u2, u3); }
  double density(const V3d& direction) const {
    return share > 0 ? share * finder->density(aim, direction) : 0;
  }
};

}  // namespace rsphere
