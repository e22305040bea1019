#include "silhouettes/silhouette_index.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rsphere {
namespace {

// The direction to a position on a face of the cube. The largest coordinate determines the face; u and v are
// the other two divided by it, -1 to 1.
V3d onFace(int face, double u, double v) {
  V3d d;
  const int axis = face / 2;
  d[axis] = face % 2 ? -1 : 1;
  d[(axis + 1) % 3] = u;
  d[(axis + 2) % 3] = v;
  return d.normalized();
}

// A cell, enclosed in a cap around its middle. radius: half angle of the cap, radians, with its cosine and
// sine.
struct Cell {
  V3d middle;
  double radius, cosine, sine;
};

template <int side>
std::array<Cell, 6 * side * side> cellsOf() {
  std::array<Cell, 6 * side * side> cells;
  const auto at = [](double k) { return 2 * k / side - 1; };
  for (int face = 0; face < 6; ++face)
    for (int i = 0; i < side; ++i)
      for (int j = 0; j < side; ++j) {
        Cell& cell = cells[static_cast<size_t>((face * side + i) * side + j)];
        cell.middle = onFace(face, at(i + .5), at(j + .5));
        double least = 1;
        for (const int corner : {0, 1, 2, 3})
          least = std::min(least, cell.middle.dot(onFace(face, at(i + corner % 2), at(j + corner / 2))));
        cell.radius = std::acos(least);
        cell.cosine = least;
        cell.sine = std::sin(cell.radius);
      }
  return cells;
}

}  // namespace

void SilhouetteIndex::add(uint32_t number, const Silhouette& silhouette) {
  static const auto kCells = cellsOf<kSide>();
  static const auto kFaces = cellsOf<1>();
  constexpr double kRounding = 1e-6;  // tolerance of a cosine, far above the errors of directions and caps
  const auto [axis, angle] = silhouette.surroundingCap();
  const double cosine = std::cos(angle), sine = std::sin(angle);
  // The angle between the middles is at most the sum of the half angles.
  const auto reaches = [&, axis = axis, angle = angle](const Cell& cell) {
    return angle + cell.radius >= std::numbers::pi ||
           axis.dot(cell.middle) >= cosine * cell.cosine - sine * cell.sine - kRounding;
  };
  for (size_t face = 0; face < kFaces.size(); ++face) {
    if (!reaches(kFaces[face])) continue;
    for (size_t i = face * kSide * kSide; i < (face + 1) * kSide * kSide; ++i)
      if (reaches(kCells[i])) cells_[i].push_back(number);
  }
}

std::span<const uint32_t> SilhouetteIndex::near(const V3d& d) const {
  const V3d size(std::abs(d.x), std::abs(d.y), std::abs(d.z));
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto place = [&](double x) {
    return std::clamp(static_cast<int>((x / size[axis] + 1) / 2 * kSide), 0, kSide - 1);
  };
  const int face = 2 * axis + (d[axis] < 0);
  return cells_[static_cast<size_t>((face * kSide + place(d[(axis + 1) % 3])) * kSide +
                                    place(d[(axis + 2) % 3]))];
}

}  // namespace rsphere
