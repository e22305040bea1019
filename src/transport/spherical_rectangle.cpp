#include "transport/spherical_rectangle.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"

namespace rsphere {
namespace {

// Smaller solid angles (sr) suffer from rounding.
constexpr double kSmallest = 1e-7;

double angleBetween(const V3d& a, const V3d& b) { return std::acos(std::clamp(a.dot(b), -1., 1.)); }

}  // namespace

SphericalRectangle::SphericalRectangle(const V3d& point, const Rectangle& r)
    : x_(r.x), y_(r.y), z_(r.normal) {
  const V3d to = r.corner - point;
  z0_ = to.dot(z_);
  if (z0_ > 0) {
    z_ = -z_;
    z0_ = -z0_;
  }
  x0_ = to.dot(x_);
  y0_ = to.dot(y_);
  x1_ = x0_ + r.width;
  y1_ = y0_ + r.height;
  if (!(z0_ < 0)) return;
  // Normals of the planes through the point and a side.
  const V3d n0 = V3d(0, z0_, -y0_).normalized(), n1 = V3d(-z0_, 0, x1_).normalized(),
            n2 = V3d(0, -z0_, y1_).normalized(), n3 = V3d(z0_, 0, -x0_).normalized();
  const double g0 = angleBetween(-n0, n1), g1 = angleBetween(-n1, n2), g2 = angleBetween(-n2, n3),
               g3 = angleBetween(-n3, n0);
  b0_ = n0.z;
  b1_ = n2.z;
  turned_ = 2 * kPi - g2 - g3;
  const double solidAngle = g0 + g1 - turned_;
  if (solidAngle > kSmallest) solidAngle_ = solidAngle;
}

V3d SphericalRectangle::sample(double u, double v) const {
  const double along = u * solidAngle_ + turned_;
  const double f = (std::cos(along) * b0_ - b1_) / std::sin(along);
  const double c = std::clamp(std::copysign(1, f) / std::sqrt(f * f + b0_ * b0_), -1., 1.);
  const double x = std::clamp(-c * z0_ / std::sqrt(std::max(1 - c * c, 1e-300)), x0_, x1_);
  const double d2 = x * x + z0_ * z0_;
  const double h0 = y0_ / std::sqrt(d2 + y0_ * y0_), h1 = y1_ / std::sqrt(d2 + y1_ * y1_);
  const double h = h0 + v * (h1 - h0);
  const double y = h * h < 1 ? std::clamp(h * std::sqrt(d2 / (1 - h * h)), y0_, y1_) : y1_;
  return (x * x_ + y * y_ + z0_ * z_).normalized();
}

}  // namespace rsphere
