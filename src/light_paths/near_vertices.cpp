#include "light_paths/near_vertices.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "light_paths/light_vertex.h"
#include "light_paths/tuning.h"

namespace rsphere {
namespace {

// Bits of a cube's number along each axis, and the most cubes.
constexpr int kBits = 21;
constexpr double kMost = 1 << kBits;

// Calls use(begin, end) for the vertices of each cube.
template <class Vertices, class Use>
void forEachCube(const Vertices& byCube, const Use& use) {
  for (size_t begin = 0, end; begin < byCube.size(); begin = end) {
    for (end = begin; end < byCube.size() && byCube[end].first == byCube[begin].first;) ++end;
    use(begin, end);
  }
}

}  // namespace

std::optional<NearVertices> NearVertices::of(std::span<const LightVertex> vertices, double width) {
  NearVertices near;
  Box3d box;
  for (uint32_t i = 0; i < vertices.size(); ++i)
    if (vertices[i].isUnbounded() && vertices[i].power > 0) {
      near.vertices_.push_back(i);
      box.extendBy(vertices[i].point());
    }
  if (near.vertices_.empty()) return {};
  const V3d size = box.size();
  near.origin_ = box.min;
  // Lower bound: cubes along an axis must not outnumber kMost.
  const double least = std::max({size.x, size.y, size.z}) / (kMost / 4);
  near.side_ = std::max(2 * width, least);
  ByCube byCube = near.sorted(vertices);
  // The mean number of vertices in the cube of a vertex. It grows with the area of the cube's face.
  double pairs = 0;
  forEachCube(byCube, [&](size_t begin, size_t end) {
    pairs += static_cast<double>(end - begin) * static_cast<double>(end - begin);
  });
  const double shared = pairs / static_cast<double>(byCube.size());
  if (shared > tuning::VertexLight::kInCube) {
    near.side_ = std::max(near.side_ * std::sqrt(tuning::VertexLight::kInCube / shared), least);
    byCube = near.sorted(vertices);
  }
  near.slots_.resize(std::bit_ceil(2 * byCube.size()));
  near.sums_.push_back(0);
  for (size_t i = 0; i < byCube.size(); ++i) {
    near.vertices_[i] = byCube[i].second;
    near.sums_.push_back(near.sums_.back() + vertices[byCube[i].second].power);
  }
  forEachCube(byCube, [&](size_t begin, size_t end) {
    const uint64_t key = byCube[begin].first;
    near.slots_[near.slotOf(key)] = {key, {static_cast<uint32_t>(begin), static_cast<uint32_t>(end)}};
  });
  return near;
}

NearVertices::ByCube NearVertices::sorted(std::span<const LightVertex> vertices) const {
  ByCube all;
  all.reserve(vertices_.size());
  for (const uint32_t i : vertices_) all.emplace_back(keyOf(cubeAt(vertices[i].point(), 0)), i);
  std::ranges::sort(all);
  return all;
}

std::array<int64_t, 3> NearVertices::cubeAt(const V3d& point, double offset) const {
  std::array<int64_t, 3> cube;
  for (int axis = 0; axis < 3; ++axis)
    cube[axis] = static_cast<int64_t>(
        std::floor(std::clamp((point[axis] - origin_[axis]) / side_ + offset, -2., kMost + 2.)));
  return cube;
}

uint64_t NearVertices::keyOf(const std::array<int64_t, 3>& cube) {
  uint64_t key = 0;
  for (const int64_t at : cube) key = key << kBits | static_cast<uint64_t>(at);
  return key;
}

// The slot of a cube, or the empty one that it would take.
size_t NearVertices::slotOf(uint64_t key) const {
  size_t i = mixBits(key);
  while (slots_[i &= slots_.size() - 1].part.end > 0 && slots_[i].key != key) ++i;
  return i;
}

NearVertices::Around NearVertices::around(const V3d& point) const {
  Around around(*this);
  around.low_ = cubeAt(point, -.5);
  for (int corner = 0; corner < 8; ++corner) {
    auto cube = around.low_;
    bool inside = true;
    for (int axis = 0; axis < 3; ++axis) {
      cube[axis] += corner >> axis & 1;
      inside = inside && cube[axis] >= 0 && cube[axis] < static_cast<int64_t>(kMost);
    }
    if (!inside) continue;
    around.parts_[corner] = slots_[slotOf(keyOf(cube))].part;
    around.power_ += powerOf(around.parts_[corner]);
  }
  return around;
}

uint32_t NearVertices::Around::draw(Random& random) const {
  double left = random.uniform() * power_;
  uint32_t last = 0;
  for (const Part& part : parts_) {
    if (part.begin == part.end) continue;
    const double own = all_.powerOf(part);
    last = part.end - 1;
    if (left < own) {
      const auto sums = std::span(all_.sums_).subspan(part.begin + 1, part.end - part.begin);
      const auto after = std::ranges::upper_bound(sums, all_.sums_[part.begin] + left);
      last = std::min(last, part.begin + static_cast<uint32_t>(after - sums.begin()));
      break;
    }
    left -= own;
  }
  return all_.vertices_[last];
}

double NearVertices::Around::probabilityOf(const LightVertex& vertex) const {
  if (empty() || !vertex.isUnbounded()) return 0;
  const auto cube = all_.cubeAt(vertex.point(), 0);
  for (int axis = 0; axis < 3; ++axis)
    if (cube[axis] != low_[axis] && cube[axis] != low_[axis] + 1) return 0;
  return vertex.power / power_;
}

}  // namespace rsphere
