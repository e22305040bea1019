#include "light/beam.h"

#include <algorithm>
#include <cmath>

namespace rsphere {
namespace {

constexpr double kSlack = 1e-6;     // radians; far larger than the rounding errors of the angles
constexpr double kParallel = 1e-9;  // squared sine of the angle below which two axes are treated as equal

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
  // A vector between two points of the balls differs from the vector between their centers by at most the
  // sum of the radii. A vector to a point behind the opening is a sum of such vectors.
  const V3d towards = opening.center - from.center;
  const double distance = towards.length(), sine = (opening.radius + from.radius) / distance;
  if (!(distance > 0) || !(sine < 1)) return {};
  return {towards / distance, std::sqrt(1 - sine * sine)};
}

Beam sharedBeam(const Beam& a, const Beam& b) {
  const double between = a.axis.dot(b.axis), sine2 = 1 - between * between;
  const Beam& narrower = a.cosine > b.cosine ? a : b;
  if (!(sine2 > kParallel)) return narrower;
  // The vector `middle` = s a + t b is the one whose products with the axes a and b are the cosines of the
  // beams. Its length is the cosine of the shared beam around it. Proof, if s and t are at least 0: each
  // direction d in both beams has d . middle = s (d . a) + t (d . b) >= middle . middle.
  const double s = (a.cosine - b.cosine * between) / sine2;
  const double t = (b.cosine - a.cosine * between) / sine2;
  if (s <= 0 || t <= 0) return narrower;  // more than half of the narrower beam lies in the other
  const V3d middle = s * a.axis + t * b.axis;
  const double cosine = middle.length();
  return {middle / cosine, cosine};
}

}  // namespace rsphere
