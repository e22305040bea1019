#pragma once
// Traces the rays that the irradiance cache and the coarse solution request (field/field_rays.h).
#include "field/field_rays.h"
#include "rays/prepared_scene.h"
#include "rays/ray_follower.h"

namespace rsphere {

// The most rays that a sensor (-I) may add to -ad plus -as where its gather is noisy. A draft with few -ad
// stays one although -as has its default.
double mostAddedAtSensors(const RayOptions& options);

// Implements FieldRays by a path.
class TracedFieldRays final : public FieldRays {
 public:
  // Keeps references. depth: of the ray that needs the light; it only matters for the limit on nesting.
  TracedFieldRays(const PreparedScene& prepared, RayFollower& path, int depth)
      : t_(prepared), path_(path), depth_(depth) {}

  GatheredLight gather(const GatherSite& site, double nearest, uint64_t seed) override;
  PatchLinks link(std::span<const PatchSite> sites, int rays, uint64_t seed) override;
  double clearance(const GatherSite& site, double farthest) override;
  Surroundings surroundings(const GatherSite& site) override;
  bool sees(const V3d& from, const V3d& to) override;
  bool smallObjectNear(const GatherSite& site, double side, double lift) override;

 private:
  const PreparedScene& t_;
  RayFollower& path_;
  int depth_;
};

}  // namespace rsphere
