#pragma once
#include <cmath>
#include <limits>

#include "base/constants.h"
#include "spots/source_parts.h"
#include "spots/tuning.h"

namespace rsphere {

// A normal distribution in a plane perpendicular to the axis, at distance 1, as a distribution of directions.
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
  // The density per sr. Densities below exp(-most) times the peak are returned as 0.
  double density(const V3d& direction, double most = std::numeric_limits<double>::infinity()) const {
    const double cosine = direction.dot(axis_);
    if (!(cosine > 0)) return 0;
    const double x = direction.dot(x_) / (cosine * xx_);
    if (x * x > most) return 0;
    const double y = (direction.dot(y_) / cosine - yx_ * x) / yy_, away = x * x + y * y;
    return away > most ? 0 : std::exp(-away) / (kPi * xx_ * yy_ * cosine * cosine * cosine);
  }

 private:
  V3d axis_, x_, y_;     // unit vectors
  double xx_, yx_, yy_;  // Cholesky factor of the covariance
};

// The curvature of a surface at the place of the reflection.
struct Bend {
  double radius;  // of curvature (world units)
  // The direction (unit) in which the surface is straight, such as a cylinder's axis; 0: none.
  V3d straight{0, 0, 0};
};

// The highlight of a part of a source on a rough curved surface, as seen from a point. In the model, the
// roughness determines the distribution of the vector between the surface's normal and the bisector of the
// directions to the point and to the source. This vector and the two directions are approximated by linear
// functions of the place on the surface.
//
// Source: Ward, "Measuring and modeling anisotropic reflection" (SIGGRAPH 1992), which defines the roughness.
struct Highlight {
  HighlightLobe lobe;  // wider than the highlight by the factor tuning::Highlights::kWider
  // The solid angle of the part's image on a smooth surface, divided by the solid angle of the part as seen
  // from `at`.
  double magnified;
  // The variance of the highlight along the direction in which the surface is straight (square world units).
  double lengthwise;
  // The square root of the determinant of the covariance of the directions (sr).
  double spread;

  // at: the place on the surface that mirrors the middle of the part towards the point (world). normal: the
  // normal of the surface there (unit).
  Highlight(const V3d& at, const V3d& normal, const Bend& bend, double roughness, const SourcePart& part,
            const V3d& point);
};

// The material of a surface that shows highlights: plastic or metal with a roughness above 0. Null for
// others.
const Opaque* roughReflector(const Scene& scene, const Surface& surface);

// The fraction of the light, by brightness, that plastic or metal reflects in highlights.
double reflectanceOf(const Opaque& material);

}  // namespace rsphere
