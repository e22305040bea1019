#include "light_paths/sky_emission.h"

#include "base/constants.h"
#include "spots/light_particles.h"

namespace rsphere {

SkyEmission::SkyEmission(const Portals& portals, double paths) : portals_(portals) {
  for (const Opening& p : portals.all()) sum_ += p.area() * p.radiance;
  if (paths > 0) pathPower_ = kPi * sum_ / paths;
}

SkyEmission::Leaving SkyEmission::leave(double where, int most, Random& random, OutdoorParts outdoors) const {
  double due = where * sum_;
  const Opening* portal = portals_.all().data();
  for (const Opening* const last = portal + portals_.all().size() - 1; portal < last; ++portal)
    if ((due -= portal->area() * portal->radiance) < 0) break;
  Leaving way;
  const double u = random.uniform(), v = random.uniform();
  // Between the portal and a pane in the opening.
  way.origin = portal->at(u, v) + .5 * portals_.lift() * portal->normal;
  way.direction = sentFrom(portal->normal, random);
  if (most < 1) return way;
  // If a mirror or a highlight throws the light onto a surface in view, a path from the eye reaches the
  // portal after one bounce. Otherwise the path has two bounces: at a surface in view, and at the first
  // surface that the light path will hit. LightVertices omits light that then exceeds the limit.
  std::vector<Radiance> parts;
  outdoors(portal->at(u, v), -way.direction, 1, random, parts);
  double all = 0;
  for (const Radiance& part : parts) all += std::max(0., brightness(part));
  double left = random.uniform() * all;
  for (size_t i = 0; i < parts.size(); ++i) {
    const double bright = std::max(0., brightness(parts[i]));
    if ((left -= bright) >= 0 || !(bright > 0)) continue;
    way.power = Irradiance(parts[i].color * (pathPower_ / portal->radiance * all / bright));
    way.bounces = static_cast<int>(i) + 1;
    break;
  }
  return way;
}

}  // namespace rsphere
