#pragma once
// Chooses the regions of the sphere that get extra directions at a point, and how many.
#include <span>
#include <vector>

#include "points/direction_sample.h"
#include "silhouettes/silhouette_index.h"
#include "targets/contrasts.h"
#include "targets/daylight_targets.h"
#include "targets/glints.h"
#include "targets/special_targets.h"

namespace rsphere {

// A region of the sphere of directions that gets extra directions.
struct Target {
  Silhouette silhouette;
  double density = 0;      // extra directions per sr of its region
  double expected = 0;     // expected number of extra directions
  bool continues = false;  // part of one image together with the preceding target
  // Whether cells are fitted to its solid angle (cells_in_targets.h). Fitted targets do not overlap.
  bool fitted = false;
  // Whether cells end at its edge, so that the edge adds no variance: true if the target is fitted, or gets
  // more extra directions than base directions.
  bool hasOwnEdge = false;
  double least = 0;  // the part of the density that an opening keeps if densities are reduced
};

// The targets of one point.
class Targets {
 public:
  explicit Targets(std::vector<Target> targets);

  std::span<const Target> all() const { return targets_; }

  // The targets that contain a direction (unit).
  struct Region {
    double density = 0;   // of their extra directions there, per sr
    RegionId id = 0;      // identifies the combination of targets with hasOwnEdge; 0: no such target
    uint32_t fitted = 0;  // 1 + the position in all() of the fitted target; 0: none is fitted
  };
  Region regionAt(const V3d& direction) const;

 private:
  std::vector<Target> targets_;
  SilhouetteIndex index_;  // of targets_, by position
};

// Chooses the targets at any point. Shared by all threads; keeps references.
class TargetChoice {
 public:
  // Measures how much radiance varies on the objects (contrasts.h). sources: those integrated separately.
  // densityFactor: -Sk.
  TargetChoice(const SphereTracing& tracing, std::span<const SpecialObject> objects,
               const SeenSources& sources, double densityFactor);

  // The targets at a point (world). The density on a target is in proportion to the standard deviation of its
  // radiance (Neyman's allocation), relative to the base directions, whose density is assumed to be optimal
  // elsewhere. If this takes more than `most` extra directions on average, all densities beyond the least of
  // openings are reduced by one factor, so that no target is dropped. meanBrightness: of the view from the
  // point, W/sr/m2.
  Targets at(const V3d& point, double meanBrightness, size_t baseDirections, size_t most) const;

 private:
  double densityFactor_;
  Contrasts contrasts_;
  // All ways to find targets.
  TargetFinders<SpecialTargets, Glints, MirroredOpenings, CurvedImages, OpeningTargets, SunlitTargets>
      finders_;
};

}  // namespace rsphere
