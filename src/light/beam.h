#pragma once
// Cones that bound the directions of light behind an opening.
#include "scene/shape.h"

namespace rsphere {

// A sphere around something (world units).
struct Ball {
  V3d center{0, 0, 0};
  double radius = 0;
};

// The directions within an angle of an axis. The apex of the cone is given elsewhere.
struct Beam {
  V3d axis{0, 0, 1};   // unit
  double cosine = -1;  // of the angle: -1, all directions; above 1, none

  // Whether a point of the ball lies in the beam from apex. May also be true for a ball that is up to 1e-6
  // radians outside the beam.
  bool meets(const V3d& apex, const Ball& ball) const;
};

// A beam from the center of `from` that contains every point that a straight ray from a point of `from`
// reaches inside or behind `opening`.
Beam beamThrough(const Ball& from, const Ball& opening);

// A beam that contains the intersection of two beams with the same apex, and is no wider than either. If two
// narrow beams do not overlap, it contains no direction (cosine > 1).
Beam sharedBeam(const Beam& a, const Beam& b);

}  // namespace rsphere
