#include "silhouettes/silhouette.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/frame.h"
#include "base/overloaded.h"
#include "light/spherical_triangle.h"
#include "silhouettes/tuning.h"

namespace rsphere {
namespace {

using std::numbers::pi;

// Rounding error of unit vectors and their products, a few ulp of 1. Directions on the edge of a region are
// inside.
constexpr double kRounding = 1e-15;

// Smallest versine (1 - cos) of the half angle of a convex polygon, 4.5e-7 rad. A narrower polygon is
// replaced by a cap around it, because rounding of its corners exceeds 1e-10 of its width.
constexpr double kTiny = 1e-13;

// Whether a point is so close to a plane that no ray from there hits it: the distance to the hit or the
// cosine would be below kSamePlace, the distance relative to coordinates below 1.
bool liesInPlane(double height, double coordinates) {
  return std::abs(height) <=
         std::max(kSamePlace * kSamePlace * std::min(1., coordinates), 4 * kRounding * coordinates);
}

double largestCoordinate(const V3d& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

// The largest distance by which any corner lies outside any side. In a convex polygon it is a rounding error.
double largestReentrance(const std::vector<V3d>& corners, const std::vector<V3d>& sides) {
  double outside = 0;
  for (const V3d& side : sides)
    for (const V3d& corner : corners) outside = std::max(outside, -side.dot(corner));
  return outside;
}

// Adds the corners of a regular polygon whose sides touch a circle (world) from outside.
void addCircle(std::vector<V3d>& corners, const V3d& center, const V3d& axis, double radius) {
  const auto [x, y] = frame(axis);
  const double around = radius / std::cos(pi / tuning::Silhouettes::kCorners) * (1 + kRounding);
  for (int i = 0; i < tuning::Silhouettes::kCorners; ++i) {
    const double angle = 2 * pi * i / tuning::Silhouettes::kCorners;
    corners.push_back(center + around * (std::cos(angle) * x + std::sin(angle) * y));
  }
}

}  // namespace

double polygonSolidAngle(std::span<const V3d> vertices, const V3d& point) {
  if (vertices.size() < 3) return 0;
  const V3d& first = vertices[0];
  V3d normal(0, 0, 0);
  double sum = 0, coordinates = largestCoordinate(point);
  for (size_t i = 2; i < vertices.size(); ++i) {
    normal += (vertices[i - 1] - first).cross(vertices[i] - first);
    sum += triangleSolidAngle(first, vertices[i - 1], vertices[i], point);
    coordinates = std::max(coordinates, largestCoordinate(vertices[i]));
  }
  const double length = normal.length();
  if (!(length > 0) || liesInPlane(normal.dot(first - point) / length, coordinates)) return 0;
  return std::abs(sum);
}

void Silhouette::setCap(const V3d& axis, double versine) {
  cap_.axis = axis;
  cap_.versine = versine;
  corners_.clear();
  const double chord = std::sqrt(2 * versine) * (1 + kRounding) + kRounding;
  cap_.squaredChord = chord * chord;
  regionSolidAngle_ = 2 * pi * versine;
}

void Silhouette::setBall(const V3d& center, double radius, const V3d& point) {
  const V3d towards = center - point;
  const double distance = towards.length();
  if (distance <= radius) {
    setCap(V3d(0, 0, 1), 2);
  } else {
    const double sine = radius / distance;
    setCap(towards / distance, sine * sine / (1 + std::sqrt(std::max(0., 1 - sine * sine))));
  }
  solidAngle_ = regionSolidAngle_;
}

// Sets the region to a convex polygon with the given corners (world, in order). False if it is too small or
// not convex; only the axis and the versine are valid then.
bool Silhouette::setConvex(std::span<const V3d> corners, const V3d& point) {
  corners_.clear();
  sides_.clear();
  shares_.clear();
  double sum = 0;
  for (size_t i = 2; i < corners.size(); ++i) {
    sum += triangleSolidAngle(corners[0], corners[i - 1], corners[i], point);
    shares_.push_back(std::abs(sum));
  }
  // The normals of the sides point inwards if the corners are counterclockwise as seen from the point.
  const double inward = sum < 0 ? -1 : 1;
  V3d middle(0, 0, 0);
  for (size_t i = 0; i < corners.size(); ++i) {
    const V3d towards = corners[i] - point;
    if (!(towards.length() > 0)) continue;
    corners_.push_back(towards.normalized());
    middle += corners_.back();
    const V3d side = inward * towards.cross(corners[(i + 1) % corners.size()] - corners[i]);
    if (side.length() > 0) sides_.push_back(side.normalized());
  }
  cap_.axis = middle.length() > 0 ? middle.normalized() : V3d(0, 0, 0);
  cap_.versine = 0;
  for (const V3d& corner : corners_)
    cap_.versine = std::max(cap_.versine, (corner - cap_.axis).length2() / 2);
  const double outside = largestReentrance(corners_, sides_);
  // Arcs between nearly opposite corners magnify rounding errors.
  slack_ = outside + 2 * kRounding / std::max(1 - cap_.versine, 1e-7);
  regionSolidAngle_ = std::abs(sum);
  return corners_.size() == corners.size() && cap_.versine > kTiny && outside <= 100 * kRounding &&
         sum != 0 && std::ranges::is_sorted(shares_);
}

void Silhouette::setPolygon(const Polygon& polygon, std::span<const V3d> vertices, const V3d& point) {
  solidAngle_ = polygonSolidAngle(vertices, point);
  if (!(solidAngle_ > 0)) return;
  if (setConvex(vertices, point) && std::abs(regionSolidAngle_ - solidAngle_) <= 1e-9 * solidAngle_) return;
  // A cap around the corners contains the sides only if it is at most a hemisphere. The hemisphere on the
  // other side of the plane always contains the polygon.
  if (cap_.versine > 1) {
    cap_.axis = polygon.normal.dot(point - vertices[0]) > 0 ? -polygon.normal : polygon.normal;
    cap_.versine = 1;
  }
  setCap(cap_.axis, cap_.versine);
}

// Sets the region to the convex hull of points (Andrew's monotone chain, on the plane perpendicular to their
// mean direction). False if they extend beyond kWidestHull.
bool Silhouette::setHull(std::span<const V3d> points, const V3d& point) {
  V3d middle(0, 0, 0);
  for (const V3d& p : points) middle += (p - point).normalized();
  if (!(middle.length() > 0)) return false;
  middle.normalize();
  const auto [x, y] = frame(middle);
  struct Seen {
    double x, y;
    size_t index;
  };
  std::vector<Seen> seen;
  for (size_t i = 0; i < points.size(); ++i) {
    const V3d towards = points[i] - point;
    const double depth = towards.dot(middle);
    if (!(depth > std::cos(tuning::Silhouettes::kWidestHull) * towards.length())) return false;
    seen.push_back({towards.dot(x) / depth, towards.dot(y) / depth, i});
  }
  std::ranges::sort(seen,
                    [](const Seen& a, const Seen& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  const auto turn = [](const Seen& a, const Seen& b, const Seen& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  };
  std::vector<Seen> hull;
  for (const bool back : {false, true}) {
    const size_t begin = hull.size();
    for (size_t i = 0; i < seen.size(); ++i) {
      const Seen& next = seen[back ? seen.size() - 1 - i : i];
      while (hull.size() >= begin + 2 && turn(hull[hull.size() - 2], hull.back(), next) <= 0) hull.pop_back();
      hull.push_back(next);
    }
    hull.pop_back();
  }
  std::vector<V3d> corners;
  for (const Seen& s : hull) corners.push_back(points[s.index]);
  return corners.size() >= 3 && setConvex(corners, point);
}

Silhouette Silhouette::within(const Silhouette& other) const {
  const Silhouette& smaller = regionSolidAngle_ <= other.regionSolidAngle_ ? *this : other;
  if (corners_.empty() || other.corners_.empty()) return smaller;
  // Sutherland and Hodgman's clipping. The corners need not have unit length.
  std::vector<V3d> corners = corners_, kept;
  for (const V3d& side : other.sides_) {
    kept.clear();
    for (size_t i = 0; i < corners.size(); ++i) {
      const V3d& a = corners[i];
      const V3d& b = corners[(i + 1) % corners.size()];
      const double atA = side.dot(a), atB = side.dot(b);
      if (atA >= 0) kept.push_back(a);
      if ((atA > 0 && atB < 0) || (atA < 0 && atB > 0))
        kept.push_back((a * std::abs(atB) + b * std::abs(atA)).normalized());
    }
    corners.swap(kept);
  }
  Silhouette both;
  if (corners.size() < 3) return both;
  if (!both.setConvex(corners, V3d(0, 0, 0))) return smaller;
  both.solidAngle_ = both.regionSolidAngle_;
  return both;
}

bool Silhouette::contains(const V3d& direction) const {
  if (corners_.empty())
    return regionSolidAngle_ > 0 && (direction - cap_.axis).length2() <= cap_.squaredChord;
  return std::ranges::all_of(sides_, [&](const V3d& side) { return side.dot(direction) >= -slack_; });
}

Silhouette::Cap Silhouette::surroundingCap() const {
  const bool polygon = !corners_.empty();
  // A cap around the corners contains the sides only if it is at most a hemisphere.
  if (polygon && cap_.versine > 1) return {cap_.axis, pi};
  const double chord = polygon ? std::sqrt(2 * cap_.versine) : std::sqrt(cap_.squaredChord);
  return {cap_.axis, 2 * std::asin(std::min(1., chord / 2)) + (polygon ? slack_ : 0)};
}

V3d Silhouette::sample(double u1, double u2) const {
  if (corners_.empty()) {
    const double v = u1 * cap_.versine;
    const double sine = std::sqrt(v * (2 - v)), angle = 2 * pi * u2;
    const auto [x, y] = frame(cap_.axis);
    return (sine * (std::cos(angle) * x + std::sin(angle) * y) + (1 - v) * cap_.axis).normalized();
  }
  const double at = u1 * regionSolidAngle_;
  const auto found = std::upper_bound(shares_.begin(), shares_.end() - 1, at);
  const size_t i = static_cast<size_t>(found - shares_.begin());
  const double before = i ? shares_[i - 1] : 0, whole = shares_[i] - before;
  const double within = whole > 0 ? std::clamp((at - before) / whole, 0., 1.) : 0;
  return sampleTriangle(corners_[0], corners_[i + 1], corners_[i + 2], whole, within, u2);
}

Silhouette silhouetteOf(ShapeRef shape, std::span<const V3d> vertices, const V3d& point) {
  Silhouette s;
  const auto ofSphere = [&](const Sphere& sphere) { s.setBall(sphere.center, sphere.radius, point); };
  const auto ofDistant = [&](const Distant& distant) {
    const double sine = std::sin(distant.halfAngle / 2);
    s.setCap(distant.direction, 2 * sine * sine);
    s.solidAngle_ = s.regionSolidAngle_;
  };
  const auto ofCone = [&](const Cone& cone) {
    std::vector<V3d> around;
    addCircle(around, cone.base, cone.axis, cone.radius0);
    addCircle(around, cone.base + cone.length * cone.axis, cone.axis, cone.radius1);
    if (!s.setHull(around, point))
      s.setBall(cone.base + cone.length / 2 * cone.axis,
                std::hypot(cone.length / 2, std::max(cone.radius0, cone.radius1)), point);
    s.solidAngle_ = s.regionSolidAngle_;
  };
  const auto ofRing = [&](const Ring& ring) {
    const double height = ring.normal.dot(point - ring.center);
    if (liesInPlane(height, std::max(largestCoordinate(point), largestCoordinate(ring.center)))) return;
    std::vector<V3d> around;
    addCircle(around, ring.center, ring.normal, ring.outer);
    if (!s.setHull(around, point)) {
      s.setBall(ring.center, ring.outer, point);
      if (s.cap_.versine > 1) s.setCap(height > 0 ? -ring.normal : ring.normal, 1);
    }
    s.solidAngle_ = s.regionSolidAngle_;
  };
  const auto ofPolygon = [&](const Polygon& polygon) {
    const auto around = vertices.subspan(polygon.firstVertex, polygon.vertices);
    if (thicknessOf(polygon, vertices) <= kSamePlace * std::min<double>(1, polygon.extent)) {
      s.setPolygon(polygon, around, point);
    } else {
      // Rays hit the polygon in its mean plane. The vertices are moved into that plane, along the polygon's
      // axis.
      std::vector<V3d> flat(around.begin(), around.end());
      for (V3d& v : flat)
        v[polygon.axis] += (polygon.offset - polygon.normal.dot(v)) / polygon.normal[polygon.axis];
      s.setPolygon(polygon, flat, point);
    }
  };
  const auto ofNested = [](const NestedShape auto&) {};  // represented by balls
  match(shape, ofSphere, ofDistant, ofCone, ofRing, ofPolygon, ofNested);
  return s;
}

Silhouette hullOf(std::span<const V3d> around, const V3d& point) {
  Silhouette s;
  if (!s.setHull(around, point)) return {};
  s.solidAngle_ = s.regionSolidAngle_;
  return s;
}

}  // namespace rsphere
