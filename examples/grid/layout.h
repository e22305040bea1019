#pragma once
#include <span>
#include <string>
#include <vector>

#include "area.h"

namespace grid {

// Points at the centres of equal cells, in rows and columns. A cell has a point if it lies inside the area.
struct Grid {
  static constexpr int kNone = -1;

  int columns = 0, rows = 0;
  V2d corner;                // of the first cell
  V2d across, upwards;       // from a cell to the next of its row, and of its column
  std::vector<int> pointOf;  // of each cell, row by row: an index of points, or kNone
  std::vector<V2d> points;

  V2d at(double column, double row) const { return corner + across * column + upwards * row; }
  // The point of a cell; kNone beyond the rows and columns, too.
  int point(int column, int row) const {
    return column < 0 || row < 0 || column >= columns || row >= rows ? kNone
                                                                     : pointOf[row * columns + column];
  }
};

// The largest spacing that EN 12464-1 allows on an area of these sides (m): .2 * 5^log10(d), at most 10,
// where d is the longer side, or the shorter one if the longer is at least twice as long.
double standardSpacing(double length, double width);

// A grid parallel to the sides of the smallest rectangle around the area. The cells fill this rectangle,
// without a band of the width `margin` along its sides; the spacing is at most `spacing`, or that of
// standardSpacing() if it is 0. Points are at least margin + half a spacing away from every edge; both may
// differ by a thousandth for rounding. Throws rad::Error if there is no such point, and if there were more
// than a million cells.
Grid layGrid(const Area& area, double spacing, double margin);

// The grid without the points that are not kept. REQUIRES: one flag for each point.
Grid withOnly(const Grid& grid, const std::vector<bool>& kept);

}  // namespace grid
