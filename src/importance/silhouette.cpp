#include "importance/silhouette.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shade/scattering.h"

namespace rsphere {
namespace {

constexpr double kPi = std::numbers::pi;

// Below this (sr) the angles of a spherical triangle differ from a plane one's by less than their rounding
// matters in Arvo's formulas (the excess has lost half its digits); a cap around the polygon serves instead.
constexpr double kTinyPolygon = 1e-7;

// Signed solid angle of the triangle of three unit vectors.
double triangleSolidAngle(const V3d& a, const V3d& b, const V3d& c) {
  return 2 * std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
}

bool isConvex(const std::vector<V3d>& corners, const std::vector<V3d>& sides) {
  for (const V3d& side : sides)
    for (const V3d& corner : corners)
      if (side.dot(corner) < -1e-14) return false;
  return true;
}

// Arvo's map from the square to the spherical triangle.
V3d sampleTriangle(const V3d& a, const V3d& b, const V3d& c, double u1, double u2) {
  const V3d nab = a.cross(b).normalized(), nbc = b.cross(c).normalized(), nca = c.cross(a).normalized();
  const double alpha = std::acos(std::clamp(-nab.dot(nca), -1., 1.));
  const double beta = std::acos(std::clamp(-nbc.dot(nab), -1., 1.));
  const double gamma = std::acos(std::clamp(-nca.dot(nbc), -1., 1.));
  const double cosC = a.dot(b);
  const double part = u1 * (alpha + beta + gamma - kPi);
  const double s = std::sin(part - alpha), t = std::cos(part - alpha);
  const double u = t - std::cos(alpha), v = s + std::sin(alpha) * cosC;
  const double below = (v * s + u * t) * std::sin(alpha);
  const double q = below == 0 ? 1 : std::clamp(((v * t - u * s) * std::cos(alpha) - v) / below, -1., 1.);
  const V3d across = c - c.dot(a) * a;
  const V3d cHat = (q * a + std::sqrt(1 - q * q) * across.normalized()).normalized();
  const double z = 1 - u2 * (1 - cHat.dot(b));
  const V3d along = cHat - cHat.dot(b) * b;
  const double length = along.length();
  if (!(length > 0)) return b;
  return (z * b + std::sqrt(std::max(0., 1 - z * z)) / length * along).normalized();
}

// A ball around a shape.
struct Ball {
  V3d center{0, 0, 0};
  double radius = 0;
};
Ball ballAround(const Cone& cone) {
  return {cone.base + cone.length / 2 * cone.axis,
          std::hypot(cone.length / 2, std::max(cone.radius0, cone.radius1))};
}
Ball ballAround(const Ring& ring) { return {ring.center, ring.outer}; }
Ball ballAround(const Sphere& sphere) { return {sphere.center, sphere.radius}; }

}  // namespace

double polygonSolidAngle(std::span<const V3d> vertices, const V3d& point) {
  if (vertices.size() < 3) return 0;
  const auto towards = [&](size_t i) {
    const V3d d = vertices[i] - point;
    const double length = d.length();
    return length > 0 ? d / length : V3d(0, 0, 0);
  };
  const V3d first = towards(0);
  double sum = 0;
  V3d from = towards(1);
  for (size_t i = 2; i < vertices.size(); ++i) {
    const V3d to = towards(i);
    sum += triangleSolidAngle(first, from, to);
    from = to;
  }
  // Around a reentrant corner the sum may run once round the sphere more than it should.
  sum = std::abs(sum);
  return sum > 2 * kPi ? std::abs(4 * kPi - sum) : sum;
}

void Silhouette::setCap(const V3d& axis, double sine) {
  axis_ = axis;
  versine_ = sine * sine / (1 + std::sqrt(std::max(0., 1 - sine * sine)));
  regionSolidAngle_ = 2 * kPi * versine_;
}

bool Silhouette::contains(const V3d& direction) const {
  if (corners_.empty()) {
    // |d - axis|^2 / 2 is 1 - cos without its cancellation.
    return regionSolidAngle_ > 0 && (direction - axis_).length2() / 2 <= versine_;
  }
  return std::all_of(sides_.begin(), sides_.end(), [&](const V3d& side) { return side.dot(direction) >= 0; });
}

V3d Silhouette::sample(double u1, double u2) const {
  if (corners_.empty()) {
    const double v = u1 * versine_;
    const double sine = std::sqrt(v * (2 - v)), angle = 2 * kPi * u2;
    V3d x, y;
    frame(axis_, x, y);
    return (sine * (std::cos(angle) * x + std::sin(angle) * y) + (1 - v) * axis_).normalized();
  }
  const double at = u1 * regionSolidAngle_;
  const auto found = std::upper_bound(shares_.begin(), shares_.end() - 1, at);
  const size_t i = static_cast<size_t>(found - shares_.begin());
  const double before = i ? shares_[i - 1] : 0;
  const double within = shares_[i] > before ? (at - before) / (shares_[i] - before) : 0;
  return sampleTriangle(corners_[0], corners_[i + 1], corners_[i + 2], std::clamp(within, 0., 1.), u2);
}

Silhouette silhouetteOf(const Shape& shape, std::span<const V3d> vertices, const V3d& point) {
  Silhouette s;
  const auto useBall = [&](const Ball& ball) {
    const V3d towards = ball.center - point;
    const double distance = towards.length();
    if (distance <= ball.radius) {
      s.versine_ = 2;
      s.regionSolidAngle_ = 4 * kPi;
    } else {
      s.setCap(towards / distance, ball.radius / distance);
    }
    s.solidAngle_ = s.regionSolidAngle_;
  };
  const auto usePolygon = [&](const Polygon& polygon) {
    const auto around = vertices.subspan(polygon.firstVertex, polygon.vertices);
    s.solidAngle_ = polygonSolidAngle(around, point);
    if (!(s.solidAngle_ > 0)) return;
    s.corners_.reserve(around.size());
    V3d middle(0, 0, 0);
    for (const V3d& v : around) {
      const V3d d = v - point;
      if (!(d.length() > 0)) continue;
      s.corners_.push_back(d.normalized());
      middle += s.corners_.back();
    }
    if (polygon.normal.dot(point) < polygon.offset) std::reverse(s.corners_.begin(), s.corners_.end());
    // Seen from the front the vertices run counterclockwise around the ray; sides' normals then point
    // inwards.
    for (size_t i = 0; i < s.corners_.size(); ++i)
      s.sides_.push_back(s.corners_[(i + 1) % s.corners_.size()].cross(s.corners_[i]));
    if (s.solidAngle_ > kTinyPolygon && isConvex(s.corners_, s.sides_)) {
      double sum = 0;
      for (size_t i = 2; i < s.corners_.size(); ++i) {
        sum += std::abs(triangleSolidAngle(s.corners_[0], s.corners_[i - 1], s.corners_[i]));
        s.shares_.push_back(sum);
      }
      s.regionSolidAngle_ = sum;
      if (std::abs(sum - s.solidAngle_) <= 1e-9 * sum) return;
    }
    // A cap around the corners.
    const V3d axis = middle.length() > 0 ? middle.normalized() : -polygon.normal;
    double versine = 0;
    for (const V3d& c : s.corners_) versine = std::max(versine, (c - axis).length2() / 2);
    s.corners_.clear();
    s.axis_ = axis;
    // A cap that holds the corners holds the sides too only if it is at most a hemisphere.
    s.versine_ = versine <= 1 ? std::min(2., versine * (1 + 1e-12)) : 2;
    s.regionSolidAngle_ = 2 * kPi * s.versine_;
  };
  std::visit(
      [&](const auto& form) {
        using S = std::decay_t<decltype(form)>;
        if constexpr (std::is_same_v<S, Polygon>)
          usePolygon(form);
        else if constexpr (!std::is_same_v<S, Distant>)
          useBall(ballAround(form));
      },
      shape);
  return s;
}

}  // namespace rsphere
