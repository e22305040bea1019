#include "spots/reach_grid.h"

#include <algorithm>
#include <cmath>

#include "spots/tuning.h"

namespace rsphere {
namespace {

double distance(const V3d& point, const ReachGrid::Reach& reach) {
  const V3d along = reach.end - reach.begin, way = point - reach.begin;
  const double squared = along.length2(),
               share = squared > 0 ? std::clamp(way.dot(along) / squared, 0., 1.) : 0;
  return (way - share * along).length();
}

}  // namespace

ReachGrid::ReachGrid(const std::vector<Reach>& reaches, const Box3d& bounds) : low_(bounds.min) {
  if (reaches.empty()) return;
  const V3d size = bounds.size();
  const double widest = std::max({size.x, size.y, size.z});
  const double cell = widest > 0 ? widest / tuning::Highlights::kReachCells : 1;
  perLength_ = 1 / cell;
  for (int i = 0; i < 3; ++i)
    counts_[i] = static_cast<size_t>(std::max(1., std::ceil(size[i] * perLength_ - 1e-9)));
  const double toCorner = std::sqrt(3.) / 2 * cell;
  const auto eachCell = [&](auto each) {
    for (uint32_t i = 0; i < reaches.size(); ++i) {
      Box3d box(reaches[i].begin);
      box.extendBy(reaches[i].end);
      const V3d beyond(reaches[i].distance), from = (box.min - beyond - low_) * perLength_,
                                             upTo = (box.max + beyond - low_) * perLength_;
      for (size_t z = inner(from.z, counts_[2]); z <= inner(upTo.z, counts_[2]); ++z)
        for (size_t y = inner(from.y, counts_[1]); y <= inner(upTo.y, counts_[1]); ++y)
          for (size_t x = inner(from.x, counts_[0]); x <= inner(upTo.x, counts_[0]); ++x) {
            const V3d middle = low_ + cell * (V3d(.5) + V3d(static_cast<double>(x), static_cast<double>(y),
                                                            static_cast<double>(z)));
            if (distance(middle, reaches[i]) <= reaches[i].distance + toCorner)
              each((z * counts_[1] + y) * counts_[0] + x, i);
          }
    }
  };
  begin_.assign(counts_[0] * counts_[1] * counts_[2] + 1, 0);
  eachCell([&](size_t at, uint32_t) { ++begin_[at + 1]; });
  for (size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
  numbers_.resize(begin_.back());
  std::vector<uint32_t> next = begin_;
  eachCell([&](size_t at, uint32_t number) { numbers_[next[at]++] = number; });
}

}  // namespace rsphere
