#pragma once
// The light that a point receives from the plain surfaces in its view, by paths from both ends
// (transport/vertex_light.h):
// - glances: evenly spread directions for which only the nearest surface is found, many for each traced
//   direction,
// - joins: shadow rays from the point to light vertices, more often to those that would contribute more.
// Traced directions find the rest: the light of sources in view, of sharp reflections and of samples of rough
// highlights.
#include <memory>
#include <optional>
#include <vector>

#include "importance/base_set.h"
#include "importance/light_pools.h"
#include "importance/sampling_strategy.h"
#include "importance/sphere_options.h"

namespace rsphere {

// Shared by all threads.
class DiffuseGlances {
 public:
  // With -Sa and -Su, sets of directions use this number of pools of light vertices in turn, so that the
  // error of the vertices is averaged too.
  static constexpr size_t kPools = 8;

  // Null if paths from both ends miss some of the light (PlainSurfaces::obstacle()). Keeps references.
  static std::unique_ptr<const DiffuseGlances> make(const PreparedScene& prepared,
                                                    const SphereOptions& options, const BaseSet& base);
  // REQUIRES that make() would not return null.
  DiffuseGlances(const PreparedScene& prepared, PlainSurfaces surfaces, const SphereOptions& options,
                 const BaseSet& base);

  // The result of one set of glances and joins at its point.
  struct Found {
    // gaze: Moments::gaze.
    explicit Found(const EqualZones* zones = nullptr, const std::optional<V3d>& gaze = {})
        : moments(zones, gaze), ofZones(zones) {}
    Moments moments;     // of the light
    Variance variance;   // of moments.total, due to choosing glances and joins; 0 unless errors are wanted
    SharedError shared;  // of moments.total, due to the light vertices; empty unless errors are wanted
    size_t lit = 0;      // glances that found light
    // The variance and the shared error by zone (-Sz); empty without zones, or if errors are not wanted.
    ZoneVariances ofZones;
    std::vector<SharedError> sharedByZone;
  };
  Found at(const SetAtPoint& set) const;

  // The same light from one direction (W/sr/m2), estimated by one glance. number: of the direction.
  Radiance along(const SetAtPoint& set, const V3d& direction, size_t number) const;

  // The light vertices for a set, to be used at surfaces that its directions see in reflections or through
  // other surfaces.
  std::shared_ptr<const VertexLight> light(const SetAtPoint& set) const {
    return lights_.at(set.point(), set.number());
  }
  std::shared_ptr<const VertexLight> lightOfAll() const { return lights_.ofAll(); }  // for any point

 private:
  class Joins;
  // What the glances at one point share.
  struct Glancing {
    const VertexLight& both;
    Random random;
    const Joins* joins = nullptr;           // null: no vertices are joined to the point
    VertexLight::Record* record = nullptr;  // null: errors are not wanted
    double cell = 0;                        // solid angle of a glance, sr
    VertexLight::Scratch scratch{};
  };
  // One for each zone, or a single one without zones.
  using Records = std::vector<VertexLight::Record>;
  VertexLight::Record& recordFor(const V3d& direction, Records& records) const;
  void addJoins(const SetAtPoint& set, const Joins& joins, Records& records, Found& found) const;
  Radiance glance(const V3d& point, const V3d& direction, Glancing& by) const;

  const PreparedScene& prepared_;
  PlainSurfaces surfaces_;
  LightPools lights_;
  std::vector<V3d> glances_;
  std::shared_ptr<const EqualZones> zones_;  // null: light is not divided
  std::optional<Neighbours> neighbours_;     // if standard errors are wanted
  double joins_;                             // expected number of joins at a point
};

}  // namespace rsphere
