#include "spots/ball_reflection.h"

#include <cmath>

namespace rsphere {
namespace {

// Cap on the steps of the regula falsi, and the error at which it stops, relative to the angle between the
// directions from the center to both places.
constexpr int kSteps = 20;
constexpr double kExact = 1e-4;

}  // namespace

V3d mirroringNormal(const Sphere& ball, const V3d& point, const V3d& to, bool distant) {
  const V3d fromCenter = point - ball.center, a = fromCenter.normalized();
  const V3d b = distant ? to : (to - ball.center).normalized(), across = b - a.dot(b) * a;
  if (!(across.length2() > 1e-20)) return a;
  const V3d side = across.normalized();
  // An angle from a, given by its cosine and sine so that differences of angles need no trigonometric
  // functions.
  struct Turn {
    double cosine, sine;
  };
  const Turn whole{a.dot(b), side.dot(b)};
  const double between = std::atan2(whole.sine, whole.cosine);
  const double away = fromCenter.length() / ball.radius,
               inverse = distant ? 0 : ball.radius / (to - ball.center).length();
  // For a normal at an angle from a: the sine of the difference between the angles of incidence and
  // reflection, times a positive factor. It is zero at the reflecting point.
  const auto excess = [&](const Turn& turn) {
    const double inX = turn.cosine * away - 1, inY = turn.sine * away;
    const double outX = whole.cosine * turn.cosine + whole.sine * turn.sine - inverse,
                 outY = whole.sine * turn.cosine - whole.cosine * turn.sine;
    return inY * outX - inX * outY;
  };
  Turn turn{1, 0};
  double low = 0, high = between, atLow = excess(turn), atHigh = excess(whole);
  int last = 0;
  for (int step = 0; step < kSteps && (step == 0 || high - low > kExact * between); ++step) {
    const double angle =
        atLow < 0 && atHigh > 0 ? (low * atHigh - high * atLow) / (atHigh - atLow) : (low + high) / 2;
    turn = {std::cos(angle), std::sin(angle)};
    const double at = excess(turn);
    if (std::abs(at) <= kExact * kExact * (atHigh - atLow)) break;
    // The Illinois rule: if an end of the interval is kept twice, its value is halved.
    if (at < 0) {
      low = angle;
      atLow = at;
      if (last < 0) atHigh /= 2;
      last = -1;
    } else {
      high = angle;
      atHigh = at;
      if (last > 0) atLow /= 2;
      last = 1;
    }
  }
  return turn.cosine * a + turn.sine * side;
}

}  // namespace rsphere
