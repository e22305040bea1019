#include "light_paths/vertex_clusters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "light_paths/light_vertex.h"
#include "scene/shape.h"

namespace rsphere {
namespace {

// Relative rounding error of single precision, with a margin.
constexpr double kRounding = 1e-6;

// A vertex as a point in six dimensions: its position, and its normal times a length.
class Coordinates {
 public:
  explicit Coordinates(std::span<const LightVertex> vertices) : vertices_(vertices) {
    Box3d box;
    for (const LightVertex& v : vertices) box.extendBy(v.point());
    if (!vertices.empty()) length_ = tuning::VertexLight::kFacing * box.size().length();
  }
  double of(uint32_t i, int axis) const {
    return axis < 3 ? vertices_[i].place[axis] : vertices_[i].facing[axis - 3] * length_;
  }
  // The coordinate in which the given vertices vary most, and its range.
  struct Widest {
    int axis = 0;
    double least = 0, most = 0;
    double width() const { return most - least; }
  };
  // All coordinates are compared in one pass, because most vertices are not in the processor's cache.
  Widest widest(std::span<const uint32_t> some) const {
    std::array<double, 6> least, most;
    least.fill(std::numeric_limits<double>::infinity());
    most.fill(-std::numeric_limits<double>::infinity());
    for (const uint32_t i : some)
      for (int axis = 0; axis < 6; ++axis) {
        const double x = axis < 3 ? vertices_[i].place[axis] : vertices_[i].facing[axis - 3];
        least[axis] = std::min(least[axis], x);
        most[axis] = std::max(most[axis], x);
      }
    Widest widest;
    for (int axis = 0; axis < 6; ++axis) {
      const double unit = axis < 3 ? 1 : length_;
      const Widest along{axis, least[axis] * unit, most[axis] * unit};
      if (along.width() > widest.width()) widest = along;
    }
    return widest;
  }
  double powerOf(std::span<const uint32_t> some) const {
    double sum = 0;
    for (const uint32_t i : some) sum += vertices_[i].power;
    return sum;
  }

