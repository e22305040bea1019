#include "light/beam.h"

#include <algorithm>
#include <cmath>

namespace rsphere {
namespace {

constexpr double kSlack = 1e-6;     // radians: far more than the rounding of angles
constexpr double kParallel = 1e-9;  // sine squared between axes, below which they are taken for one

}  // namespace

bool Beam::meets(const V3d& apex, const Ball& ball) const {
  const V3d towards = ball.center - apex;
  const double distance = towards.length();
  if (cosine <= -1 || distance <= ball.radius) return true;
  if (cosine > 1 + kSlack) return false;
  const double angle = std::acos(std::clamp(towards.dot(axis) / distance, -1., 1.));
  return angle <= std::acos(std::min(cosine, 1.)) + std::asin(ball.radius / distance) + kSlack;
}

Beam beamThrough(const Ball& from, const Ball& opening) {
  // The direction of a ray from the one to the other differs from that between their centers by no more than
  // both radii; from the opening on, the point on the ray is a sum of such directions.
  const V3d towards = opening.center - from.center;
  const double distance = towards.length(), sine = (opening.radius + from.radius) / distance;
  if (!(distance > 0) || !(sine < 1)) return {};
  return {towards / distance, std::sqrt(1 - sine * sine)};
}

Beam sharedBeam(const Beam& a, const Beam& b) {
  const double between = a.axis.dot(b.axis), sine2 = 1 - between * between;
  const Beam& narrower = a.cosine > b.cosine ? a : b;
  if (!(sine2 > kParallel)) return narrower;
  // middle: halfway between the two directions in which the beams' surfaces cross, in the plane of the axes.
  // Its products with the axes are the cosines. If it is s a + t b with s and t of at least 0, then every
  // direction d in both beams has d . middle = s (d . a) + t (d . b) >= middle . middle.
  const double s = (a.cosine - b.cosine * between) / sine2;
  const double t = (b.cosine - a.cosine * between) / sine2;
  if (s <= 0 || t <= 0) return narrower;  // which has more than its half in the other
  const V3d middle = s * a.axis + t * b.axis;
  const double cosine = middle.length();
  return {middle / cosine, cosine};
}

}  // namespace rsphere
