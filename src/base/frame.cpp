#include "base/frame.h"

#include <cmath>

namespace rsphere {

void frame(const V3d& z, V3d& x, V3d& y) {
  const double sign = std::copysign(1., z.z);
  const double a = -1 / (sign + z.z);
  const double b = z.x * z.y * a;
  x = V3d(1 + sign * z.x * z.x * a, sign * b, -sign * z.x);
  y = V3d(b, sign + z.y * z.y * a, -z.y);
}

}  // namespace rsphere
