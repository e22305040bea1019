#include "transport/openings.h"

#include <algorithm>
#include <numbers>

#include "base/constants.h"

namespace rsphere {
std::vector<Openings::View> Openings::views() const {
  std::vector<View> views;
  for (const Opening& o : openings_) views.push_back({o, o.power / o.filled});
  return views;
}

void Openings::aim(const V3d& point, const V3d& normal, Aim& aim) const {
  aim.count = 0;
  double sum = 0, seen = 0;
  for (uint32_t i = 0; i < openings_.size(); ++i) {
    const Opening& o = openings_[i];
    if ((point - o.corner).dot(o.normal) <= 0) continue;
    // The form factor to the opening, estimated from four of its points by Gauss' quadrature.
    constexpr double kBetween = 1 / std::numbers::sqrt3, kInset = (1 - kBetween) / 2;
    double factor = 0;
    for (int c = 0; c < 4; ++c) {
      const double a = kInset + kBetween * (c & 1), b = kInset + kBetween * (c >> 1);
      const V3d way = o.at(a, b) - point;
      const double squared = way.length2();
      const double here = way.dot(normal), there = -way.dot(o.normal);
      if (here > 0 && there > 0) factor += here * there / (squared * squared);
    }
    factor = factor / 4 * o.filled / kPi;
    if (!(factor > 0)) continue;
    seen += factor;
    aim.opening[aim.count] = i;
    aim.upTo[aim.count++] = sum += factor * o.power / o.filled;
  }
  aim.mean = sum;
  aim.seen = seen;
}

double Openings::areaTowards(const V3d& direction) const {
  double sum = 0;
  for (const Opening& o : openings_) sum += std::max(0., direction.dot(o.normal)) * o.area();
  return sum;
}

V3d Openings::pointTowards(const V3d& direction, double u1, double u2, double u3) const {
  double due = u1 * areaTowards(direction);
  const Opening* chosen = nullptr;
  for (const Opening& o : openings_) {
    const double area = std::max(0., direction.dot(o.normal)) * o.area();
    if (area > 0) chosen = &o;
    if (due < area) break;
    due -= area;
  }
  return chosen->at(u2, u3);
}

V3d Openings::sample(const Aim& aim, const V3d& point, double u1, double u2, double u3) const {
  const double due = u1 * aim.upTo[aim.count - 1];
  size_t chosen = 0;
  while (chosen + 1 < aim.count && !(due < aim.upTo[chosen])) ++chosen;
  return (openings_[aim.opening[chosen]].at(u2, u3) - point).normalized();
}

double Openings::density(const Aim& aim, const V3d& point, const V3d& direction) const {
  double sum = 0, before = 0;
  for (size_t i = 0; i < aim.count; ++i) {
    const double chance = aim.upTo[i] - before;
    before = aim.upTo[i];
    const Opening& o = openings_[aim.opening[i]];
    const double cosine = -direction.dot(o.normal);
    if (!(cosine > 0)) continue;
    const V3d from = point - o.corner;
    const double distance = from.dot(o.normal) / cosine;
    const V3d at = from + distance * direction;
    const double u = at.dot(o.x), v = at.dot(o.y);
    if (u < 0 || v < 0 || u > o.width || v > o.height) continue;
    sum += chance * distance * distance / (cosine * o.area());
  }
  return sum / before;
}

}  // namespace rsphere
