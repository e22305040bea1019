#pragma once
#include "openings/rectangle.h"

namespace rsphere {

// A rectangle as seen from a point: samples it uniformly by solid angle.
//
// Source: Ureña, Fajardo, King, "An Area-Preserving Parametrization for Spherical Rectangles" (Computer
// Graphics Forum 32, 2013).
class SphericalRectangle {
 public:
  SphericalRectangle(const V3d& point, const Rectangle& rectangle);

  // 0 if the rectangle is too small or too nearly edge-on to be sampled.
  double solidAngle() const { return solidAngle_; }
  // A direction (unit), for uniform u and v in [0, 1). REQUIRES solidAngle() > 0.
  V3d sample(double u, double v) const;

 private:
  struct Frame {
    V3d x, y, z;  // z points away from the rectangle
  };
  struct Sides {
    double x0, y0, x1, y1, z;  // in the frame, relative to the point
  };
  Frame frame_;
  Sides sides_;
  double b0_ = 0, b1_ = 0, turned_ = 0;
  double solidAngle_ = 0;
};

}  // namespace rsphere
