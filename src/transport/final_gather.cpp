#include "transport/final_gather.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "rays/ray_functions.h"
#include "transport/gather_directions.h"
#include "transport/ray_limits.h"
#include "transport/tuning.h"

namespace rsphere {
namespace {

// The parent of the rays of a gather: a fictitious ray that has hit the site.
struct Root {
  RayQuery query;
  PathContext context;
  RayEnd end{query, context};

  Root(const PreparedScene& prepared, const GatherSite& site, int depth) {
    context.space.medium = prepared.options().medium();
    context.depth = depth;
    end.hit.point = site.point;
    end.hit.normal = site.normal;
    end.hit.length = 0;
  }
};

}  // namespace

double mostAddedAtSensors(const RayOptions& options) {
  return tuning::SensorNoise::kMostAdded * std::min(options.ambientSuperSamples, options.ambientDivisions);
}

GatheredLight TracedFieldRays::gather(const GatherSite& site, double nearest, uint64_t seed) {
  const InnerPath path = path_.beginGather(seed, site.normal);
  const Root root(t_, site, depth_);
  const auto [x, y] = frame(site.normal);
  const int count = raysOfRecord(t_.options(), litBy(path.settings.aims, path.settings.caches.byLamps));
  const HemisphereCells cells(count);
  std::vector<Radiance> radiance(cells.count());
  std::vector<double> distance(cells.count(), kFarAway);
  const GatherDirections directions(path.settings.aims, site.point, site.normal, site.normal, count);
  sendOverHemisphere(t_, directions, path.state, root.end, site.point, kReflectedAmbient,
                     DirectionSet(count, path.state.random), Coefficient(1), Coefficient(kMeanReflectance),
                     [&, x = x, y = y](const NextRay& next) {
                       countDescendants(path.settings, path.state, next.context);
                       const RayResult seen = path.follower.follow(next.query, next.context);
                       const int cell = cells.cellOf(next.query.direction, x, y, site.normal);
                       radiance[cell] += seen.value * next.coefficient * cells.count();
                       distance[cell] = std::min(distance[cell], apparentLength(seen));
                     });
  return cells.sum(radiance, distance, nearest, x, y, site.normal);
}

// IndirectLight::link() adds the light and the links beyond the first hits.
PatchLinks TracedFieldRays::link(std::span<const PatchSite> sites, int rays, uint64_t seed) {
  const InnerPath path = path_.beginGather(seed, sites.front().site.normal);
  PatchLinks links;
  links.links.reserve(static_cast<size_t>(rays));  // most rays make one link
  path.state.links = &links;
  path.state.descendants = descendantsOfPatch(rays, depth_);
  // One set of directions for all sites: each site uses some of the directions, as far apart as possible.
  DirectionSet set(rays, path.state.random);
  set.step = std::min(static_cast<int>(sites.size()), rays);
  for (; set.first < set.step; ++set.first) {
    const GatherSite& site = sites[static_cast<size_t>(set.first)].site;
    links.weight = sites[static_cast<size_t>(set.first)].weight;
    Radiance sum;
    const Root root(t_, site, depth_);
    const GatherDirections directions(path.settings.aims, site.point, site.normal, site.normal, rays);
    sendOverHemisphere(t_, directions, path.state, root.end, site.point, kReflectedAmbient, set,
                       Coefficient(1), Coefficient(kMeanReflectance), [&](const NextRay& next) {
                         countDescendants(path.settings, path.state, next.context);
                         sum += path.follower.follow(next.query, next.context).value * next.coefficient;
                       });
    links.addLight(0, sum);
  }
  links.rays = path.state.descendants.rays;
  return links;
}

double TracedFieldRays::clearance(const GatherSite& site, double farthest) {
  const Hit hit = t_.tracer().nearest(site.point, site.normal, farthest);
  return hit.surface == kNone ? farthest : hit.distance;
}

Surroundings TracedFieldRays::surroundings(const GatherSite& site) {
  // Directions distributed by projected solid angle, in the frame of the site.
  static const auto directions = [] {
    const HemisphereCells cells(tuning::Interpolation::kReachRays);
    std::vector<V3d> of(cells.count());
    for (int i = 0; i < cells.count(); ++i)
      of[i] = cells.direction(i, .5, .5, V3d(1, 0, 0), V3d(0, 1, 0), V3d(0, 0, 1));
    return of;
  }();
  const auto [x, y] = frame(site.normal);
  double inverse = 0, squares = 0, hits = 0;
  for (const V3d& d : directions) {
    const Hit hit = t_.tracer().nearest(site.point, d.x * x + d.y * y + d.z * site.normal);
    if (hit.surface == kNone) continue;
    ++hits;
    inverse += 1 / hit.distance;
    squares += hit.distance * hit.distance;
  }
  if (hits == 0) return {kFarAway, kFarAway, 0};
  const auto count = static_cast<double>(directions.size());
  return {count / inverse, std::sqrt(squares / hits), hits / count};
}

bool TracedFieldRays::sees(const V3d& from, const V3d& to) {
  const V3d way = to - from;
  const double length = way.length();
  return !(length > t_.scene().samePlace) || t_.tracer().isClear(from, way / length, length);
}

bool TracedFieldRays::smallObjectNear(const GatherSite& site, double side, double lift) {
  // Reduces the limit, so that an object as wide as the cell does not count as smaller because of rounding.
  constexpr double kRounding = 1e-6;
  return t_.tracer().anySmallNear({site.point, site.normal, side, side * (1 - kRounding), 3 * lift});
}

}  // namespace rsphere
