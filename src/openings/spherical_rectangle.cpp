#include "openings/spherical_rectangle.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"

namespace rsphere {
namespace {

// Smaller solid angles (sr) suffer from rounding.
constexpr double kSmallest = 1e-7;

double angleBetween(const V3d& a, const V3d& b) { return std::acos(std::clamp(a.dot(b), -1., 1.)); }

}  // namespace

SphericalRectangle::SphericalRectangle(const V3d& point, const Rectangle& r) : frame_{r.x, r.y, r.normal} {
  const V3d to = r.corner - point;
  double z0 = to.dot(r.normal);
  if (z0 > 0) {
    frame_.z = -frame_.z;
    z0 = -z0;
  }
  const double x0 = to.dot(r.x), y0 = to.dot(r.y), x1 = x0 + r.width, y1 = y0 + r.height;
  sides_ = {x0, y0, x1, y1, z0};
  if (!(z0 < 0)) return;
  // Normals of the planes through the point and a side.
  const V3d n0 = V3d(0, z0, -y0).normalized(), n1 = V3d(-z0, 0, x1).normalized(),
            n2 = V3d(0, -z0, y1).normalized(), n3 = V3d(z0, 0, -x0).normalized();
  const double g0 = angleBetween(-n0, n1), g1 = angleBetween(-n1, n2), g2 = angleBetween(-n2, n3),
               g3 = angleBetween(-n3, n0);
  b0_ = n0.z;
  b1_ = n2.z;
  turned_ = 2 * kPi - g2 - g3;
  const double solidAngle = g0 + g1 - turned_;
  if (solidAngle > kSmallest) solidAngle_ = solidAngle;
}

V3d SphericalRectangle::sample(double u, double v) const {
  const auto& [x0, y0, x1, y1, z0] = sides_;
  const double along = u * solidAngle_ + turned_;
  const double f = (std::cos(along) * b0_ - b1_) / std::sin(along);
  const double c = std::clamp(std::copysign(1, f) / std::sqrt(f * f + b0_ * b0_), -1., 1.);
  const double x = std::clamp(-c * z0 / std::sqrt(std::max(1 - c * c, 1e-300)), x0, x1);
  const double d2 = x * x + z0 * z0;
  const double h0 = y0 / std::sqrt(d2 + y0 * y0), h1 = y1 / std::sqrt(d2 + y1 * y1);
  const double h = h0 + v * (h1 - h0);
  const double y = h * h < 1 ? std::clamp(h * std::sqrt(d2 / (1 - h * h)), y0, y1) : y1;
  return (x * frame_.x + y * frame_.y + z0 * frame_.z).normalized();
}

}  // namespace rsphere
