#include "openings/holes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/keep_largest.h"
#include "openings/tuning.h"

namespace rsphere {
namespace {

// The polygons in one plane, regardless of the side they face, the largest first.
struct Wall {
  std::vector<const Polygon*> polygons;
  double area = 0;
};

// A key that is equal for all polygons in one plane.
using PlaneKey = std::array<int64_t, 4>;

PlaneKey planeOf(const Polygon& polygon, const V3d& fromOrigin, double size) {
  V3d normal = polygon.normal;
  const double first = std::abs(normal.x) > .5 ? normal.x : std::abs(normal.y) > .5 ? normal.y : normal.z;
  if (first < 0) normal = -normal;
  PlaneKey key{};
  for (int c = 0; c < 3; ++c)
    key[static_cast<size_t>(c)] = std::llround(normal[c] / tuning::Holes::kSameNormal);
  key[3] = std::llround(normal.dot(fromOrigin) / (tuning::Holes::kSamePlane * size));
  return key;
}

static_assert(kShapes == 8, "May a new shape be a wall that has holes?");
// The walls of a scene, the largest first.
std::vector<Wall> wallsOf(const Scene& scene, const Box3d& bounds, double leastArea, IsWall isWall) {
  const double size = std::max({bounds.size().x, bounds.size().y, bounds.size().z, scene.samePlace});
  std::vector<std::pair<PlaneKey, const Polygon*>> polygons;
  for (const Surface& surface : scene.outermost())
    if (const auto* polygon = surface.shape.as<Polygon>())
      if (areaOf(*polygon, scene.vertices) >= leastArea && isWall(surface))
        polygons.emplace_back(planeOf(*polygon, scene.vertices[polygon->firstVertex] - bounds.min, size),
                              polygon);
  std::ranges::stable_sort(polygons, {}, [](const auto& p) { return p.first; });
  std::vector<Wall> walls;
  for (size_t i = 0; i < polygons.size(); ++i) {
    if (i == 0 || polygons[i].first != polygons[i - 1].first) walls.emplace_back();
    walls.back().polygons.push_back(polygons[i].second);
    walls.back().area += areaOf(*polygons[i].second, scene.vertices);
  }
  keepLargest(walls, tuning::Holes::kMostWalls, [](const Wall& wall) { return wall.area; });
  for (Wall& wall : walls)
    std::ranges::stable_sort(wall.polygons, std::greater(),
                             [&](const Polygon* p) { return areaOf(*p, scene.vertices); });
  return walls;
}

// Determines which cells of a grid over a wall have their middle on one of its polygons.
class Coverage {
 public:
  static constexpr int kCells = tuning::Holes::kCells;

  Coverage(const Scene& scene, const Wall& wall, const Rectangle& r) : r_(r) {
    for (const Polygon* polygon : wall.polygons) {
      int low[2] = {kCells, kCells}, high[2] = {-1, -1};
      for (const V3d& corner : cornersOf(scene, *polygon)) {
        const double share[2] = {(corner - r.corner).dot(r.x) / r.width,
                                 (corner - r.corner).dot(r.y) / r.height};
        for (int c = 0; c < 2; ++c) {
          const int cell = std::clamp(static_cast<int>(share[c] * kCells), 0, kCells - 1);
          corners_[c].push_back(share[c]);
          low[c] = std::min(low[c], cell);
          high[c] = std::max(high[c], cell);
        }
      }
      for (int j = low[1]; j <= high[1]; ++j)
        for (int i = low[0]; i <= high[0]; ++i)
          if (at(i, j) != Cell::wall && inside(*polygon, scene.vertices, middle(i, j), 0))
            at(i, j) = Cell::wall;
    }
    for (std::vector<double>& shares : corners_) std::ranges::sort(shares);
  }

