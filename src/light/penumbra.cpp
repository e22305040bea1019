#include "light/penumbra.h"

#include <algorithm>
#include <cmath>

namespace rsphere {
namespace {

constexpr double kHeightRounding =
    1e-12;                        // tolerance for heights, relative to the largest coordinate; 1e4 epsilon
constexpr double kMargin = 1e-7;  // relative to the largest coordinate: see penumbra.h
constexpr double kFlat = 1e-6;    // if the sine between an edge and a corner is smaller, they define no plane

double largest(const V3d& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

double largest(std::span<const V3d> points) {
  double most = 0;
  for (const V3d& p : points) most = std::max(most, largest(p));
  return most;
}

// 1 if all points lie on the inner side of the plane or on it, -1 if all lie on the outer side, 0 otherwise.
int sideOf(std::span<const V3d> points, const HalfSpace& plane, double rounding) {
  bool inside = true, outside = true;
  for (const V3d& p : points) {
    const double height = plane.height(p);
    inside &= height >= -rounding;
    outside &= height <= rounding;
    if (!inside && !outside) return 0;
  }
  return inside ? 1 : -1;
}

// Appends the half spaces bounded by planes through an edge of `edges` and a corner of `corners`.
// sideOfOpening(plane): 1 or -1 if the opening lies on the plane's inner or outer side and the source on the
// other side; 0 if the plane does not separate them.
template <class SideOfOpening>
void addPlanes(std::span<const V3d> edges, std::span<const V3d> corners, const SideOfOpening& sideOfOpening,
               std::vector<HalfSpace>& bounds) {
  for (size_t i = 0; i < edges.size(); ++i) {
    const V3d& start = edges[i];
    const V3d edge = edges[i + 1 < edges.size() ? i + 1 : 0] - start;
    for (const V3d& corner : corners) {
      const V3d across = corner - start;
      V3d normal = edge.cross(across);
      const double length = normal.length();
      if (!(length > kFlat * edge.length() * across.length())) continue;
      normal /= length;
      const HalfSpace plane{normal, normal.dot(start)};
      if (const int side = sideOfOpening(plane); side > 0)
        bounds.push_back(plane);
      else if (side < 0)
        bounds.push_back({-normal, -plane.offset});
    }
  }
}

double marginOf(double coordinate, const HalfSpace& bound) {
  return kMargin * std::max(coordinate, std::abs(bound.offset));
}

}  // namespace

void addPenumbra(std::span<const V3d> from, std::span<const V3d> opening, std::vector<HalfSpace>& bounds) {
  const double rounding = kHeightRounding * std::max(largest(from), largest(opening));
  const auto sideOfOpening = [&](const HalfSpace& plane) {
    const int side = sideOf(opening, plane, rounding);
    return side != 0 && sideOf(from, {-plane.inward, -plane.offset}, rounding) == side ? side : 0;
  };
  addPlanes(from, opening, sideOfOpening, bounds);
  addPlanes(opening, from, sideOfOpening, bounds);
}

std::vector<V3d> clipped(std::vector<V3d> corners, std::span<const HalfSpace> bounds) {
  std::vector<V3d> part;
  for (const HalfSpace& bound : bounds) {
    const double margin = marginOf(largest(corners), bound);
    part.clear();
    for (size_t i = 0; i < corners.size(); ++i) {
      const V3d &at = corners[i], &next = corners[i + 1 < corners.size() ? i + 1 : 0];
      const double here = bound.height(at) + margin, there = bound.height(next) + margin;
      if (here >= 0) part.push_back(at);
      if ((here >= 0) != (there >= 0)) part.push_back(at + here / (here - there) * (next - at));
    }
    corners.swap(part);
  }
  return corners;
}

bool isOutside(const Box3d& box, const HalfSpace& bound) {
  const V3d middle = box.center(), half = box.size() / 2;
  const V3d span(std::abs(bound.inward.x), std::abs(bound.inward.y), std::abs(bound.inward.z));
  return bound.height(middle) + half.dot(span) < -marginOf(largest(middle) + largest(half), bound);
}

}  // namespace rsphere