 private:
  std::span<const LightVertex> vertices_;
  double length_ = 0;
};

// The unoccluded light that arrives from a vertex, up to constant factors.
double weightOf(const LightVertex& v, const VertexClusters::Receiver& to, double width2) {
  const V3d way = v.point() - to.point;
  const double here = way.dot(to.normal), there = -way.dot(v.normal());
  if (!(here > 0) || !(there > 0) || v.bounces > to.bounces) return 0;
  const double square = way.length2();
  return v.power * here * there / (square * square + (v.isUnbounded() ? 0 : width2 * width2));
}

// The mean of max(h, 0) for h uniform between height - half and height + half. half: above 0.
inline float meanAbove(float height, float half) {
  const float above = std::min(std::max(height + half, 0.f), 2 * half);
  return above * above / (4 * half) + std::max(height - half, 0.f);
}

// The square of max(x, 0). With std::max() here, the compiler does not vectorize the loop that calls it.
inline float squareAbove(float x) {
  const float above = .5f * (x + std::abs(x));
  return above * above;
}

}  // namespace

// Repeatedly halves the cluster with the largest product of power and extent, until the number of clusters is
// reached. The root of the power is used if a spot of sunlight may have most of the power. It would
// otherwise get most of the clusters, and the others would be so large that a place beside a wall would
// seldom draw the vertices next to it.
VertexClusters::Order VertexClusters::orderOf(std::span<const LightVertex> vertices, bool uneven) {
  Order order{std::vector<uint32_t>(vertices.size()), {}};
  std::iota(order.vertices.begin(), order.vertices.end(), 0);
  const Coordinates at(vertices);
  struct Cluster {
    std::span<uint32_t> own;
    Coordinates::Widest widest;
    double weight;
    bool operator<(const Cluster& other) const {
      return weight * widest.width() < other.weight * other.widest.width();
    }
  };
  const auto clusterOf = [&](std::span<uint32_t> own) {
    const double power = at.powerOf(own);
    return Cluster{own, at.widest(own), uneven ? std::sqrt(power) : power};
  };
  std::vector<Cluster> clusters;
  if (!vertices.empty()) clusters.push_back(clusterOf(order.vertices));
  while (!clusters.empty() && clusters.size() < tuning::VertexLight::kClusters) {
    std::pop_heap(clusters.begin(), clusters.end());
    const Cluster widest = clusters.back();
    const double middle = .5 * (widest.widest.least + widest.widest.most);
    const auto isLow = [&](uint32_t i) { return at.of(i, widest.widest.axis) < middle; };
    const auto upper = std::partition(widest.own.begin(), widest.own.end(), isLow);
    const auto lower = static_cast<size_t>(upper - widest.own.begin());
    if (lower == 0 || lower == widest.own.size()) break;
    clusters.back() = clusterOf(widest.own.first(lower));
    std::push_heap(clusters.begin(), clusters.end());
    clusters.push_back(clusterOf(widest.own.subspan(lower)));
    std::push_heap(clusters.begin(), clusters.end());
  }
  for (const Cluster& cluster : clusters)
    order.ends.push_back(
        static_cast<uint32_t>(cluster.own.data() - order.vertices.data() + cluster.own.size()));
  std::ranges::sort(order.ends);
  return order;
}

VertexClusters::VertexClusters(std::span<const LightVertex> vertices, std::span<const uint32_t> ends,
                               double width, bool uneven, std::optional<HiddenBoxes> hidden)
    : vertices_(vertices),
      ends_(ends.begin(), ends.end()),
      hidden_(std::move(hidden)),
      near_(NearVertices::of(vertices, width)),
      falloff_{width * width, uneven ? 1.f : 0.f} {
  Box3d box;
  for (const LightVertex& v : vertices) box.extendBy(v.point());
  if (!vertices.empty()) middle_ = box.center();
  for (Numbers* const size :
       {&boxes_.half.x, &boxes_.half.y, &boxes_.half.z, &boxes_.spread, &normals_.halfAlong})
    size->fill(1);  // for unused elements
  for (size_t i = 0; i < ends_.size(); ++i) measure(i);
}

std::vector<Box3d> VertexClusters::boxesOf(std::span<const LightVertex> vertices,
                                           std::span<const uint32_t> ends) {
  std::vector<Box3d> boxes;
  uint32_t first = 0;
  for (const uint32_t end : ends) {
    Box3d& box = boxes.emplace_back();
    for (; first < end; ++first) box.extendBy(vertices[first].point());
  }
  return boxes;
}

void VertexClusters::VectorArrays::set(size_t cluster, const V3d& to) {
  x[cluster] = static_cast<float>(to.x);
  y[cluster] = static_cast<float>(to.y);
  z[cluster] = static_cast<float>(to.z);
}

void VertexClusters::measure(size_t i) {
  const auto own = vertices_.subspan(firstOf(i), firstOf(i + 1) - firstOf(i));
  Box3d box;
  V3d sum(0, 0, 0);
  for (const LightVertex& v : own) {
    box.extendBy(v.point() - middle_);
    sum += v.normal();
    power_[i] += v.power;
  }
  const V3d at = box.center(), axis = sum.normalized();
  double least = 1;
  for (const LightVertex& v : own) least = std::min(least, axis.dot(v.normal()));
  // Enlarged by the rounding error of single precision, and above 0.
  const V3d half =
      .5 * box.size() + V3d(kRounding * (std::sqrt(falloff_.width2) + box.size().length() + at.length()));
  boxes_.center.set(i, at);
  boxes_.half.set(i, half);
  boxes_.spread[i] = static_cast<float>(half.length2() / 3);
  normals_.mean.set(i, axis);
  normals_.halfAlong[i] =
      static_cast<float>(half.x * std::abs(axis.x) + half.y * std::abs(axis.y) + half.z * std::abs(axis.z));
  normals_.sine[i] =
      least > 0 ? static_cast<float>(std::sqrt(1 - std::min(1., least * least)) + kRounding) : 1.f;
}

// Estimates the light from each cluster. An estimate is 0 only if all vertices of the cluster are hidden or
// have the weight 0.
void VertexClusters::weigh(const Receiver& to, Numbers& weights) const {
  const Imath::V3f p(to.point - middle_), n(to.normal);
  const float ax = std::abs(n.x), ay = std::abs(n.y), az = std::abs(n.z);
  const auto width2 = static_cast<float>(falloff_.width2);
  const float byNearest = falloff_.byNearest;
  const auto& [center, half, spread] = boxes_;
  const auto& [axis, halfAlong, sine] = normals_;
  for (size_t i = 0; i < kCount; ++i) {
    const float x = center.x[i] - p.x, y = center.y[i] - p.y, z = center.z[i] - p.z;
    const float square = x * x + y * y + z * z;
    const float here =
        meanAbove(x * n.x + y * n.y + z * n.z, half.x[i] * ax + half.y[i] * ay + half.z[i] * az);
    const float there = meanAbove(-(x * axis.x[i] + y * axis.y[i] + z * axis.z[i]),
                                  halfAlong[i] + sine[i] * (std::abs(x) + std::abs(y) + std::abs(z)));
    const float mean = square + spread[i];
    // By daylight, clusters are large where spots of sunlight have taken most of them. A large cluster
    // sends most of its light from where it is nearest.
    const float nearest = squareAbove(std::abs(x) - half.x[i]) + squareAbove(std::abs(y) - half.y[i]) +
                          squareAbove(std::abs(z) - half.z[i]);
    const float away = mean + byNearest * (nearest + width2 - mean);
    weights[i] = power_[i] * (here / away) * (there / (mean + width2));
  }
  if (!hidden_) return;
  Numbers seen{};
  for (const uint32_t i : hidden_->notHiddenFrom(to.point, to.normal)) seen[i] = weights[i];
  weights = seen;
}

size_t VertexClusters::clusterOf(uint32_t vertex) const {
  return static_cast<size_t>(std::ranges::upper_bound(ends_, vertex) - ends_.begin());
}

// Adds one vertex of those around the place. A candidate can then be sampled in two ways.
void VertexClusters::addNear(const Receiver& to, const Numbers& weights, double scale, Random& random,
                             Candidates& drawn) const {
  const NearVertices::Around around = near_->around(to.point);
  if (around.empty()) return;
  const uint32_t vertex = around.draw(random);
  const size_t cluster = clusterOf(vertex);
  drawn.all[drawn.count++] = {
      vertex, weights[cluster] * scale / static_cast<double>(firstOf(cluster + 1) - firstOf(cluster))};
  for (size_t k = 0; k < drawn.count; ++k)
    drawn.all[k].drawn += around.probabilityOf(vertices_[drawn.all[k].vertex]);
}

VertexClusters::Candidates VertexClusters::draw(const Receiver& to, Random& random) const {
  Numbers weights;
  weigh(to, weights);
  std::array<double, kCount / kGroup> groups{};
  for (size_t g = 0; g < groups.size(); ++g)
    for (size_t i = g * kGroup; i < (g + 1) * kGroup; ++i) groups[g] += weights[i];
  const double sum = std::accumulate(groups.begin(), groups.end(), 0.);
  if (!(sum > 0)) return {};
  const double scale = static_cast<double>(tuning::VertexLight::kCandidates) / sum;
  Candidates drawn;
  double due = random.uniform();
  const auto drawFrom = [&](size_t i) {
    const double expected = weights[i] * scale;
    for (due += expected; due >= 1 && drawn.count < drawn.all.size() - 1; --due) {
      const size_t first = firstOf(i), own = firstOf(i + 1) - first;
      const auto vertex =
          static_cast<uint32_t>(first + static_cast<size_t>(random.uniform() * static_cast<double>(own)));
      // All vertices are prefetched before the first is used, because few of them are in the processor's
      // cache.
      __builtin_prefetch(&vertices_[vertex]);
      __builtin_prefetch(&vertices_[vertex].bounces);
      drawn.all[drawn.count++] = {vertex, expected / static_cast<double>(own)};
    }
  };
  for (size_t g = 0; g < groups.size(); ++g)
    if (const double all = due + groups[g] * scale; all < 1)
      due = all;
    else
      for (size_t i = g * kGroup; i < (g + 1) * kGroup; ++i) drawFrom(i);
  if (near_) addNear(to, weights, scale, random, drawn);
  Candidates found;
  for (size_t k = 0; k < drawn.count; ++k) {
    Candidate& candidate = found.all[found.count];
    candidate = drawn.all[k];
    candidate.weight = weightOf(vertices_[candidate.vertex], to, falloff_.width2);
    found.count += candidate.weight > 0;
  }
  return found;
}

}  // namespace rsphere
