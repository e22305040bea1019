#include "layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "rad_parser/error.h"

namespace grid {
namespace {

struct Rectangle {
  V2d right, low,
      high;  // right: unit, along the first side; low and high: along right and the side across it
  double area() const { return (high.x - low.x) * (high.y - low.y); }
};

V2d across(const V2d& d) { return {-d.y, d.x}; }

Rectangle rectangleAround(const Area& area, const V2d& right) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  Rectangle r{right, V2d(kInfinite, kInfinite), V2d(-kInfinite, -kInfinite)};
  for (const Edge& edge : area.edges())
    for (const V2d& p : {edge.from, edge.to}) {
      const V2d q(p.dot(right), p.dot(across(right)));
      r.low = V2d(std::min(r.low.x, q.x), std::min(r.low.y, q.y));
      r.high = V2d(std::max(r.high.x, q.x), std::max(r.high.y, q.y));
    }
  return r;
}

// One side of the smallest rectangle around a polygon is parallel to one of its edges. Of thousands of
// edges, as circles and coast lines have, only the longest are tried.
Rectangle smallestRectangle(const Area& area) {
  constexpr size_t kMost = 1000;
  std::vector<Edge> sides = area.edges();
  if (sides.size() > kMost) {
    const auto length2 = [](const Edge& edge) { return (edge.to - edge.from).length2(); };
    std::ranges::nth_element(sides, sides.begin() + kMost, std::greater<>(), length2);
    sides.resize(kMost);
  }
  Rectangle best = rectangleAround(area, V2d(1, 0));
  for (const Edge& edge : sides) {
    V2d right = (edge.to - edge.from).normalized();
    while (!(right.x > std::abs(right.y) * (1 + 1e-9))) {
      if (std::abs(right.x - std::abs(right.y)) < 1e-9 && right.x > 0 && right.y > 0) break;
      right = across(right);
    }
    const Rectangle candidate = rectangleAround(area, right);
    if (candidate.area() < best.area() * (1 - 1e-9)) best = candidate;
  }
  return best;
}

}  // namespace

double standardSpacing(double length, double width) {
  const double longer = std::max(length, width), shorter = std::min(length, width);
  const double d = longer >= 2 * shorter ? shorter : longer;
  return std::min(10., .2 * std::pow(5, std::log10(d)));
}

Grid layGrid(const Area& area, double spacing, double margin) {
  const Rectangle around = smallestRectangle(area);
  const V2d size = around.high - around.low - V2d(2 * margin, 2 * margin);
  const auto nothing = [&] {
    return rad::Error(fmt::format("no point of the grid is inside the polygon: it measures {:.4g} x {:.4g}{}",
                                  around.high.x - around.low.x, around.high.y - around.low.y,
                                  margin > 0 ? fmt::format(", with a margin of {:.4g} (-m)", margin)
                                             : std::string("; a smaller spacing (-d) may help")));
  };
  if (!(size.x > 0 && size.y > 0)) throw nothing();
  if (!(spacing > 0)) spacing = standardSpacing(size.x, size.y);
  // Coordinates are often rounded: a thousandth of a cell makes no further one.
  const double columns = std::max(1., std::ceil(size.x / spacing - 1e-3));
  const double rows = std::max(1., std::ceil(size.y / spacing - 1e-3));
  if (columns * rows > 1e6)
    throw rad::Error(fmt::format("a spacing of {:.4g} makes {:.0f} x {:.0f} points, more than a million",
                                 spacing, columns, rows));

  Grid grid;
  grid.columns = static_cast<int>(columns);
  grid.rows = static_cast<int>(rows);
  grid.corner = around.right * (around.low.x + margin) + across(around.right) * (around.low.y + margin);
  grid.across = around.right * (size.x / columns);
  grid.upwards = across(around.right) * (size.y / rows);
  const double least = margin + std::min(size.x / columns, size.y / rows) / 2;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const V2d p = grid.at(column + .5, row + .5);
      const bool inside = area.contains(p) && area.distanceToEdge(p) >= least * (1 - 1e-3);
      grid.pointOf.push_back(inside ? static_cast<int>(grid.points.size()) : Grid::kNone);
      if (inside) grid.points.push_back(p);
    }
  if (grid.points.empty()) throw nothing();
  return grid;
}

Grid withOnly(const Grid& grid, const std::vector<bool>& kept) {
  Grid answer = grid;
  answer.points.clear();
  for (int& point : answer.pointOf) {
    if (point == Grid::kNone) continue;
    const V2d p = grid.points[point];
    const bool keep = kept[point];
    point = keep ? static_cast<int>(answer.points.size()) : Grid::kNone;
    if (keep) answer.points.push_back(p);
  }
  return answer;
}

}  // namespace grid
