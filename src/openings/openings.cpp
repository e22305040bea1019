#include "openings/openings.h"

#include <algorithm>

namespace rsphere {

double areaTowards(std::span<const Opening> openings, const V3d& direction) {
  double sum = 0;
  for (const Opening& o : openings) sum += std::max(0., direction.dot(o.normal)) * o.area();
  return sum;
}

V3d pointTowards(std::span<const Opening> openings, const V3d& direction, double u1, double u2, double u3) {
  double due = u1 * areaTowards(openings, direction);
  const Opening* chosen = nullptr;
  for (const Opening& o : openings) {
    const double area = std::max(0., direction.dot(o.normal)) * o.area();
    if (area > 0) chosen = &o;
    if (due < area) break;
    due -= area;
  }
  return chosen->at(u2, u3);
}

void Openings::aim(const AimFrom& from, Aim& aim) const {
  aimAtFirst(places_.size(), from, aim, [](const Opening&, const V3d&) { return true; });
}

}  // namespace rsphere
