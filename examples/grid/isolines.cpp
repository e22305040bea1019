#include "isolines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace grid {

// The nodes are the corners of quarters of cells. A node between points has the mean of those around it.
Field::Field(const Grid& grid, std::span<const double> values) : grid_(grid), width_(2 * grid.columns + 1) {
  for (int y = 0; y <= 2 * grid.rows; ++y)
    for (int x = 0; x < width_; ++x) {
      double sum = 0;
      int count = 0;
      // The cells of which this is the centre, the middle of a side, or a corner.
      for (int row = (y + 1) / 2 - 1; row <= y / 2; ++row)
        for (int column = (x + 1) / 2 - 1; column <= x / 2; ++column)
          if (const int point = grid.point(column, row); point != Grid::kNone) sum += values[point], ++count;
      nodes_.push_back(count ? sum / count : 0);
    }
}

V2d Field::at(int node) const { return grid_.at(node % width_ / 2., node / width_ / 2.); }

// Calls use(from, to, onLine) for each side of each piece of a quarter where the value is at least `level`,
// counterclockwise. onLine: the side is a piece of the isoline.
template <class Use>
void Field::forEachPiece(double level, Use use) const {
  for (int row = 0; row < grid_.rows; ++row)
    for (int column = 0; column < grid_.columns; ++column) {
      if (grid_.point(column, row) == Grid::kNone) continue;
      for (int quarter = 0; quarter < 4; ++quarter) {
        const int first = (2 * row + quarter / 2) * width_ + 2 * column + quarter % 2;
        const std::array<int, 4> corners{first, first + 1, first + 1 + width_, first + width_};
        std::vector<std::pair<Place, bool>>
            outline;  // and whether the isoline leaves the quarter's sides there
        for (int i = 0; i < 4; ++i) {
          const int a = corners[i], b = corners[(i + 1) % 4];
          const bool inA = nodes_[a] >= level, inB = nodes_[b] >= level;
          if (inA) outline.push_back({{a, a}, false});
          if (inA != inB) outline.push_back({std::minmax(a, b), inA});
        }
        for (size_t i = 0; i < outline.size(); ++i)
          use(outline[i].first, outline[(i + 1) % outline.size()].first, outline[i].second);
      }
    }
}

std::vector<std::vector<V2d>> Field::join(const std::vector<Step>& steps, double level) const {
  std::multimap<Place, size_t> from;
  std::map<Place, int> surplus;  // of steps that begin there over those that end there
  for (size_t i = 0; i < steps.size(); ++i) {
    from.emplace(steps[i].first, i);
    ++surplus[steps[i].first];
    --surplus[steps[i].second];
  }
  const auto point = [&](const Place& place) {
    const auto [a, b] = place;
    if (a == b) return at(a);
    const double t = (level - nodes_[a]) / (nodes_[b] - nodes_[a]);
    return at(a) * (1 - t) + at(b) * t;
  };
  std::vector<std::vector<V2d>> lines;
  const auto follow = [&](Place place) {
    std::vector<V2d>& line = lines.emplace_back();
    line.push_back(point(place));
    for (auto next = from.find(place); next != from.end(); next = from.find(place)) {
      place = steps[next->second].second;
      from.erase(next);
      line.push_back(point(place));
    }
  };
  for (const auto& [place, more] : surplus)
    for (int i = 0; i < more; ++i) follow(place);
  while (!from.empty()) follow(from.begin()->first);
  return lines;
}

std::vector<std::vector<V2d>> Field::region(double level) const {
  std::set<Step> sides;
  forEachPiece(level, [&](const Place& a, const Place& b, bool) {
    // The side that two pieces share is not part of the outline.
    if (!sides.erase({b, a})) sides.insert({a, b});
  });
  return join({sides.begin(), sides.end()}, level);
}

std::vector<std::vector<V2d>> Field::isolines(double level) const {
  std::vector<Step> steps;
  forEachPiece(level, [&](const Place& a, const Place& b, bool onLine) {
    if (onLine) steps.emplace_back(a, b);
  });
  return join(steps, level);
}

std::vector<double> roundLevels(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const size_t beyond = sorted.size() < 10 ? 0 : std::max<size_t>(1, sorted.size() / 50);
  const double smallest = sorted[beyond], largest = sorted[sorted.size() - 1 - beyond];
  if (!(largest > smallest)) return {};
  const double low = sorted[sorted.size() / 20], high = sorted[sorted.size() - 1 - sorted.size() / 20];
  std::vector<double> levels;
  // Where equal steps serve; the scale takes over outside.
  double first = high, last = high;
  if (high > low && low > 0 && high / low < 4) {
    double step = std::pow(10, std::floor(std::log10((high - low) / 8)));
    for (const double factor : {1., 2., 5., 10.})
      if ((high - low) / (step * factor) <= 8) {
        step *= factor;
        break;
      }
    for (double k = std::ceil(low / step); k * step <= high; ++k) levels.push_back(k * step);
    if (!levels.empty()) first = levels.front(), last = levels.back();
  }
  const bool equalSteps = !levels.empty();
  const double lowest = std::max(smallest, largest * 1e-4);
  for (double power = std::pow(10, std::floor(std::log10(lowest))); power <= largest; power *= 10)
    for (const double step : {1., 1.5, 2., 3., 5., 7.5}) {
      const double level = step * power;
      // A quarter away from the equal steps, so that bands at their ends are not thin.
      const bool apart = !equalSteps || level <= .75 * first || level >= 1.25 * last;
      if (level > lowest && level < largest && apart) levels.push_back(level);
    }
  std::sort(levels.begin(), levels.end());
  // Around the darkest places lines lie close together: two serve there, below what a twentieth of the lit
  // points has.
  const auto lit = std::upper_bound(sorted.begin(), sorted.end(), 0.);
  if (lit != sorted.end()) {
    const auto usual = std::lower_bound(levels.begin(), levels.end(), lit[(sorted.end() - lit) / 20]);
    if (usual != levels.end() && usual - levels.begin() > 2) levels.erase(levels.begin(), usual - 2);
  }
  // Every other one of many, the upper ones first.
  while (levels.size() > 14) {
    std::vector<double> half;
    for (size_t i = (levels.size() - 1) % 2; i < levels.size(); i += 2) half.push_back(levels[i]);
    levels = half;
  }
  return levels;
}

}  // namespace grid
