#pragma once
// Cones that bound the directions of the light that comes through an opening.
#include "scene/shape.h"

namespace rsphere {

// A bounding sphere (world units).
struct Ball {
  V3d center{0, 0, 0};
  double radius = 0;
};

// A cone of directions. The caller supplies its apex.
struct Beam {
  V3d axis{0, 0, 1};   // unit
  double cosine = -1;  // of the half-angle; -1: all directions; above 1: no direction

  // True if a point of the ball lies in the beam from this apex. May also be true for a ball that is up to
  // 1e-6 radians outside the beam.
  bool meets(const V3d& apex, const Ball& ball) const;
};

// A beam with its apex at the center of `from`. It contains every point inside or behind `opening` that a
// straight ray from a point of `from` can reach.
Beam beamThrough(const Ball& from, const Ball& opening);

// A beam that contains the intersection of two beams with the same apex, and is no wider than either. If two
// narrow beams do not overlap, the result contains no direction (cosine > 1).
Beam sharedBeam(const Beam& a, const Beam& b);

}  // namespace rsphere
