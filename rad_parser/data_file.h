#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace rad {

// A table of numbers over a rectangular grid of n dimensions, as data files (.dat) have it. Immutable.
//
//   n, then for each axis "first last count" of even divisions or "0 0 count" and as many divisions, then the
//   values, the last axis running fastest. White space separates; '#' begins a comment.
// Source: RADIANCE file formats, "Data File Format". Numbers are kept in single precision, as the original
// keeps them.
class DataFile {
 public:
  static constexpr size_t kMaxDimensions = 10;  // 1024 values for one answer; the original has 6

  // Throws Error "NAME:LINE: ..": a number that is missing or none, fewer than two divisions, divisions that
  // neither rise nor fall strictly, fewer values than the grid has. What follows the values is not read.
  static DataFile parse(std::string_view text, std::string_view name);

  size_t dimensions() const { return axes_.size(); }

  // The value at a point of dimensions() coordinates: linear along each axis between divisions, and up to one
  // division beyond the ends; further out it falls towards 0 with the inverse of the distance. With u the
  // position in divisions and 0 and n-1 the ends, the weights of the two values at an end are then
  //   below -1:  2/-u and -1/-u of the first and second;
  //   above n:   2/(u-n+3) and -1/(u-n+3) of the last and the one before.
  // The latter is a step down by a factor of 3 at u = n: so the original has it, and scenes were made with
  // it. Weights within 1e-6 of 0 count as 0. Thread-safe.
  double value(std::span<const double> point) const;

 private:
  struct Axis {
    float first = 0, span = 0;  // even divisions: of the whole axis
    size_t count = 0;
    std::vector<float> points;  // uneven divisions, else empty
  };
  struct Weights {
    size_t index;  // of the first of two neighbours
    double first, second;
  };

  static Weights weights(const Axis& axis, double coordinate);
  double sum(std::span<const Weights> along, size_t axis, const float* from, size_t stride,
             double weight) const;

  std::vector<Axis> axes_;
  std::vector<float> values_;
};

}  // namespace rad
