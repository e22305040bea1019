#include "transport/openings.h"

#include "base/constants.h"

namespace rsphere {
std::vector<Openings::View> Openings::views() const {
  std::vector<View> views;
  for (const Opening& o : openings_) views.push_back({o, o.power / o.filled});
  return views;
}

void Openings::aim(const V3d& point, const V3d& normal, Aim& aim) const {
  aim.clear();
  aim.seen = 0;
  for (uint32_t i = 0; i < openings_.size(); ++i) {
    const Opening& o = openings_[i];
    if ((point - o.corner).dot(o.normal) <= 0) continue;
    // The form factor to the opening, estimated from its middle and four other points. These are separated by
    // sqrt(5/12) of its sides, so that the mean of the five is exact for polynomials of the third degree.
    constexpr double kBetween = .6454972243679028, kInset = (1 - kBetween) / 2;
    double factor = 0;
    for (int c = 0; c < 5; ++c) {
      const double a = c < 4 ? kInset + kBetween * (c & 1) : .5;
      const double b = c < 4 ? kInset + kBetween * (c >> 1) : .5;
      const V3d way = o.at(a, b) - point;
      const double squared = way.length2();
      const double here = way.dot(normal), there = -way.dot(o.normal);
      if (here > 0 && there > 0) factor += here * there / (squared * squared);
    }
    factor = factor / 5 * o.filled / kPi;
    if (!(factor > 0)) continue;
    aim.seen += factor;
    aim.add(i, factor * kPi * o.power / o.filled);
  }
  aim.finish(point);
}

V3d Openings::sample(const Aim& aim, double u1, double u2, double u3) const {
  return (openings_[aim.number[aim.chosen(u1)]].at(u2, u3) - aim.point).normalized();
}

double Openings::density(const Aim& aim, const V3d& direction) const {
  double sum = 0;
  for (size_t i = 0; i < aim.count; ++i) {
    const double chance = aim.upTo[i] - aim.before(i);
    const Opening& o = openings_[aim.number[i]];
    const double cosine = -direction.dot(o.normal);
    if (!(cosine > 0)) continue;
    const V3d from = aim.point - o.corner;
    const double distance = from.dot(o.normal) / cosine;
    const V3d at = from + distance * direction;
    const double u = at.dot(o.x), v = at.dot(o.y);
    if (u < 0 || v < 0 || u > o.width || v > o.height) continue;
    sum += chance * distance * distance / (cosine * o.area());
  }
  return sum / aim.before(aim.count);
}

}  // namespace rsphere
