#include "points/moments.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "base/colorimetry.h"
#include "points/tuning.h"

namespace rsphere {
namespace {

// sr, smaller than any bin. Avoids a division by 0 for bins without directions.
constexpr double kLeastSolidAngle = 1e-12;

}  // namespace

void Moments::add(const V3d& d, const Irradiance& part, const SpectralSampling* sampling, double cell,
                  bool isEven) {
  if (zones) [[unlikely]]
    zones->divide(d, cell, [&](size_t zone, double share) {
      ofZones[zone].color.addScaled(part.color, share);
      if (share < 1)
        borders[zone].addScaled(part.color * part.color,
                                share * (1 - share) * (isEven ? tuning::Moments::kBorder : 1));
    });
  total += part;
  cylindrical.color.addScaled(part.color, std::sqrt(std::max(0., 1 - d.z * d.z)));
  for (int axis = 0; axis < 3; ++axis)
    facing[2 * axis + (d[axis] < 0)].color.addScaled(part.color, std::abs(d[axis]));
  light += photopicOf(part.color, sampling) * d;
  if (gaze) atEye.color.addScaled(part.color, std::max(0., d.dot(*gaze)));
}

void Moments::add(const Moments& other, double share) {
  total += other.total * share;
  cylindrical += other.cylindrical * share;
  for (int i = 0; i < 6; ++i) facing[i] += other.facing[i] * share;
  light += other.light * share;
  atEye += other.atEye * share;
  for (size_t i = 0; i < other.ofZones.size(); ++i) {
    ofZones[i] += other.ofZones[i] * share;
    borders[i].addScaled(other.borders[i], share * share);
  }
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
  for (size_t i = 0; i < ofZones.size(); ++i)
    a.zones.push_back(meanRadiance(ofZones[i], std::max(zones->solidAngle(i), kLeastSolidAngle)));
  return a;
}

}  // namespace rsphere
