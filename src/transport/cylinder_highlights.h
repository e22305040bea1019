#pragma once
// Highlights of light sources on rough cylinders: chrome legs of chairs, rails and pipes. As on balls
// (ball_highlights.h), they are far smaller and brighter than the cylinder, but a cylinder does not send the
// light of a source in all directions: as seen from a point, the highlight lies where the directions to both
// make equal angles with the axis, or beyond the ends. Each highlight is therefore found for each point.
#include "transport/highlight_choice.h"
#include "transport/proposals.h"
#include "transport/reach_grid.h"
#include "transport/tuning.h"

namespace rsphere {

class CylinderHighlights {
 public:
  // Uses cylinders and tubes of plastic or metal, seen from outside. Shadow rays find which sources each of
  // them sees. Keeps a reference to lights. least: nothing is aimed at where a cylinder's highlights add less
  // than this to the variance, as for aim(); above 0.
  CylinderHighlights(const Scene& scene, const Tracer& tracer, const LightSources& lights, double least);

  bool empty() const { return cylinders_.empty(); }
  static constexpr size_t kRoom = tuning::Caps::kAimedRoom / 2;

  // The sampling distribution for a point of a diffuse surface. Each element is the highlight of a part of a
  // source on a cylinder.
  struct Aim : Proposals<kRoom> {
    std::array<HighlightLobe, kRoom> lobe;
  };

  // front: unit normal. least: threshold below which nothing is aimed at (square of W/sr/m2). It is compared
  // with the variance that all highlights together are estimated to add to the radiance from a direction
  // drawn by projected solid angle.
  void aim(const V3d& point, const V3d& front, double least, Aim& aim) const;

  // As in Highlights (highlights.h).
  V3d sample(const Aim& aim, double u1, double u2, double u3) const;
  double density(const Aim& aim, const V3d& direction) const;

 private:
  struct Part {
    LightingPart lighting;
    double radiance;  // brightness of the part's image, W/sr/m2
    double hot;       // upper bound, as `Cylinder::hot`
  };
  struct Cylinder {
    Cone shape;
    double roughness = 0;
    // Upper bound of the variance that its highlights add to the radiance from a direction drawn by projected
    // solid angle, times the distance from the cylinder (W2/sr2/m4 * world units).
    double hot = 0;
    std::vector<Part> parts;
  };

  static Cylinder lit(const Cone& shape, const Opaque& material, const Scene& scene, const Tracer& tracer,
                      const LightSources& lights);
  static bool meets(const Cone& cylinder, const V3d& point, const V3d& direction);

  std::vector<Cylinder> cylinders_;
  ReachGrid near_;
};

}  // namespace rsphere
