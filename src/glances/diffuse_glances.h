#pragma once
// The light of the plain diffuse surfaces in view of a point, by bidirectional sampling
// (light_paths/vertex_light.h):
// - glances: evenly spread rays that end at the nearest hit, without further bounces; many for each traced
//   direction,
// - joins: connections, which are shadow rays from the point to light vertices, sent more often to vertices
//   that would contribute more.
// Traced directions find the remaining light: of sources in view, sharp reflections, and sampled rough
// highlights.
#include <memory>
#include <optional>
#include <vector>

#include "glances/light_pools.h"
#include "glances/sphere_tracing.h"
#include "points/base_set.h"
#include "points/sampling_strategy.h"
#include "points/sphere_options.h"

namespace rsphere {

// Shared by all threads.
class DiffuseGlances {
 public:
  // Null if bidirectional sampling would miss some of the light (PlainSurfaces::obstacle()). Keeps
  // references.
  static std::unique_ptr<const DiffuseGlances> make(const PreparedScene& prepared,
                                                    const SphereOptions& options, const BaseSet& base);
  // make() for rooms that daylight enters through openings, for points for which suitsDaylight() is true.
  // surfaces: from daylitSurfaces().
  static std::unique_ptr<const DiffuseGlances> makeDaylit(const SphereTracing& tracing,
                                                          const PlainSurfaces& surfaces,
                                                          const SphereOptions& options, const BaseSet& base);
  // REQUIRES that surfaces.obstacle() is null. tracers: none without portals.
  DiffuseGlances(const PreparedScene& prepared, PlainSurfaces surfaces, const SphereOptions& options,
                 const BaseSet& base, LightPools::Tracers tracers = {});

  // The light found by the glances and joins of one set at its point.
  struct Found {
    explicit Found(const Kernels& kernels = {}, const std::optional<V3d>& gaze = {})
        : moments(kernels.zones.get(), gaze), ofKernels(kernels) {}
    Moments moments;     // of the light
    Variance variance;   // of moments.total, due to choosing glances and joins; 0 unless errors are requested
    SharedError shared;  // of moments.total, due to the light vertices; empty unless errors are requested
    size_t lit = 0;      // glances that found light
    // Variance and shared error by zone (-Sz) and quantity; empty without any, or if no errors are requested.
    KernelVariances ofKernels;
    std::vector<SharedError> sharedByKernel;
  };
  // tracer: for the light beyond portals.
  Found at(const SetAtPoint& set, PathTracer& tracer) const;

  // An estimate of the light of at() along one direction (W/sr/m2), by one glance. number: of the direction.
  Radiance along(const SetAtPoint& set, const V3d& direction, size_t number, PathTracer& tracer) const;

  // The light vertices of a set, for surfaces that its traced directions see in reflections or through panes
  // and other transmitting surfaces.
  std::shared_ptr<const VertexLight> light(const SetAtPoint& set) const {
    return lights_.at(set.point(), set.number());
  }
  const LightPools& lights() const { return lights_; }

 private:
  class Joins;
  // State shared by the glances at one point.
  struct Glancing {
    const VertexLight& both;
    Random random;
    const Joins* joins = nullptr;           // null: no joins
    VertexLight::Record* record = nullptr;  // null: errors are not requested
    double cell = 0;                        // solid angle of a glance, sr
    VertexLight::Scratch scratch{};
    const OutdoorRadiance* outdoors = nullptr;
  };
  struct Joined {
    V3d direction;
    Irradiance part;
    uint8_t batch;
    double notChosen;  // 1 minus the probability of the vertex
  };
  SharedError evened(const Joins& joins, std::span<const Joined> all) const;
  std::vector<SharedError> sharedByKernel(const Joins& joins, std::span<const Joined> all) const;
  void addJoins(const SetAtPoint& set, const Joins& joins, VertexLight::Record& record, Found& found) const;
  Radiance glance(const V3d& point, const V3d& direction, Glancing& by) const;

  const PreparedScene& prepared_;
  PlainSurfaces surfaces_;
  LightPools lights_;
  std::vector<V3d> glances_;
  Kernels kernels_;
  std::optional<Neighbours> neighbours_;  // empty unless standard errors are requested
  double joins_;                          // expected number of joins at a point
};

// The surfaces of a scene with the openings of tracing.aims as portals. Empty if there are no openings, if
// light is interpolated (-aa above 0), or if paths from both ends would miss some of the light.
std::optional<PlainSurfaces> daylitSurfaces(const SphereTracing& tracing);

// Whether nearly all paths of up to `bounces` diffuse reflections from a point in a daylit room lead only to
// plain surfaces and portals. Where they do not, for example outdoors, most of the light would be left to the
// few paths from the eye. Depends only on the point and the scene.
bool suitsDaylight(const V3d& point, const PlainSurfaces& surfaces, int bounces);

}  // namespace rsphere
