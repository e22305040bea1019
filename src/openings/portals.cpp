#include "openings/portals.h"

#include <algorithm>

#include "base/constants.h"

namespace rsphere {
Portals::Portals(const Openings& openings, double size, double samePlace)
    : lift_(std::max(1e-6 * size, 8 * samePlace)) {
  double brightest = 0;
  for (const Opening& o : openings.all()) brightest = std::max(brightest, o.radiance);
  for (const Opening& o : openings.all()) {
    const bool isDim = o.radiance < tuning::Portals::kLeastRadiance * brightest;
    if (o.isHole ? o.isIndoors || isDim : o.isIndoors && isDim) continue;
    portals_.push_back(o);
    portals_.back().corner -= lift_ * o.normal;
  }
}

double Portals::leaving(const V3d& origin, const V3d& direction, double farthest) const {
  double nearest = farthest;
  for (const Opening& p : portals_) nearest = std::min(nearest, distanceTo(p, origin, direction, nearest));
  return nearest < farthest ? nearest : kFarAway;
}

PortalDirections::PortalDirections(const Portals& portals, const V3d& point, const V3d& normal)
    : point_(point), normal_(normal) {
  double sum = 0;
  for (const Opening& p : portals.all()) {
    if (!(p.above(point) > 0)) continue;
    // The portal's light at the place is estimated from the mean cosine of the directions to its corners; 0
    // for corners below the horizon.
    double height = 0;
    for (int c = 0; c < 4; ++c) {
      const V3d to = p.at(c & 1, c >> 1) - point;
      height += std::max(0., to.dot(normal)) / (4 * to.length());
    }
    if (!(height > 0)) continue;
    const SphericalRectangle shape(point, p);
    if (!(shape.solidAngle() > 0)) continue;
    sum += height * shape.solidAngle() * p.radiance;
    seen_.push_back({&p, shape, sum});
  }
  for (Seen& s : seen_) s.upTo /= sum;
}

// chosen: the portal that is known to contain the direction, despite rounding.
double PortalDirections::density(const V3d& direction, const Seen& chosen) const {
  double sum = 0, before = 0;
  for (const Seen& s : seen_) {
    const double share = s.upTo - before;
    before = s.upTo;
    if (&s == &chosen || distanceTo(*s.portal, point_, direction) < kFarAway)
      sum += share / s.shape.solidAngle();
  }
  return sum;
}

PortalDirections::Sample PortalDirections::draw(Random& random) const {
  Sample sample;
  const double u = random.uniform(), u1 = random.uniform(), u2 = random.uniform();
  if (seen_.empty()) return sample;
  const auto chosen = std::find_if(seen_.begin(), seen_.end() - 1, [&](const Seen& s) { return u < s.upTo; });
  sample.direction = chosen->shape.sample(u1, u2);
  const double even = normal_.dot(sample.direction) / kPi;
  if (even > 0) sample.share = even / density(sample.direction, *chosen);
  return sample;
}

}  // namespace rsphere
