#include "transport/gather_directions.h"

#include <algorithm>
#include <cmath>

#include "base/even_sequence.h"
#include "rays/ray_functions.h"
#include "shade/scattering.h"
#include "transport/ray_limits.h"
#include "transport/tuning.h"

namespace rsphere {
namespace {

// Caps on the fractions of aimed directions. They limit the weight of unaimed directions to twice their
// weight without aiming (with highlights, a third more than twice), and thus the growth of their variance.
constexpr double kMostToOpenings = 1 - 1. / 2, kMostToHighlights = 1 - 3. / 4;

// The mean radiance (W/sr/m2) from directions that are not aimed. Where there are openings, two estimates are
// made near them, where a room is brighter than elsewhere, and the smaller one is used.
double usualRadiance(const Aims& aims) {
  if (!aims.openings && !aims.images) return aims.spots ? aims.spots->usual() : aims.highlights->usual();
  const double inside = aims.openings ? aims.openings->inside() : aims.images->inside();
  const double least = aims.spots ? std::min(inside, aims.spots->usual()) : inside;
  return tuning::GatherDirections::kFartherInside * least;
}

}  // namespace

GatherDirections::GatherDirections(const Aims& aims, const V3d& point, const V3d& normal,
                                   const V3d& trueNormal, int rays)
    : normal_(normal),
      trueNormal_(trueNormal),
      openings_(aims.openings),
      images_(aims.images),
      spots_(aims.spots),
      highlights_(aims.highlights) {
  if (aims.openings) aims.openings->aim(point, normal, openings_.aim);
  if (aims.images) aims.images->aim(point, normal, images_.aim);
  if (aims.spots) aims.spots->aim(point, normal, spots_.aim);
  const double aimedAt = openings_.aim.mean + images_.aim.mean + spots_.aim.mean;
  if (!(aimedAt > 0) && !aims.highlights) return;
  const double all = aimedAt + usualRadiance(aims);
  if (aims.highlights) {
    aims.highlights->aim(point, normal, all, rays, highlights_.aim);
    // `all` can be 0, if that was the estimate for a room that little light enters.
    if (highlights_.aim.mean > 0) highlights_.share = std::min(kMostToHighlights, highlights_.aim.mean / all);
  }
  if (!(aimedAt > 0)) return;
  // Unaimed directions hit openings, too, in proportion to the form factor. If these alone reach the cap on
  // the fraction of directions towards openings, none is aimed.
  const double seen = openings_.aim.seen + images_.aim.seen;
  const double unseen = std::max(0., 1 - seen / kMostToOpenings);
  const double mean = openings_.aim.mean + images_.aim.mean;
  const double share = std::min(kMostToOpenings, tuning::GatherDirections::kAimed * mean / all * unseen);
  if (mean > 0) {
    openings_.share = share * (openings_.aim.mean / mean);
    images_.share = share * (images_.aim.mean / mean);
  }
  spots_.share = tuning::GatherDirections::kAimed * spots_.aim.mean / all;
}

// The density of the mixture in a direction, relative to sampling by projected solid angle.
double GatherDirections::density(const V3d& direction) const {
  const double aimed = openings_.density(direction) + images_.density(direction) + spots_.density(direction) +
                       highlights_.density(direction);
  return unaimed() + aimed * kPi / direction.dot(normal_);
}

void GatherDirections::draw(const DirectionSet& set, Each each) const {
  constexpr double kGolden = .6180339887498949;
  const auto& [count, shifts, first, step] = set;
  const auto [shift1, shift2, shift3] = shifts;
  for (int i = first; i < count; i += step) {
    // Systematic sampling: the directions of a kind are consecutive, and the number of each kind differs from
    // its expected value by less than 1. Within each kind, u is evenly spaced between 0 and 1.
    double u = (i + shift1) / count;
    const Imath::V2d even = evenly(static_cast<size_t>(i), shift2, shift3);
    V3d direction;
    if (u < openings_.share) {
      direction = openings_.sample(u, even.x, even.y);
    } else if ((u -= openings_.share) < images_.share) {
      direction = images_.sample(u, even.x, even.y);
    } else if ((u -= images_.share) < spots_.share) {
      direction = spots_.sample(u, even.x, even.y);
    } else if ((u -= spots_.share) < highlights_.share) {
      direction = highlights_.sample(u, even.x, even.y);
    } else {
      // A randomly shifted Fibonacci lattice over the projected hemisphere. It is as evenly distributed as a
      // jittered grid, for any number of rays.
      const double around = shift2 + i * kGolden;
      direction = diffuseDirection(normal_, std::min(1., (u - highlights_.share) / unaimed()),
                                   around - std::floor(around));
    }
    if (direction.dot(normal_) <= 0 || direction.dot(trueNormal_) <= 0) continue;
    each(direction, 1 / (density(direction) * count));
  }
}

void sendOverHemisphere(const PreparedScene& prepared, const GatherDirections& directions, PathState& state,
                        const RayEnd& root, const V3d& point, RayKind kind, const DirectionSet& set,
                        const Coefficient& coefficient, const Coefficient& weight, GatherRay each) {
  const Coefficient arriving = root.context.contribution * passedBy(root);
  directions.draw(set, [&](const V3d& direction, double part) {
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
