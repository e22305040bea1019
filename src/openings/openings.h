#pragma once
// Portals of daylight: panes with a bright and a dark side, and holes in walls. A small window provides most
// of the light in a room, but few directions of a hemisphere hit it. Some rays of each gather are therefore
// aimed at openings, with multiple importance sampling (balance heuristic: Veach and Guibas 1995). Missing or
// wrong openings change the variance, not the mean.
//
// Source: Bitterli, Novák, Jarosz, "Portal-masked environment map sampling" (Computer Graphics Forum 34,
// 2015). Differences: portals are found automatically, and sampled by area.
#include <span>
#include <utility>
#include <vector>

#include "openings/light_finder.h"
#include "openings/proposals.h"
#include "openings/rectangle.h"
#include "openings/tuning.h"

namespace rsphere {

// Panes or a hole, with their bounding rectangle. Its normal points to the dark side, which receives light
// through the opening.
struct Opening : Rectangle {
  double filled = 0;  // area of its panes or of the hole (square world units)
  bool isHole = false;
  double power = 0;  // mean radiance towards the dark side, times `filled`
};

class Openings {
 public:
  // Made by findOpenings(). inside, depth: results of the functions inside() and depth().
  Openings(std::vector<Opening> openings, double inside, double depth)
      : openings_(std::move(openings)), inside_(inside), depth_(depth) {}

  bool empty() const { return openings_.empty(); }
  // The mean brightness (W/sr/m2) behind the openings, on their dark sides.
  double inside() const { return inside_; }
  // The mean distance of the surfaces behind the openings (world units), as a measure of the size of rooms.
  double depth() const { return depth_; }

  // An opening as seen from its dark side.
  struct View {
    Rectangle place;      // its normal points to the dark side
    double radiance = 0;  // W/sr/m2, mean
  };
  std::vector<View> views() const;

  // The sampling distribution for a point of a diffuse surface.
  struct Aim : Proposals<tuning::Caps::kAimed> {
    double seen = 0;  // form factor from the point to all openings
  };

  // See LightFinder. u1 selects the opening.
  static constexpr AimedAt kKind = AimedAt::openings;
  void aim(const AimFrom& from, Aim& aim) const;
  V3d sample(const Aim& aim, double u1, double u2, double u3) const;
  double density(const Aim& aim, const V3d& direction) const;

  std::span<const Opening> all() const { return openings_; }

 private:
  std::vector<Opening> openings_;
  double inside_, depth_;
};

}  // namespace rsphere
