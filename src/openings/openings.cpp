#include "openings/openings.h"

#include "base/constants.h"

namespace rsphere {
std::vector<Openings::View> Openings::views() const {
  std::vector<View> views;
  for (const Opening& o : openings_) views.push_back({o, o.power / o.filled});
  return views;
}

void Openings::aim(const AimFrom& from, Aim& aim) const {
  aim.clear();
  aim.seen = 0;
  for (uint32_t i = 0; i < openings_.size(); ++i) {
    const Opening& o = openings_[i];
    const double factor = formFactorTo(o, o.filled, from.point, from.normal, [](const V3d&) { return true; });
    if (!(factor > 0)) continue;
    aim.seen += factor;
    aim.add(i, factor * kPi * o.power / o.filled);
  }
  aim.finish(from.point);
}

V3d Openings::sample(const Aim& aim, double u1, double u2, double u3) const {
  return (openings_[aim.number[aim.chosen(u1)]].at(u2, u3) - aim.point).normalized();
}

double Openings::density(const Aim& aim, const V3d& direction) const {
  double sum = 0;
  for (size_t i = 0; i < aim.count; ++i)
    sum += (aim.upTo[i] - aim.before(i)) * densityTo(openings_[aim.number[i]], aim.point, direction);
  return sum / aim.before(aim.count);
}

}  // namespace rsphere
