#include "rad_parser/tables/data_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "rad_parser/tables/number_list.h"

namespace rad {

DataFile DataFile::parse(std::string_view text, std::string_view name) {
  NumberList numbers(text, name);
  DataFile data;
  const auto finite = [&](std::string_view what) {
    const auto value = static_cast<float>(numbers.real(what));
    if (!std::isfinite(value)) numbers.fail(fmt::format("{} is too large", what));
    return value;
  };
  data.axes_.resize(static_cast<size_t>(numbers.integer(
      fmt::format("a number of dimensions from 1 to {}", kMaxDimensions), 1, int64_t{kMaxDimensions})));
  size_t size = 1;
  for (Axis& axis : data.axes_) {
    axis.first = finite("an axis' begin");
    axis.span = finite("an axis' end") - axis.first;
    // Every division has values. A count that exceeds the rest of the file is therefore an error, reported
    // before memory is allocated.
    axis.count = static_cast<size_t>(numbers.integer("a number of divisions, 2 at least", 2, INT32_MAX));
    if (size > numbers.left() / axis.count) numbers.fail("fewer values in the file than its grid has points");
    size *= axis.count;
    if (axis.span != 0) continue;
    for (size_t i = 0; i < axis.count; ++i) axis.points.push_back(finite("a division"));
    const auto notRising = [](float a, float b) { return a >= b; };
    const auto notFalling = [](float a, float b) { return a <= b; };
    const auto& p = axis.points;
    if (std::ranges::adjacent_find(p, notRising) != p.end() &&
        std::ranges::adjacent_find(p, notFalling) != p.end()) {
      numbers.fail("expected divisions in ascending or descending order");
    }
  }
  if (size > numbers.left()) {
    const bool divided =
        std::ranges::any_of(data.axes_, [](const Axis& axis) { return axis.span == 0 && axis.first != 0; });
    numbers.fail(
        fmt::format("fewer values in the file than its grid has points{}",
                    divided ? ": the limits of an axis are equal, so that its divisions come first" : ""));
  }
  data.values_.reserve(size);
  for (size_t i = 0; i < size; ++i) data.values_.push_back(finite("a value"));
  return data;
}

DataFile::Divisions DataFile::divisions(size_t i) const {
  const Axis& axis = axes_[i];
  if (!axis.points.empty()) return {axis.count, axis.points.front(), axis.points.back(), false};
  return {axis.count, axis.first, static_cast<double>(axis.first) + axis.span, true};
}

DataFile::Weights DataFile::weights(const Axis& axis, double coordinate) {
  const size_t last = axis.count - 2;  // index of the first of the last two divisions
  double u;
  size_t index;
  if (axis.points.empty()) {
    u = (coordinate - axis.first) / axis.span * static_cast<double>(axis.count - 1);
    index = u >= 0 ? static_cast<size_t>(std::min(u, static_cast<double>(last))) : 0;
  } else {
    const auto& p = axis.points;
    const bool rising = p.front() < p.back();
    const auto above = rising ? std::ranges::upper_bound(p, coordinate)
                              : std::ranges::upper_bound(p, coordinate, std::greater<>());
    const auto found = static_cast<size_t>(above - p.begin());
    index = std::min(found > 0 ? found - 1 : 0, last);
    u = static_cast<double>(index) + (coordinate - p[index]) / (p[index + 1] - p[index]);
  }
  const double beyond = u - static_cast<double>(index);
  if (beyond > 2) return {index, -1 / (beyond + 1), 2 / (beyond + 1)};
  if (beyond < -1) return {index, -2 / beyond, 1 / beyond};
  return {index, 1 - beyond, beyond};
}

double DataFile::sum(std::span<const Weights> along, size_t axis, const float* from, size_t stride,
                     double weight) const {
  if (std::abs(weight) <= 1e-6) return 0;
  const Weights& w = along[axis];
  stride /= axes_[axis].count;
  from += w.index * stride;
  if (axis + 1 == along.size()) return weight * w.first * from[0] + weight * w.second * from[1];
  return sum(along, axis + 1, from, stride, weight * w.first) +
         sum(along, axis + 1, from + stride, stride, weight * w.second);
}

double DataFile::value(std::span<const double> point) const {
  std::array<Weights, kMaxDimensions> along;
  for (size_t i = 0; i < axes_.size(); ++i) {
    if (!std::isfinite(point[i])) return 0;
    along[i] = weights(axes_[i], point[i]);
  }
  return sum({along.data(), axes_.size()}, 0, values_.data(), values_.size(), 1);
}

}  // namespace rad
