#include "base/primaries.h"

#include <algorithm>

namespace rsphere {

V3d xyzOfChromaticity(double x, double y) { return V3d(x / y, 1, (1 - x - y) / y); }

M33d xyzFromRgb(const Primaries& p) {
  M33d rows;
  for (size_t i = 0; i < 3; ++i) {
    const V3d row(p[2 * i], p[2 * i + 1], 1 - p[2 * i] - p[2 * i + 1]);
    for (int j = 0; j < 3; ++j) rows[static_cast<int>(i)][j] = row[j];
  }
  const V3d units = xyzOfChromaticity(p[6], p[7]) * rows.inverse();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) rows[i][j] *= units[i];
  return rows;
}

V3d intoGamut(const V3d& color, double luminance) {
  if (luminance < 0) return V3d(0, 0, 0);
  double share = 1;
  for (const double channel : {color.x, color.y, color.z})
    if (channel < 0) share = std::min(share, luminance / (luminance - channel));
  return share < 1 ? color * share + V3d(luminance) * (1 - share) : color;
}

}  // namespace rsphere
