#include "transport/gather_directions.h"

#include <algorithm>
#include <cmath>

#include "base/even_sequence.h"
#include "base/stop_check.h"
#include "rays/ray_functions.h"
#include "shade/scattering.h"
#include "transport/ray_limits.h"
#include "transport/tuning.h"

namespace rsphere {
namespace {

// The fraction of rays that are aimed at places of a kind is `aimed` times the fraction of the light from
// them, and at most `most`. Where one kind gets most of the light, the limit bounds the weight of unaimed
// directions to twice their weight without aiming (with highlights, a third more than twice), and thus the
// growth of their variance. It matters most for patches, whose few rays are links: with 1 for spots, rays
// into thin gaps below a lamp had 15% of noise with -Sa .02, which grew from bounce to bounce
// (tests/bench/rtrace/runs/2026-11-29-gaps.txt).
struct Share {
  double aimed, most;
};
Share shareOf(AimedAt kind) {
  return kind == AimedAt::highlights ? Share{1, 1 - 3. / 4}
                                     : Share{tuning::GatherDirections::kAimed, 1 - 1. / 2};
}

// The mean radiance (W/sr/m2) from directions that are not aimed. Where there are openings, two estimates are
// made near them, where a room is brighter than elsewhere, and the smaller one is used.
double usualRadiance(const Aims& aims) {
  const auto* const openings = aims.of<Openings>();
  const auto* const images = aims.of<OpeningImages>();
  const auto* const spots = aims.of<BrightSpots>();
  const auto* const highlights = aims.of<Highlights>();
  if (!openings && !images) return spots ? spots->usual() : highlights ? highlights->usual() : 0;
  const double inside = openings ? openings->inside() : images->inside();
  return tuning::GatherDirections::kFartherInside * (spots ? std::min(inside, spots->usual()) : inside);
}

// The fraction of the rays that one finder gets: its part of what the finders of its kind share. all: mean
// radiance over the hemisphere (W/sr/m2).
template <class One, class... Finder>
double shareOf(const ShareOfMixture<One>& one, double all, const ShareOfMixture<Finder>&... each) {
  if (!(one.aim.mean > 0)) return 0;
  double mean = 0, seen = 0;
  ((each.kKind == one.kKind ? (mean += each.aim.mean, seen += each.seen()) : 0), ...);
  // Unaimed directions hit the places, too, as often as they fill the hemisphere. If these alone reach the
  // limit, none is aimed.
  const auto [aimed, most] = shareOf(one.kKind);
  const double unseen = std::max(0., 1 - seen / most);
  // `all` can be 0, if that was the estimate for a room that little light enters.
  return std::min(most, aimed * mean / all * unseen) * (one.aim.mean / mean);
}

constexpr double kGolden = .6180339887498949;

}  // namespace

// In the finer lattice, kInterleavedGathers steps forward are one step of each set. Of the generators with
// this property, those chosen have small errors with 16 to 310 directions (2026-11-30-lattices.txt).
DirectionSet DirectionSet::interleaved(int count, int number, Random& common) {
  constexpr int kSets = kInterleavedGathers;
  DirectionSet set(count, common);
  const int position = (number + static_cast<int>(kSets * common.uniform())) % kSets;
  const Imath::V2d ofSet = evenly(1, 0, 0);
  set.sequence = (set.sequence + position) / kSets;
  set.azimuth += position * kGolden / kSets;
  set.x += position * (1 + ofSet.x) / kSets;
  set.y += position * (1 + ofSet.y) / kSets;
  return set;
}

GatherDirections::GatherDirections(const Aims& aims, const V3d& point, const V3d& normal,
                                   const V3d& trueNormal, int rays)
    : normal_(normal), trueNormal_(trueNormal), shares_(aims.all()) {
  AimFrom from{point, normal, rays};
  double aimedAt = 0;
  const auto ask = [&](auto& part, bool highlights) {
    if (!part.finder || (part.kKind == AimedAt::highlights) != highlights) return;
    part.finder->aim(from, part.aim);
    if (!highlights) aimedAt += part.aim.mean;
  };
  std::apply(
      [&](auto&... part) {
        (ask(part, false), ...);
        from.all = aimedAt + usualRadiance(aims);
        (ask(part, true), ...);
        ((part.share = shareOf(part, from.all, part...)), ...);
        // A whole number of directions is aimed, so that the others have equal parts of exactly what is left.
        // Where few directions are drawn, as at patches, the part of these others would otherwise vary from
        // set to set, and light could grow from patch to patch: of 4 directions, .7 of them aimed, 1 or 2 are
        // not, and 2 count 1.67 times. Where less than a quarter is aimed, the others vary little.
        const double aimed = (... + part.share);
        const double whole = std::min(std::round(aimed * rays), rays - 1.) / rays;
        if (aimed > 1. / 4 && rays > 1) ((part.share *= whole / aimed), ...);
      },
      shares_);
}

double GatherDirections::unaimed() const {
  return std::apply([](const auto&... part) { return (1 - ... - part.share); }, shares_);
}

// The density of the mixture in a direction, relative to sampling by projected solid angle.
double GatherDirections::density(const V3d& direction) const {
  const double aimed =
      std::apply([&](const auto&... part) { return (... + part.density(direction)); }, shares_);
  return unaimed() + aimed * kPi / direction.dot(normal_);
}

void GatherDirections::draw(const DirectionSet& set, Each each) const {
  for (int i = set.first; i < set.count; i += set.step) {
    // Systematic sampling: the directions of a kind are consecutive, and the number of each kind differs from
    // its expected value by less than 1. Within each kind, u is evenly spaced between 0 and 1.
    double u = (i + set.sequence) / set.count;
    const Imath::V2d even = evenly(static_cast<size_t>(i), set.x, set.y);
    V3d direction;
    const auto isAimedAt = [&](const auto& part) {
      if (u < part.share) {
        direction = part.sample(u, even.x, even.y);
        return true;
      }
      u -= part.share;
      return false;
    };
    if (!std::apply([&](const auto&... part) { return (isAimedAt(part) || ...); }, shares_)) {
      // A randomly shifted Fibonacci lattice over the projected hemisphere. It is as evenly distributed as a
      // jittered grid, for any number of rays.
      const double around = set.azimuth + i * kGolden;
      direction = diffuseDirection(normal_, std::min(1., u / unaimed()), around - std::floor(around));
    }
    if (direction.dot(normal_) <= 0 || direction.dot(trueNormal_) <= 0) continue;
    each(direction, 1 / (density(direction) * set.count));
  }
}

void sendOverHemisphere(const PreparedScene& prepared, const GatherDirections& directions, PathState& state,
                        const RayEnd& root, const V3d& point, RayKind kind, const DirectionSet& set,
                        const Coefficient& coefficient, const Coefficient& weight, GatherRay each) {
  const Coefficient arriving = root.context.contribution * passedBy(root);
  directions.draw(set, [&](const V3d& direction, double part) {
    if (root.context.ambientLevel == 0) StopCheck::here();
    NextRay next(root, kind, weight);
    if (!goesOnAlong(next, prepared, state)) return;
    next.query.origin = point;
    next.query.direction = direction;
    ++next.context.ambientLevel;
    next.coefficient = coefficient * (part * maxChannel(next.coefficient) / maxChannel(weight));
    next.context.contribution = arriving * next.coefficient;
    each(next);
  });
}

}  // namespace rsphere
