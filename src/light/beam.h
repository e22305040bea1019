#pragma once
// Cones that hold all the light that leaves something through an opening.
#include "scene/shape.h"

namespace rsphere {

// A sphere around something (world units).
struct Ball {
  V3d center{0, 0, 0};
  double radius = 0;
};

// All directions, seen from a point that goes without saying, within an angle of an axis.
struct Beam {
  V3d axis{0, 0, 1};   // unit
  double cosine = -1;  // of the angle: -1, all directions; above 1, none

  // Whether anything in the ball may lie in the beam from apex, to within 1e-6 radians. Never false of a ball
  // of which a point lies in the beam.
  bool meets(const V3d& apex, const Ball& ball) const;
};

// The narrowest beam that holds, as seen from the center of `from`, every point that a straight ray reaches
// in or beyond `opening`, once it has left `from`.
Beam beamThrough(const Ball& from, const Ball& opening);

// A beam that holds all directions common to two with the same apex, and no wider than either. Two narrow
// beams without a common direction give one with none (cosine > 1).
Beam sharedBeam(const Beam& a, const Beam& b);

}  // namespace rsphere
