#pragma once
// The light that the plain surfaces in view of a point send to it, by paths from both ends
// (transport/vertex_light.h):
// - glances, even directions of which only the nearest surface is looked for, many for each direction that is
//   traced,
// - joins: shadow rays from the point to light vertices, more to those that would show more.
// What is left to the directions that are traced is the light of sources in view, of sharp reflections and of
// the samples of rough highlights.
#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "importance/base_set.h"
#include "importance/sampling_strategy.h"
#include "importance/sphere_options.h"
#include "transport/vertex_light.h"

namespace rsphere {

// Shared by all threads.
class DiffuseGlances {
 public:
  // Null if paths from both ends miss some of the light (PlainSurfaces::obstacle()). Keeps references.
  static std::unique_ptr<const DiffuseGlances> make(const PreparedScene& prepared,
                                                    const SphereOptions& options, const BaseSet& base);
  DiffuseGlances(const PreparedScene& prepared, const SphereOptions& options, const BaseSet& base);

  struct Found {
    Moments moments;     // of the light, as Moments of radiance
    Variance variance;   // of moments.total by glances; 0 unless standard errors are wanted
    SharedError shared;  // of moments.total by light vertices; empty unless standard errors are wanted
    size_t lit = 0;      // glances that found light
  };
  Found at(const SetAtPoint& set) const;

  // The same light along one direction (W/sr/m2), by one glance. number: of the direction.
  Radiance along(const SetAtPoint& set, const V3d& direction, size_t number) const;

  // For the surfaces that the directions of a set (SetAtPoint::number()) meet behind others.
  const VertexLight& light(uint64_t set) const;

 private:
  class Joins;

  const PreparedScene& prepared_;
  PlainSurfaces surfaces_;
  size_t paths_;
  uint64_t rotation_;
  std::vector<V3d> glances_;
  std::optional<Neighbours> neighbours_;  // if standard errors are wanted
  double joins_;                          // expected at a point
  bool averages_;                         // several sets at a point (-Sa)
  // Sets have light vertices of their own, so that the error of these is averaged too; made when they are
  // first used.
  static constexpr size_t kPools = 8;
  mutable std::array<std::once_flag, kPools> made_;
  mutable std::array<std::unique_ptr<const VertexLight>, kPools> lights_;
};

}  // namespace rsphere
