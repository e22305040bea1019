#include "base/frame.h"

#include <cmath>

namespace rsphere {

std::pair<V3d, V3d> frame(const V3d& z, double length) {
  const double sign = std::copysign(1., z.z);
  const double a = -1 / (sign + z.z);
  const double b = z.x * z.y * a;
  return {length * V3d(1 + sign * z.x * z.x * a, sign * b, -sign * z.x),
          length * V3d(b, sign + z.y * z.y * a, -z.y)};
}

}  // namespace rsphere