  // Finds connected regions of uncovered cells. Returns the bounding rectangle of each that fills most of the
  // rectangle and is surrounded by the wall. Can be called only once.
  std::vector<Rectangle> holes() {
    std::vector<Rectangle> found;
    for (int j = 0; j < kCells; ++j)
      for (int i = 0; i < kCells; ++i) {
        if (at(i, j) != Cell::open) continue;
        const Extent e = fill(i, j);
        const int width = e.high[0] - e.low[0] + 1, height = e.high[1] - e.low[1] + 1;
        if (e.cells < tuning::Openings::kFilled * width * height) continue;
        if (e.outline - e.free < tuning::Holes::kSurrounded * e.outline) continue;
        const double left = edgeAt(0, e.low[0]), right = edgeAt(0, e.high[0] + 1);
        const double bottom = edgeAt(1, e.low[1]), top = edgeAt(1, e.high[1] + 1);
        if (!(left < right) || !(bottom < top)) continue;
        Rectangle hole = r_;
        hole.corner = r_.at(left, bottom);
        hole.width = r_.width * (right - left);
        hole.height = r_.height * (top - bottom);
        found.push_back(hole);
      }
    return found;
  }

 private:
  struct Extent {
    int low[2] = {kCells, kCells}, high[2] = {-1, -1}, cells = 0;
    // Lengths of the outline, and of its part at the edge of the wall (world units).
    double outline = 0, free = 0;
  };
  enum class Cell : uint8_t { open, wall, counted };

  Cell& at(int i, int j) { return cells_[static_cast<size_t>(j * kCells + i)]; }
  V3d middle(int i, int j) const { return r_.at((i + .5) / kCells, (j + .5) / kCells); }

  // The edge of a hole between two cells, as a fraction of the wall's width (axis 0) or height (1). It is
  // moved to the nearest corner of a polygon, so that holes are as exact as the polygons.
  double edgeAt(size_t axis, int cell) const {
    const double rough = static_cast<double>(cell) / kCells;
    const std::vector<double>& corners = corners_[axis];
    const auto above = std::ranges::lower_bound(corners, rough);
    double nearest = rough, distance = 1. / kCells;
    const auto consider = [&](double corner) {
      if (std::abs(corner - rough) >= distance) return;
      nearest = corner;
      distance = std::abs(corner - rough);
    };
    if (above != corners.begin()) consider(*(above - 1));
    if (above != corners.end()) consider(*above);
    return nearest;
  }

  // Finds all uncovered cells that are connected to a cell, and marks them as counted.
  Extent fill(int i, int j) {
    Extent e;
    std::vector<std::array<int, 2>> open{{i, j}};
    at(i, j) = Cell::counted;
    while (!open.empty()) {
      const auto cell = open.back();
      open.pop_back();
      ++e.cells;
      for (size_t c = 0; c < 2; ++c) {
        e.low[c] = std::min(e.low[c], cell[c]);
        e.high[c] = std::max(e.high[c], cell[c]);
      }
      for (const auto& step : {std::array{1, 0}, std::array{-1, 0}, std::array{0, 1}, std::array{0, -1}}) {
        const int u = cell[0] + step[0], v = cell[1] + step[1];
        const double side = (step[0] ? r_.height : r_.width) / kCells;
        const bool isBeyond = u < 0 || v < 0 || u >= kCells || v >= kCells;
        if (isBeyond || at(u, v) == Cell::wall) e.outline += side;
        if (isBeyond) e.free += side;
        if (isBeyond || at(u, v) != Cell::open) continue;
        at(u, v) = Cell::counted;
        open.push_back({u, v});
      }
    }
    return e;
  }

  Rectangle r_;
  // The corners of the polygons, as fractions of the wall's width and of its height, each sorted.
  std::array<std::vector<double>, 2> corners_;
  std::array<Cell, static_cast<size_t>(kCells) * kCells> cells_{};
};

}  // namespace

std::vector<Rectangle> holesOf(const Scene& scene, const Box3d& bounds, double leastArea, IsWall isWall) {
  std::vector<Rectangle> found;
  for (const Wall& wall : wallsOf(scene, bounds, leastArea, isWall)) {
    const Rectangle r = rectangleAround(scene, wall.polygons);
    if (!(r.area() > 0)) continue;
    for (const Rectangle& hole : Coverage(scene, wall, r).holes())
      if (hole.area() >= leastArea) found.push_back(hole);
  }
  std::ranges::stable_sort(found, [](const Rectangle& a, const Rectangle& b) { return a.area() > b.area(); });
  return found;
}

}  // namespace rsphere
