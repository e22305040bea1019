#pragma once
// Light vertices in clusters. For a place, vertices are drawn by estimates of the light that their clusters
// send to it.
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/color.h"
#include "scene/random.h"
#include "transport/hidden_boxes.h"
#include "transport/tuning.h"

namespace rsphere {

struct LightVertex;

// Constant.
class VertexClusters {
 public:
  // An order of the vertices in which those of a cluster follow each other. Vertices of a cluster are near
  // each other and have similar normals.
  struct Order {
    std::vector<uint32_t> vertices;
    std::vector<uint32_t> ends;  // of each cluster, the position after its last vertex
  };
  static Order orderOf(std::span<const LightVertex> vertices);

  // The box around each cluster.
  static std::vector<Box3d> boxesOf(std::span<const LightVertex> vertices, std::span<const uint32_t> ends);

  // The vertices must be in this order, with these ends. Keeps the span of vertices. width:
  // NearLight::width, world units. hidden: the clusters' boxes; none where little is hidden.
  VertexClusters(std::span<const LightVertex> vertices, std::span<const uint32_t> ends, double width,
                 std::optional<HiddenBoxes> hidden = {});

  // The place that light arrives at.
  struct Receiver {
    V3d point, normal;  // world; unit
    int bounces;        // vertices of light with more bounces are left out
  };
  struct Candidate {
    uint32_t vertex = 0;
    double drawn = 0;   // expected number of times that it is drawn
    double weight = 0;  // unoccluded light that it sends, except for constant factors
  };
  struct Candidates {
    std::array<Candidate, tuning::VertexLight::kCandidatesRoom> all;
    size_t count = 0;
  };
  // Draws kCandidates vertices, from clusters in proportion to their estimated light. Vertices that send none
  // are left out, so that the result may have fewer.
  Candidates draw(const Receiver& to, Random& random) const;

 private:
  static constexpr size_t kCount = tuning::VertexLight::kClustersRoom;
  // Number of clusters in a group. A group is chosen by its total weight first, so that the clusters of other
  // groups need not be looked at one by one.
  static constexpr size_t kGroup = 8;
  static_assert(kCount % kGroup == 0);
  using Numbers = std::array<float, kCount>;

  size_t firstOf(size_t cluster) const { return cluster > 0 ? ends_[cluster - 1] : 0; }
  void measure(size_t cluster);
  void weigh(const Receiver& to, Numbers& weights) const;

  std::span<const LightVertex> vertices_;
  std::vector<uint32_t> ends_;
  std::optional<HiddenBoxes> hidden_;
  double width2_;
  V3d middle_{0, 0, 0};
  // One element for each cluster; separate arrays, so that several clusters are weighed at a time (SIMD).
  Numbers x_{}, y_{}, z_{};  // center of the box around its vertices, relative to middle_
  Numbers halfX_{}, halfY_{}, halfZ_{};
  Numbers spread_{};                     // approximate mean square distance from the center
  Numbers axisX_{}, axisY_{}, axisZ_{};  // mean normal (unit)
  Numbers halfAlong_{};                  // half the width of the box along the mean normal
  Numbers sine_{};                       // sine of the largest angle of a normal to the mean; 1: no bound
  Numbers power_{};                      // brightness of the diffusely reflected light, W
};

}  // namespace rsphere
