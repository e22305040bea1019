#include "importance/moments.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "base/colorimetry.h"

namespace rsphere {

void Moments::add(const V3d& d, const Irradiance& part, const SpectralSampling* sampling) {
  total += part;
  cylindrical.color.addScaled(part.color, std::sqrt(std::max(0., 1 - d.z * d.z)));
  for (int axis = 0; axis < 3; ++axis)
    facing[2 * axis + (d[axis] < 0)].color.addScaled(part.color, std::abs(d[axis]));
  light += photopicOf(part.color, sampling) * d;
}

void Moments::add(const Moments& other, double share) {
  total += other.total * share;
  cylindrical += other.cylindrical * share;
  for (int i = 0; i < 6; ++i) facing[i] += other.facing[i] * share;
  light += other.light * share;
}

PointAnswer Moments::answer(const V3d& point, size_t directions) const {
  using std::numbers::pi;
  PointAnswer a;
  a.point = point;
  a.directions = directions;
  a.mean = meanRadiance(total, 4 * pi);
  a.scalarIrradiance = total / 4.;
  a.cylindricalIrradiance = cylindrical / pi;
  std::copy(std::begin(facing), std::end(facing), std::begin(a.facing));
  a.lightVector = light;
  return a;
}

}  // namespace rsphere
