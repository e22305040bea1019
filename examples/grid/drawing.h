#pragma once
#include <span>
#include <string>
#include <vector>

#include "isolines.h"

namespace grid {

// The illuminances (lx) of a grid, by the names of EN 12464-1. REQUIRES: at least one value.
struct Summary {
  explicit Summary(std::span<const double> values);
  double overallUniformity() const { return average > 0 ? smallest / average : 0; }  // U_o
  double diversity() const { return largest > 0 ? smallest / largest : 0; }          // U_d
  double average = 0, smallest = 0, largest = 0;
};

struct Drawing {
  std::string title;
  std::vector<std::string> remarks;  // lines below the plan
  std::vector<double> levels;        // of the isolines (lx), ascending
  std::vector<Ring> context;         // outlines of other surfaces
  bool values = false;               // write the value at each point
  std::string unit = "lx";
};

// An illuminance with three significant digits, or all digits before the point: "0.125", "12.5", "1250".
std::string luxText(double lux);

// The plan as one SVG file: bands of color between the levels, isolines with their labels, outline, axes in
// units of the scene, legend.
std::string planAsSvg(const Area& area, const Grid& grid, std::span<const double> values,
                      const Drawing& drawing);

}  // namespace grid
