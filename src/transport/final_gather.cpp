#include "transport/final_gather.h"

#include <algorithm>
#include <vector>

#include "field/irradiance_field.h"
#include "transport/gather_directions.h"
#include "transport/ray_functions.h"
#include "transport/ray_limits.h"

namespace rsphere {
namespace {

// An imagined ray that has hit the site, the parent of the gather's rays.
Ray rootOf(const PreparedScene& prepared, const GatherSite& site, int depth) {
  Ray root;
  root.medium = prepared.medium();
  root.point = site.point;
  root.normal = site.normal;
  root.length = 0;
  root.depth = depth;
  return root;
}

}  // namespace

GatheredLight gatherLight(const PreparedScene& prepared, PathState& state, const PathSettings& settings,
                          RayFollower& follower, const GatherSite& site, double nearest, int depth) {
  const RayOptions& o = prepared.options();
  const Ray root = rootOf(prepared, site, depth);
  V3d x, y;
  frame(site.normal, x, y);
  const int count = o.ambientDivisions + o.ambientSuperSamples;
  const HemisphereCells cells(count);
  std::vector<Radiance> radiance(cells.count());
  std::vector<double> distance(cells.count(), kFarAway);
  const GatherDirections directions(settings.aims, site.point, site.normal, site.normal, count);
  sendOverHemisphere(prepared, directions, settings, state, root, kReflectedAmbient, count, Coefficient(1),
                     Coefficient(kMeanReflectance), [&](Ray& child, const Coefficient& factor) {
                       follower.follow(child);
                       const int cell = cells.cellOf(child.direction, x, y, site.normal);
                       radiance[cell] += child.value * factor * cells.count();
                       distance[cell] = std::min(distance[cell], apparentLength(child));
                     });
  return cells.sum(radiance, distance, nearest, x, y, site.normal);
}

void linkPatch(const PreparedScene& prepared, PathState& state, const PathSettings& settings,
               RayFollower& follower, const GatherSite& site, int rays, int depth) {
  const Ray root = rootOf(prepared, site, depth);
  state.descendants = descendantsOfPatch(rays, depth);
  Radiance sum;
  const GatherDirections directions(settings.aims, site.point, site.normal, site.normal, rays);
  sendOverHemisphere(prepared, directions, settings, state, root, kReflectedAmbient, rays, Coefficient(1),
                     Coefficient(kMeanReflectance), [&](Ray& child, const Coefficient& factor) {
                       follower.follow(child);
                       sum += child.value * factor;
                     });
  state.links->addLight(0, sum);
}

}  // namespace rsphere
