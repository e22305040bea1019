#pragma once
#include <Imath/ImathVec.h>

#include <cmath>
#include <utility>

namespace rsphere {

using Imath::V3d;

// Two unit vectors x and y that form a right-handed orthonormal frame with the unit vector z (Duff et al.
// 2017, JCGT 6/1), multiplied by a length.
inline std::pair<V3d, V3d> frame(const V3d& z, double length = 1) {
  const double sign = std::copysign(1., z.z);
  const double a = -1 / (sign + z.z);
  const double b = z.x * z.y * a;
  return {length * V3d(1 + sign * z.x * z.x * a, sign * b, -sign * z.x),
          length * V3d(b, sign + z.y * z.y * a, -z.y)};
}

}  // namespace rsphere
