#pragma once
// Highlights of light sources on rough cylinders, such as chrome legs of chairs, rails and pipes. Like those
// on balls (ball_highlights.h), they are far smaller and brighter than the object. A highlight is visible at
// the place where the directions to the point and to the source make equal angles with the axis; if this
// place lies beyond an end, there is no highlight. Unlike highlights on balls, they are therefore searched
// for each point separately.
#include "openings/proposals.h"
#include "openings/tuning.h"
#include "spots/brightest_sources.h"
#include "spots/highlight_choice.h"
#include "spots/reach_grid.h"

namespace rsphere {

class CylinderHighlights {
 public:
  // Uses cylinders and tubes of plastic or metal, seen from outside. Shadow rays find the sources that each
  // cylinder sees. Keeps a reference to lights. least: see aim(); above 0. Points at which a cylinder's
  // highlights add less than this to the variance ignore the cylinder.
  CylinderHighlights(const Scene& scene, const Tracer& tracer, const LightSources& lights, double least);

  bool empty() const { return cylinders_.empty(); }
  static constexpr size_t kRoom = tuning::Caps::kAimed / 2;

  // The sampling distribution for a point of a diffuse surface. Each element represents the highlight of one
  // part of a source on one cylinder.
  struct Aim : Proposals<kRoom> {
    std::array<HighlightLobe, kRoom> lobe;
  };

  // front: unit normal. least: threshold (square of W/sr/m2) for the estimated variance that all highlights
  // together add to the radiance from one direction, if directions are sampled by projected solid angle.
  // Below the threshold, no direction is aimed at highlights.
  void aim(const V3d& point, const V3d& front, double least, Aim& aim) const;

  // See Highlights (highlights.h).
  V3d sample(const Aim& aim, double u1, double u2, double u3) const;
  double density(const Aim& aim, const V3d& direction) const;

 private:
  struct Part {
    LightingPart lighting;
    double radiance;  // brightness of the part's image, W/sr/m2
    double hot;       // the part's contribution to Cylinder::hot
  };
  struct Cylinder {
    Cone shape;
    double roughness = 0;
    // Upper bound on the variance that its highlights add to the radiance from a direction sampled by
    // projected solid angle, times the distance from the cylinder (W2/sr2/m4 * world units).
    double hot = 0;
    std::vector<Part> parts;
  };

  static Cylinder lit(const Cone& shape, const Opaque& material, const Tracer& tracer,
                      const BrightestSources& sources);
  static bool meets(const Cone& cylinder, const V3d& point, const V3d& direction);

  std::vector<Cylinder> cylinders_;
  ReachGrid near_;
};

}  // namespace rsphere
