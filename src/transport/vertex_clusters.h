#pragma once
// Light vertices in clusters, by which a place chooses some of those that send it the most light.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/color.h"
#include "scene/random.h"
#include "transport/tuning.h"

namespace rsphere {

struct LightVertex;

// Constant.
class VertexClusters {
 public:
  // An order of the vertices in which those of a cluster follow each other: they lie near to each other and
  // face alike.
  struct Order {
    std::vector<uint32_t> vertices;
    std::vector<uint32_t> ends;  // of each cluster, the position after its last vertex
  };
  static Order orderOf(std::span<const LightVertex> vertices);

  // Of vertices in this order. Keeps the first span. width: LightVertices::width(), world units.
  VertexClusters(std::span<const LightVertex> vertices, std::span<const uint32_t> ends, double width);

  // The place that light arrives at.
  struct Receiver {
    V3d point, normal;  // world; unit
    int bounces;        // at most, of the light of a vertex
  };
  struct Candidate {
    uint32_t vertex = 0;
    double drawn = 0;   // how often it is drawn, on average
    double weight = 0;  // the light that it would send if it were in view, but for constants
  };
  struct Candidates {
    std::array<Candidate, tuning::VertexLight::kCandidatesRoom> all;
    size_t count = 0;
  };
  // Up to kCandidates vertices, from clusters in proportion to the light that these would send; fewer if some
  // of the draws find vertices that send none.
  Candidates draw(const Receiver& to, Random& random) const;

 private:
  static constexpr size_t kCount = tuning::VertexLight::kClustersRoom;
  using Numbers = std::array<float, kCount>;

  size_t firstOf(size_t cluster) const { return cluster > 0 ? ends_[cluster - 1] : 0; }
  void measure(size_t cluster);
  void weigh(const Receiver& to, Numbers& weights) const;

  std::span<const LightVertex> vertices_;
  std::vector<uint32_t> ends_;
  double width2_;
  V3d middle_{0, 0, 0};
  // Of each cluster. By component, so that several clusters are weighed at a time.
  Numbers x_{}, y_{}, z_{};  // the middle of the box around its vertices, from middle_
  Numbers halfX_{}, halfY_{}, halfZ_{};
  Numbers spread_{};                     // mean square of the distances from the middle, about
  Numbers axisX_{}, axisY_{}, axisZ_{};  // mean normal (unit)
  Numbers halfAlong_{};                  // half the width of the box along it
  Numbers sine_{};                       // of the largest angle between a normal and the mean; 1: no bound
  Numbers power_{};                      // brightness of what is reflected diffusely, W
};

}  // namespace rsphere
