#pragma once
#include <span>
#include <vector>

#include "layout.h"

namespace grid {

// The values of a grid between its points: linear from each point to the middles between it and its
// neighbours, and constant from the outer points to the borders of their cells.
class Field {
 public:
  // values: one for each point.
  Field(const Grid& grid, std::span<const double> values);

  // Where the value is at least `level`, within the cells that have points: closed outlines, with holes in
  // the opposite sense.
  std::vector<std::vector<V2d>> region(double level) const;

  // The lines on which the value is `level`. The first point of a closed line is also its last.
  std::vector<std::vector<V2d>> isolines(double level) const;

 private:
  using Place = std::pair<int, int>;  // a node twice, or two nodes with the level between them
  using Step = std::pair<Place, Place>;
  template <class Use>
  void forEachPiece(double level, Use use) const;
  std::vector<std::vector<V2d>> join(const std::vector<Step>& steps, double level) const;
  V2d at(int node) const;

  const Grid& grid_;
  int width_;                  // nodes in a row: two to a cell, and one
  std::vector<double> nodes_;  // the values; only those of cells with points are used
};

// Round values between the smallest and the largest of these: EN 12464-1's scale of illuminances (1, 1.5, 2,
// 3, 5, 7.5, 10, ...). If there are ten values or more, the lowest and the highest 2% (at least one of each)
// have no levels of their own: one point inside of furniture would take half of the levels. Below what a
// twentieth of the lit points has, there are two at most. If nine tenths of the values span less than a
// factor of 4, equal steps divide their range. Ascending, at most 14, none if all values are equal.
// REQUIRES: at least one value.
std::vector<double> roundLevels(std::span<const double> values);

}  // namespace grid
