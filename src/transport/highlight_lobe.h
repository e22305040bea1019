#pragma once
#include <cmath>
#include <limits>

#include "base/constants.h"
#include "transport/source_parts.h"

namespace rsphere {

// A normal distribution of directions in two dimensions, projected from a plane.
class HighlightLobe {
 public:
  HighlightLobe() = default;
  // axis, x, y: orthonormal. xx, xy, yy: twice the covariance of the slopes along x and y.
  HighlightLobe(const V3d& axis, const V3d& x, const V3d& y, double xx, double xy, double yy)
      : axis_(axis),
        x_(x),
        y_(y),
        xx_(std::sqrt(xx)),
        yx_(xy / xx_),
        yy_(std::sqrt(std::max(yy - yx_ * yx_, 1e-12 * yy))) {}

  const V3d& axis() const { return axis_; }
  // A direction (unit) for uniform u1, u2 in [0, 1).
  V3d sample(double u1, double u2) const {
    const double radius = std::sqrt(-std::log1p(-u1)), angle = 2 * kPi * u2;
    const double x = radius * std::cos(angle), y = radius * std::sin(angle);
    return (axis_ + xx_ * x * x_ + (yx_ * x + yy_ * y) * y_).normalized();
  }
  // Per sr. 0 where it is less than exp(-most) of its peak.
  double density(const V3d& direction, double most = std::numeric_limits<double>::infinity()) const {
    const double cosine = direction.dot(axis_);
    if (!(cosine > 0)) return 0;
    const double x = direction.dot(x_) / (cosine * xx_);
    if (x * x > most) return 0;
    const double y = (direction.dot(y_) / cosine - yx_ * x) / yy_, away = x * x + y * y;
    return away > most ? 0 : std::exp(-away) / (kPi * xx_ * yy_ * cosine * cosine * cosine);
  }

 private:
  V3d axis_, x_, y_;     // unit
  double xx_, yx_, yy_;  // Cholesky factor
};

// How a surface bends where it mirrors.
struct Bend {
  double radius;  // of curvature (world units)
  // The direction (unit) in which it does not bend, such as a cylinder's axis; 0: none.
  V3d straight{0, 0, 0};
};

// The highlight of a part of a source on a rough curved surface, as seen from a point. The model: roughness
// is a property of the vector between the surface's normal and the bisector of the directions to the point
// and to the source. This vector and the two directions are approximated by linear functions of the place on
// the surface.
//
// Source of the model that defines the roughness: Ward, "Measuring and modeling anisotropic reflection"
// (SIGGRAPH 1992).
struct Highlight {
  // No direction is aimed where the density of a highlight is below exp(-kReach^2) of its peak, 1e-4. In
  // Ward's model that is where the angle between the normal and the bisector of the directions to point and
  // source exceeds this multiple of the roughness, apart from the source's extent.
  static constexpr double kReach = 3;
  // No rays are aimed at a ball or cylinder whose center or axis is nearer than this, in radii: on its
  // surface, the formulas divide by 0.
  static constexpr double kApart = 1.02;

  HighlightLobe lobe;  // tuning::Highlights::kWider times as wide as the highlight
  // The solid angle of the part's image if the surface were smooth, over that of the part seen from `at`.
  double magnified;
  // The variance of the place on the surface along the direction in which it does not bend (square world
  // units).
  double lengthwise;
  // The root of the determinant of the covariance of directions (sr).
  double spread;

  // at: the place on the surface that mirrors the middle of the part to the point (world). normal: the
  // surface's normal there (unit).
  Highlight(const V3d& at, const V3d& normal, const Bend& bend, double roughness, const SourcePart& part,
            const V3d& point);
};

// The material of a surface if it shows highlights: plastic or metal that is not smooth; otherwise null.
const Opaque* roughReflector(const Scene& scene, const Surface& surface);

// The share of the brightness of light that such a material reflects in highlights.
double reflectanceOf(const Opaque& material);

}  // namespace rsphere
