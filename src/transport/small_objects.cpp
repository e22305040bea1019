#include "transport/small_objects.h"

#include <algorithm>
#include <cmath>

#include "scene/random.h"

namespace rsphere {
namespace {

// Cells are no wider than a tenth of the scene (irradiance_field.cpp): an eighth is the first level that
// matters.
constexpr int kCoarsest = 3;

// Surfaces that are told apart; an instance beyond these is one object.
constexpr size_t kMostSurfaces = 2000000;

// Normals whose cosine is further from 1 are of different planes.
constexpr double kSameNormal = 1e-9;

// An object as large as a cube is not smaller than it, whatever rounding does.
constexpr double kRounding = 1 + 1e-6;

}  // namespace

bool SmallObjects::Content::liesIn(const V3d& planeNormal, double planeOffset, double lift) const {
  if (!onePlane) return false;
  const double cosine = normal.dot(planeNormal);
  return std::abs(cosine) > 1 - kSameNormal &&
         std::abs(offset - std::copysign(planeOffset, planeOffset * cosine)) <= 3 * lift;
}

void SmallObjects::Content::add(const Content& other, double lift) {
  onePlane = onePlane && other.onePlane && liesIn(other.normal, other.offset, lift);
}

size_t SmallObjects::CubeHash::operator()(const Cube& cube) const {
  const uint64_t h = mixBits(static_cast<uint64_t>(cube.i));
  return mixBits(mixBits(h ^ static_cast<uint64_t>(cube.j)) ^ static_cast<uint64_t>(cube.k));
}

SmallObjects::SmallObjects(const Scene& scene, const Tracer& tracer, const CellGrid& grid, double finest)
    : grid_(grid),
      finest_(std::max(grid.levelOf(finest), kCoarsest)),
      cubes_(static_cast<size_t>(finest_ - kCoarsest + 1)) {
  size_t left = kMostSurfaces;
  if (!scene.groups.empty()) addGroup(scene, tracer, 0, nullptr, left);
  // What is in a cube is in the cube around it.
  for (int level = finest_; level > kCoarsest; --level)
    for (const auto& [cube, content] : cubes_[static_cast<size_t>(level - kCoarsest)])
      cubes_[static_cast<size_t>(level - 1 - kCoarsest)]
          .try_emplace({cube.i >> 1, cube.j >> 1, cube.k >> 1}, content)
          .first->second.add(content, grid_.lift);
}

void SmallObjects::addGroup(const Scene& scene, const Tracer& tracer, size_t group,
                            const Placement* placement, size_t& left) {
  const SurfaceGroup& all = scene.groups[group];
  left -= std::min<size_t>(left, all.surfaces);
  for (uint32_t s = all.firstSurface; s < all.firstSurface + all.surfaces; ++s) {
    const Shape& shape = scene.surfaces[s].shape;
    if (const auto* instance = std::get_if<Instance>(&shape)) {
      const Placement& inner = scene.placements[instance->placement];
      const Placement whole = placement ? within(*placement, inner) : inner;
      if (scene.groups[instance->group].surfaces <= left) {
        addGroup(scene, tracer, instance->group, &whole, left);
        continue;
      }
    }
    const Box3d inner = tracer.boundsOf(scene.surfaces[s]);
    if (inner.isEmpty()) continue;
    const Box3d box = placement ? placed(*placement, inner) : inner;
    Content content;
    const V3d* const normal = planeNormal(shape);
    content.onePlane = normal != nullptr;
    if (normal) {
      content.normal = placement ? placement->directionToOuter(*normal).normalized() : *normal;
      content.offset = content.normal.dot(box.center());
    }
    add(box, content);
  }
}

SmallObjects::Cube SmallObjects::cubeOf(const V3d& point, int level) const {
  const V3d at = (point - grid_.origin) / grid_.side(level);
  return {static_cast<int64_t>(std::floor(at.x)), static_cast<int64_t>(std::floor(at.y)),
          static_cast<int64_t>(std::floor(at.z))};
}

void SmallObjects::add(const Box3d& box, const Content& content) {
  const V3d extent = box.size();
  int level = std::min(grid_.levelOf(std::max({extent.x, extent.y, extent.z})), finest_);
  while (level >= kCoarsest && grid_.side(level) < kRounding * std::max({extent.x, extent.y, extent.z}))
    --level;
  if (level < kCoarsest) return;
  const Cube low = cubeOf(box.min, level), high = cubeOf(box.max, level);
  for (int64_t i = low.i; i <= high.i; ++i)
    for (int64_t j = low.j; j <= high.j; ++j)
      for (int64_t k = low.k; k <= high.k; ++k)
        cubes_[static_cast<size_t>(level - kCoarsest)]
            .try_emplace({i, j, k}, content)
            .first->second.add(content, grid_.lift);
}

bool SmallObjects::anyNear(const GatherSite& site, double side) const {
  const int level = std::max(grid_.levelOf(side * kRounding), kCoarsest);
  if (level > finest_) return false;
  const Cubes& cubes = cubes_[static_cast<size_t>(level - kCoarsest)];
  if (cubes.empty()) return false;
  const V3d half(side / 2);
  const Cube low = cubeOf(site.point - half, level), high = cubeOf(site.point + half, level);
  const double offset = site.normal.dot(site.point);
  for (int64_t i = low.i; i <= high.i; ++i)
    for (int64_t j = low.j; j <= high.j; ++j)
      for (int64_t k = low.k; k <= high.k; ++k) {
        const auto found = cubes.find({i, j, k});
        if (found != cubes.end() && !found->second.liesIn(site.normal, offset, grid_.lift)) return true;
      }
  return false;
}

}  // namespace rsphere
