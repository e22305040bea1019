#pragma once
// Clusters of light vertices. For each place, vertices are sampled in proportion to estimates of the light
// that their clusters send to it.
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/color.h"
#include "base/random.h"
#include "light_paths/near_vertices.h"
#include "light_paths/tuning.h"
#include "occluders/hidden_boxes.h"

namespace rsphere {

struct LightVertex;

class VertexClusters {
 public:
  // An order of the vertices in which the vertices of each cluster are consecutive. They are near each other
  // and have similar normals. uneven: a small part of them may have most of the power.
  struct Order {
    std::vector<uint32_t> vertices;
    std::vector<uint32_t> ends;  // for each cluster, the index after its last vertex
  };
  static Order orderOf(std::span<const LightVertex> vertices, bool uneven = false);

  // The bounding box of each cluster.
  static std::vector<Box3d> boxesOf(std::span<const LightVertex> vertices, std::span<const uint32_t> ends);

  // vertices: sorted by orderOf(), which gives `ends`; keeps the span. width: NearLight::width, world units.
  // uneven: as for orderOf(). hidden: of the boxes of boxesOf(); empty if little is hidden.
  VertexClusters(std::span<const LightVertex> vertices, std::span<const uint32_t> ends, double width,
                 bool uneven, std::optional<HiddenBoxes> hidden = {});

  // The place at which light arrives.
  struct Receiver {
    V3d point, normal;  // world; unit
    int bounces;        // vertices of light with more bounces are ignored
  };
  struct Candidate {
    uint32_t vertex = 0;
    double drawn = 0;   // expected number of times that it is sampled
    double weight = 0;  // unoccluded light that it sends, up to constant factors
  };
  struct Candidates {
    std::array<Candidate, tuning::VertexLight::kCandidatesRoom + 1> all;
    size_t count = 0;
  };
  // Samples kCandidates vertices, from clusters with probabilities proportional to their estimated light, and
  // one of NearVertices, if there are any. Vertices that send no light are dropped, so that there may be
  // fewer.
  Candidates draw(const Receiver& to, Random& random) const;

 private:
  static constexpr size_t kCount = tuning::VertexLight::kClustersRoom;
  // Number of clusters in a group. A group is first selected by its total weight, which avoids going through
  // the clusters of all groups.
  static constexpr size_t kGroup = 8;
  static_assert(kCount % kGroup == 0);
  // One element for each cluster. Separate arrays allow weighing several clusters at a time (SIMD).
  using Numbers = std::array<float, kCount>;
  struct VectorArrays {
    Numbers x{}, y{}, z{};
    void set(size_t cluster, const V3d& to);
  };
  // The box around a cluster's vertices.
  struct Boxes {
    VectorArrays center;  // relative to middle_
    VectorArrays half;
    Numbers spread{};  // approximate mean square distance of the vertices from the center
  };
  struct Normals {
    VectorArrays mean;    // unit
    Numbers halfAlong{};  // half the width of the box along the mean normal
    Numbers sine{};       // sine of the largest angle between a normal and the mean; 1: no bound
  };

  size_t clusterOf(uint32_t vertex) const;
  void addNear(const Receiver& to, const Numbers& weights, double scale, Random& random,
               Candidates& drawn) const;
  size_t firstOf(size_t cluster) const { return cluster > 0 ? ends_[cluster - 1] : 0; }
  void measure(size_t cluster);
  void weigh(const Receiver& to, Numbers& weights) const;

  std::span<const LightVertex> vertices_;
  std::vector<uint32_t> ends_;
  std::optional<HiddenBoxes> hidden_;
  std::optional<NearVertices> near_;
  struct Falloff {
    double width2;    // the square of the width
    float byNearest;  // 1: clusters are weighed by their nearest place, too; 0: not
  } falloff_;
  V3d middle_{0, 0, 0};
  Boxes boxes_;
  Normals normals_;
  Numbers power_{};  // brightness of the diffusely reflected light, W
};

}  // namespace rsphere
