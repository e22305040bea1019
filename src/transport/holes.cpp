#include "transport/holes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>

#include "base/constants.h"
#include "scene/material_questions.h"
#include "transport/tuning.h"

namespace rsphere {
namespace {

using Tuning = tuning::Holes;

// The polygons in one plane, whichever way they face.
struct Wall {
  std::vector<const Polygon*> polygons;
  double area = 0;
};

bool isWall(const Material* material) {
  return material && !isTransparent(*material) && !enclosesVolume(*material) && !isLightSource(*material) &&
         !std::holds_alternative<BsdfMaterial>(*material);
}

// The walls of a scene, the largest first, without polygons that are smaller than the holes that count.
std::vector<Wall> wallsOf(const Scene& scene, double leastArea) {
  Box3d bounds;
  for (const V3d& vertex : scene.vertices) bounds.extendBy(vertex);
  if (bounds.isEmpty()) return {};
  const double size = std::max({bounds.size().x, bounds.size().y, bounds.size().z, kSamePlace});
  std::map<std::array<int64_t, 4>, Wall> byPlane;
  for (const Surface& surface : scene.outermost()) {
    const auto* polygon = std::get_if<Polygon>(&surface.shape);
    if (!polygon || !(polygon->area >= leastArea) || !isWall(scene.materialOf(surface))) continue;
    V3d normal = polygon->normal;
    const double first = std::abs(normal.x) > .5 ? normal.x : std::abs(normal.y) > .5 ? normal.y : normal.z;
    if (first < 0) normal = -normal;
    const double offset = normal.dot(scene.vertices[polygon->firstVertex] - bounds.min);
    std::array<int64_t, 4> key{};
    for (int c = 0; c < 3; ++c) key[static_cast<size_t>(c)] = std::llround(normal[c] / Tuning::kSameNormal);
    key[3] = std::llround(offset / (Tuning::kSamePlane * size));
    Wall& wall = byPlane[key];
    wall.polygons.push_back(polygon);
    wall.area += polygon->area;
  }
  std::vector<Wall> walls;
  for (auto& [key, wall] : byPlane) walls.push_back(std::move(wall));
  std::stable_sort(walls.begin(), walls.end(), [](const Wall& a, const Wall& b) { return a.area > b.area; });
  if (walls.size() > Tuning::kMostWalls) walls.resize(Tuning::kMostWalls);
  return walls;
}

std::span<const V3d> cornersOf(const Scene& scene, const Polygon& polygon) {
  return {scene.vertices.data() + polygon.firstVertex, polygon.vertices};
}

// The rectangle around a wall, along the longest edge of its largest polygon.
Rectangle around(const Scene& scene, const Wall& wall) {
  const Polygon& largest = **std::max_element(wall.polygons.begin(), wall.polygons.end(),
                                              [](auto* a, auto* b) { return a->area < b->area; });
  Rectangle r;
  r.normal = largest.normal;
  const std::span<const V3d> corners = cornersOf(scene, largest);
  double longest = 0;
  for (size_t i = 0; i < corners.size(); ++i) {
    const V3d edge = corners[(i + 1) % corners.size()] - corners[i];
    if (edge.length2() <= longest * (1 + 1e-9)) continue;
    longest = edge.length2();
    r.x = edge;
  }
  r.x = (r.x - r.x.dot(r.normal) * r.normal).normalized();
  r.y = r.normal.cross(r.x);
  double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
  for (const Polygon* polygon : wall.polygons)
    for (const V3d& corner : cornersOf(scene, *polygon)) {
      const double at[2] = {(corner - corners[0]).dot(r.x), (corner - corners[0]).dot(r.y)};
      for (int c = 0; c < 2; ++c) {
        low[c] = std::min(low[c], at[c]);
        high[c] = std::max(high[c], at[c]);
      }
    }
  r.corner = corners[0] + low[0] * r.x + low[1] * r.y;
  r.width = high[0] - low[0];
  r.height = high[1] - low[1];
  return r;
}

// Which cells of a grid over a wall have their middle on one of its polygons.
class Coverage {
 public:
  static constexpr int kCells = Tuning::kCells;

  Coverage(const Scene& scene, const Wall& wall, const Rectangle& r) : r_(r) {
    for (const Polygon* polygon : wall.polygons) {
      int low[2] = {kCells, kCells}, high[2] = {-1, -1};
      for (const V3d& corner : cornersOf(scene, *polygon)) {
        const double share[2] = {(corner - r.corner).dot(r.x) / r.width,
                                 (corner - r.corner).dot(r.y) / r.height};
        for (int c = 0; c < 2; ++c) {
          const int cell = std::clamp(static_cast<int>(share[c] * kCells), 0, kCells - 1);
          low[c] = std::min(low[c], cell);
          high[c] = std::max(high[c], cell);
        }
      }
      for (int j = low[1]; j <= high[1]; ++j)
        for (int i = low[0]; i <= high[0]; ++i)
          if (at(i, j) != Cell::wall && inside(*polygon, scene.vertices, middle(i, j), 0))
            at(i, j) = Cell::wall;
    }
  }

  // The rectangles around connected cells that are not covered, of those that fill most of it and that the wall
  // surrounds.
  std::vector<Rectangle> holes() {
    std::vector<Rectangle> found;
    for (int j = 0; j < kCells; ++j)
      for (int i = 0; i < kCells; ++i) {
        if (at(i, j) != Cell::open) continue;
        const Extent e = fill(i, j);
        const int width = e.high[0] - e.low[0] + 1, height = e.high[1] - e.low[1] + 1;
        if (e.cells < Tuning::kFilled * width * height) continue;
        if (e.sides - e.free < Tuning::kSurrounded * e.sides) continue;
        Rectangle hole = r_;
        hole.corner += (r_.width * e.low[0] * r_.x + r_.height * e.low[1] * r_.y) / kCells;
        hole.width = r_.width * width / kCells;
        hole.height = r_.height * height / kCells;
        found.push_back(hole);
      }
    return found;
  }

 private:
  struct Extent {
    int low[2] = {kCells, kCells}, high[2] = {-1, -1}, cells = 0;
    double sides = 0, free = 0;  // length of the outline, and of it where the wall ends (world units)
  };
  enum class Cell : uint8_t { open, wall, counted };

  Cell& at(int i, int j) { return cells_[static_cast<size_t>(j * kCells + i)]; }
  V3d middle(int i, int j) const {
    return r_.corner + (i + .5) / kCells * r_.width * r_.x + (j + .5) / kCells * r_.height * r_.y;
  }

  // Counts the connected cells around one.
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
        if (isBeyond || at(u, v) == Cell::wall) e.sides += side;
        if (isBeyond) e.free += side;
        if (isBeyond || at(u, v) != Cell::open) continue;
        at(u, v) = Cell::counted;
        open.push_back({u, v});
      }
    }
    return e;
  }

  Rectangle r_;
  std::array<Cell, static_cast<size_t>(kCells) * kCells> cells_{};
};

}  // namespace

std::vector<Rectangle> holesOf(const Scene& scene, double leastArea) {
  std::vector<Rectangle> found;
  for (const Wall& wall : wallsOf(scene, leastArea)) {
    const Rectangle r = around(scene, wall);
    if (!(r.width > 0) || !(r.height > 0)) continue;
    for (const Rectangle& hole : Coverage(scene, wall, r).holes())
      if (hole.width * hole.height >= leastArea) found.push_back(hole);
  }
  std::stable_sort(found.begin(), found.end(), [](const Rectangle& a, const Rectangle& b) {
    return a.width * a.height > b.width * b.height;
  });
  return found;
}

}  // namespace rsphere
