#include "base/primaries.h"

#include <algorithm>

namespace rsphere {

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j)
      for (size_t k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
  return c;
}

V3d product(const Matrix& a, const V3d& v) {
  return V3d(a[0][0] * v.x + a[0][1] * v.y + a[0][2] * v.z, a[1][0] * v.x + a[1][1] * v.y + a[1][2] * v.z,
             a[2][0] * v.x + a[2][1] * v.y + a[2][2] * v.z);
}

double determinant(const Matrix& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

Matrix inverse(const Matrix& m) {
  const double d = determinant(m);
  Matrix r{};
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) {
      const size_t a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, e = (i + 2) % 3;
      r[i][j] = (m[a][c] * m[b][e] - m[a][e] * m[b][c]) / d;
    }
  return r;
}

V3d xyzOfChromaticity(double x, double y) { return V3d(x / y, 1, (1 - x - y) / y); }

Matrix xyzFromRgb(const Primaries& p) {
  Matrix columns{};
  for (size_t i = 0; i < 3; ++i) {
    columns[0][i] = p[2 * i];
    columns[1][i] = p[2 * i + 1];
    columns[2][i] = 1 - p[2 * i] - p[2 * i + 1];
  }
  const V3d units = product(inverse(columns), xyzOfChromaticity(p[6], p[7]));
  for (auto& row : columns) {
    row[0] *= units.x;
    row[1] *= units.y;
    row[2] *= units.z;
  }
  return columns;
}

V3d intoGamut(const V3d& color, double luminance) {
  if (luminance < 0) return V3d(0, 0, 0);
  double share = 1;
  for (const double channel : {color.x, color.y, color.z})
    if (channel < 0) share = std::min(share, luminance / (luminance - channel));
  return share < 1 ? color * share + V3d(luminance) * (1 - share) : color;
}

}  // namespace rsphere
