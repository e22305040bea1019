#pragma once
// Openings (openings.h) as the light sources of paths from both ends. A path from the eye that leaves through
// a portal, from its dark side to its bright side, ends there: all light from beyond is treated as light of
// the portal. Thus no light is counted twice, whatever is outdoors. A portal lies a little outside of its
// opening, so that a pane in the opening belongs to the room despite rounding, or a little inside, so that
// the pane is outdoors.
#include <span>
#include <vector>

#include "base/random.h"
#include "openings/openings.h"
#include "openings/spherical_rectangle.h"

namespace rsphere {

class Portals {
 public:
  Portals() = default;
  // size: the largest side of the scene's box (world units). samePlace: Scene::samePlace.
  Portals(const Openings& openings, double size, double samePlace);

  bool empty() const { return portals_.empty(); }
  std::span<const Opening> all() const { return portals_; }
  // The distance of the portals from their openings (world units); on the bright side, unless moved.
  double lift() const { return lift_; }
  void moveIndoors(size_t portal) { portals_[portal].corner += 2 * lift_ * portals_[portal].normal; }

  // The distance at which a straight line first leaves through a portal; kFarAway if it does not within
  // `farthest`.
  double leaving(const V3d& origin, const V3d& direction, double farthest) const;
  // Whether it leaves through one.
  bool lineLeaves(const V3d& origin, const V3d& direction, double farthest) const {
    return leaving(origin, direction, farthest) < farthest;
  }

 private:
  std::vector<Opening> portals_;
  double lift_ = 0;
};

// Directions from a place to portals. A portal is selected by its estimated light, a direction to it by solid
// angle. Where one portal is behind another, the densities of both are added (balance heuristic).
class PortalDirections {
 public:
  // normal: unit. Keeps a reference to the portals.
  PortalDirections(const Portals& portals, const V3d& point, const V3d& normal);

  struct Sample {
    V3d direction;     // unit
    double share = 0;  // weight in the mean over the hemisphere; 0: no portal is visible above the horizon
  };
  Sample draw(Random& random) const;

 private:
  struct Seen {
    const Opening* portal;
    SphericalRectangle shape;
    double upTo;  // cumulative probability
  };
  double density(const V3d& direction, const Seen& chosen) const;

  V3d point_, normal_;
  std::vector<Seen> seen_;
};

}  // namespace rsphere
