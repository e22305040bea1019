#pragma once
// The estimate of the light that leaves a surface towards the origin of a ray, in one place.
#include "light_paths/owners.h"
#include "light_paths/vertex_light.h"
#include "rays/ray_follower.h"
#include "shade/material_response.h"
#include "transport/direct_light.h"
#include "transport/indirect_light.h"
#include "transport/specular_light.h"

namespace rsphere {

class OutgoingLight : PathPart {
 public:
  explicit OutgoingLight(const PathPart& path);

  // Each function adds light to the result of a ray (W/sr/m2) that has hit the surface: the light that the
  // surface emits, and the light that it scatters.
  void addEmitted(const RayEnd& end, const Emits& emits, RayResult& result);
  template <ScattersLight S>
  void addScattered(RayEnd& end, S& scattering, RayResult& result);

  // Whether a ray leaves through a portal (portals.h). REQUIRES that paths from both ends are used.
  bool leavesThroughPortal(const RayEnd& end) const;
  // Whether it ends there: the place that it comes from is already connected with the portal, and thereby
  // gets all light from beyond it.
  bool endsAtPortal(const RayEnd& end) const;

  DirectLight direct;
  SpecularLight specular;
  IndirectLight indirect;

 private:
  // Who estimates the light that a surface reflects (owners.h).
  struct Owners {
    Owner ofSources = Owner::eye, highlight = Owner::eye, indirect = Owner::eye;
    // Factor on the light that is left to paths from the eye although others own the known light; 0: they are
    // not followed here.
    double rest = 1;
  };
  Owners ownersAt(const RayEnd& end);
  double restOf(const RayEnd& end, Owner indirect);
  void addFromSource(const RayEnd& end, const V3d& normal, Shown shown, Radiance& value);
  void addFromVertices(const RayEnd& end, const V3d& normal, const Coefficient& coefficient, Radiance& value);
  template <ScattersLight S>
  bool addLobe(const RayEnd& end, S& scattering, Component c, bool mayShare, RayResult& result);
  template <ScattersLight S>
  void addDirect(const RayEnd& end, const V3d& point, S& scattering, Component side, const Owners& owners,
                 bool shares, int gathered, Radiance& value);
  int drawsOfDirect(const RayEnd& end, int gathered) const;

  VertexLight::Scratch scratch_;
};

}  // namespace rsphere
