#pragma once
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace rad {

// A table of numbers on a rectangular grid of n dimensions, from a data file (.dat). Immutable.
//
// The file contains n; for each axis "first last count" for evenly spaced divisions, or "0 0 count" followed
// by `count` divisions; and then the values, with the index of the last axis varying fastest. Numbers are
// separated by white space; '#' begins a comment. As in RADIANCE, numbers are stored in single precision.
// Source: RADIANCE file formats, "Data File Format".
class DataFile {
 public:
  // An interpolation uses up to 2^10 values. RADIANCE allows 6 dimensions.
  static constexpr size_t kMaxDimensions = 10;

  // Throws Error "NAME:LINE: .." for a missing or malformed number, fewer than two divisions, divisions that
  // are neither strictly increasing nor strictly decreasing, and fewer values than grid points. Text after
  // the values is ignored.
  static DataFile parse(std::string_view text, std::string_view name);

  size_t dimensions() const { return axes_.size(); }

  // The divisions of an axis: their number, the first and the last one, and whether they are evenly spaced.
  struct Divisions {
    size_t count = 0;
    double first = 0, last = 0;
    bool even = true;
  };
  Divisions divisions(size_t axis) const;
  // The divisions of an axis if they are unevenly spaced, otherwise empty.
  std::span<const float> unevenDivisions(size_t axis) const { return axes_[axis].points; }

  // The value at a point with dimensions() coordinates. It is interpolated linearly along each axis, and
  // extrapolated linearly by up to one division beyond the ends. Farther out it falls towards 0 with the
  // inverse of the distance. Let u be the position in units of divisions, with the ends at 0 and n-1. The
  // weights of the two values at an end are then
  //   below -1:  2/-u and -1/-u for the first and the second;
  //   above n:   2/(u-n+3) and -1/(u-n+3) for the last and the one before it.
  // The weights above n drop by a factor of 3 at u = n. This is RADIANCE's rule, with which existing scenes
  // were made. Weights within 1e-6 of 0 are treated as 0. Thread-safe.
  double value(std::span<const double> point) const;

 private:
  struct Axis {
    float first = 0, span = 0;  // even divisions: the first one, and the length of the axis
    size_t count = 0;
    std::vector<float> points;  // uneven divisions; otherwise empty
  };
  struct Weights {
    size_t index;  // of the first of two neighbouring divisions
    double first, second;
  };

  static Weights weights(const Axis& axis, double coordinate);
  double sum(std::span<const Weights> along, size_t axis, const float* from, size_t stride,
             double weight) const;

  std::vector<Axis> axes_;
  std::vector<float> values_;
};

}  // namespace rad
