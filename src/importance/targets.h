#pragma once
// Chooses regions of the sphere that get extra directions at a point, and the number of these directions.
#include <span>
#include <vector>

#include "importance/contrasts.h"
#include "importance/direction_sample.h"
#include "importance/glints.h"
#include "importance/silhouette_index.h"
#include "transport/bright_spots.h"
#include "transport/openings.h"

namespace rsphere {

// A special object, or the image of a light source in one, that gets directions of its own.
struct Target {
  Silhouette silhouette;
  double density = 0;      // of the directions aimed at it, per sr of its region
  double expected = 0;     // expected number of those directions
  bool continues = false;  // part of the same image as the target before it
  // Whether cells are fitted to its solid angle (cells_in_targets.h). No two of these targets overlap.
  bool fitted = false;
  // Whether cells keep to its edge, so that the edge adds no variance: it is fitted, or has more directions
  // of its own than base directions.
  bool hasOwnEdge = false;
};

// The targets of one point.
class Targets {
 public:
  explicit Targets(std::vector<Target> targets);

  std::span<const Target> all() const { return targets_; }

  // The targets that contain a direction (unit).
  struct Region {
    double density = 0;   // of their own directions there, per sr
    RegionId id = 0;      // identifies the set of targets with an edge of their own; 0: in none of these
    uint32_t fitted = 0;  // 1 + the position in all() of the one that is fitted; 0: none is
  };
  Region regionAt(const V3d& direction) const;

 private:
  std::vector<Target> targets_;
  SilhouetteIndex index_;  // of targets_, by position
};

// Chooses the targets at any point. Shared by all threads; keeps references to the prepared scene and to
// bright spots.
class TargetChoice {
 public:
  // Measures how much radiance varies on the objects (contrasts.h). sources: those integrated separately.
  // densityFactor: -Sk.
  TargetChoice(const SphereTracing& tracing, std::span<const SpecialObject> objects,
               const SeenSources& sources, double densityFactor);

  // The targets at a point (world): special objects, images of light sources in them, openings that show
  // daylight (transport/openings.h), and visible spots of daylight (transport/bright_spots.h). Extra
  // directions raise the density on each target to Neyman's allocation, in proportion to the standard
  // deviation of the radiance on it. The density of base directions is assumed to be optimal elsewhere. If
  // that needs more than `most` directions on average, all densities are reduced by the same factor, so that
  // no target is dropped. meanBrightness: of the view from the point, W/sr/m2.
  Targets at(const V3d& point, double meanBrightness, size_t baseDirections, size_t most) const;

 private:
  const PreparedScene& prepared_;
  std::span<const BrightSpots::Sunlit> sunlit_;
  std::vector<Openings::View> openings_;  // openings without special objects in them
  // For each of contrasts_.objects: the mean radiance of the opening that it lies in, as seen from the dark
  // side, W/sr/m2; 0 if it lies in none.
  std::vector<double> radiances_;
  double densityFactor_;
  Contrasts contrasts_;
  HiddenBoxes hidden_;  // the boxes around contrasts_.objects
  Glints glints_;
};

}  // namespace rsphere
