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
  // REQUIRES that make() would not return null.
  DiffuseGlances(const PreparedScene& prepared, PlainSurfaces surfaces, const SphereOptions& options,
                 const BaseSet& base);

  // What one set of glances and joins finds at its point.
  struct Found {
    explicit Found(const EqualZones* zones = nullptr) : moments(zones), ofZones(zones) {}
    Moments moments;     // of the light
    Variance variance;   // of moments.total, by the choice of glances and joins; 0 unless errors are wanted
    SharedError shared;  // of moments.total, by the light vertices; empty unless errors are wanted
    size_t lit = 0;      // glances that found light
    // The same by zone (-Sz); empty if there are none, or if errors are not wanted.
    ZoneVariances ofZones;
    std::vector<SharedError> sharedByZone;
  };
  Found at(const SetAtPoint& set) const;

  // The same light along one direction (W/sr/m2), by one glance. number: of the direction.
  Radiance along(const SetAtPoint& set, const V3d& direction, size_t number) const;

  // For the surfaces that the directions of a set (SetAtPoint::number()) meet behind others.
  const VertexLight& light(uint64_t set) const;

 private:
  class Joins;
  // What the glances at one point share.
  struct Glancing {
    const VertexLight& both;
    Random random;
    const Joins* joins = nullptr;           // null: nothing is joined to the point
    VertexLight::Record* record = nullptr;  // null: errors are not wanted
    double cell = 0;                        // solid angle of a glance, sr
    VertexLight::Scratch scratch{};
  };
  // By zone, or one if there are none.
  using Records = std::vector<VertexLight::Record>;
  VertexLight::Record& recordFor(const V3d& direction, Records& records) const;
  void addJoins(const SetAtPoint& set, const Joins& joins, Records& records, Found& found) const;
  Radiance glance(const V3d& point, const V3d& direction, Glancing& by) const;

  const PreparedScene& prepared_;
  PlainSurfaces surfaces_;
  size_t pools_, paths_;  // sets of light vertices; paths of each
  uint64_t rotation_;
  std::vector<V3d> glances_;
  std::shared_ptr<const EqualZones> zones_;  // null: light is not divided
  std::optional<Neighbours> neighbours_;     // if standard errors are wanted
  double joins_;                             // expected at a point
  // With -Sa, sets of directions have light vertices of their own, so that the error of these is averaged
  // too. Made when they are first used.
  static constexpr size_t kPools = 8;
  mutable std::array<std::once_flag, kPools> made_;
  mutable std::array<std::unique_ptr<const VertexLight>, kPools> lights_;
};

}  // namespace rsphere
