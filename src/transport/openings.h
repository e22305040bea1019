#pragma once
// Portals of daylight: panes with a bright side and a dark one, and holes in walls. A small window brings
// most of the light of a room, but few directions of a hemisphere hit it. A share of the rays of each gather
// is therefore aimed at openings and combined with the others by multiple importance sampling (balance
// heuristic: Veach and Guibas 1995). Openings that are missed or found in vain change the variance, not the
// mean.
//
// Source: Bitterli, Novák, Jarosz, "Portal-masked environment map sampling" (Computer Graphics Forum 34,
// 2015). Differences: portals are found automatically, and sampled by area.
#include <utility>
#include <vector>

#include "transport/proposals.h"
#include "transport/rectangle.h"
#include "transport/tuning.h"

namespace rsphere {

// One or more panes, or a hole, in a rectangle whose normal points to the dark side.
struct Opening : Rectangle {
  double filled = 0;  // area of the panes in it, or of the hole (square world units)
  bool isHole = false;
  double power = 0;  // mean radiance towards the dark side, times `filled`
};

class Openings {
 public:
  // See find_openings.h. inside: mean brightness (W/sr/m2) on their dark sides; depth: world units.
  Openings(std::vector<Opening> openings, double inside, double depth)
      : openings_(std::move(openings)), inside_(inside), depth_(depth) {}

  bool empty() const { return openings_.empty(); }
  // The mean brightness (W/sr/m2) behind the openings, on their dark sides.
  double inside() const { return inside_; }
  // The mean distance of the surfaces behind the openings (world units), a measure of the size of rooms.
  double depth() const { return depth_; }

  // An opening as seen from its dark side.
  struct View {
    Rectangle place;      // its normal points to the dark side
    double radiance = 0;  // W/sr/m2, mean
  };
  std::vector<View> views() const;

  // The sampling distribution for a point of a diffuse surface.
  struct Aim : Proposals<tuning::Caps::kAimedRoom> {
    double seen = 0;  // form factor from the point to all openings
  };

  // normal: unit, on the side that the light arrives at.
  void aim(const V3d& point, const V3d& normal, Aim& aim) const;

  // One of the aimed directions (unit) from the point, for uniform u1, u2, u3 in [0, 1); u1 chooses the
  // opening. REQUIRES aim.mean > 0.
  V3d sample(const Aim& aim, double u1, double u2, double u3) const;

  // The density of aimed directions, per sr.
  double density(const Aim& aim, const V3d& direction) const;

  // The projected area (square world units) of the openings for light that enters in this direction (unit);
  // and a point on them, uniform by projected area for uniform u1, u2, u3 in [0, 1). The point REQUIRES an
  // area above 0.
  double areaTowards(const V3d& direction) const;
  V3d pointTowards(const V3d& direction, double u1, double u2, double u3) const;

 private:
  std::vector<Opening> openings_;
  double inside_, depth_;
};

}  // namespace rsphere
