#include "light/source_choice.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"

namespace rsphere {
namespace {

// The brightness (W/sr/m2) of a source, or of the real source that a virtual source shows. Patterns and
// reflectances are taken as 1.
double brightnessOf(const Scene& scene, const ById<LightId, LightSource>& all, LightId index) {
  while (all[index].isVirtual()) index = all[index].relayed;
  return brightness(sourceRadiance(scene, scene.surfaces[all[index].surface]));
}

// The height of a source's center above the surface. For a source that is partly below the surface: half the
// height of its highest point.
double before(double height, double radius) {
  return height >= radius ? height : std::max(0., height + radius) / 2;
}

}  // namespace

SourceChoice::SourceChoice(const Scene& scene, const LightSources& lights) {
  const auto& all = lights.all();
  near_.resize(all.size());
  for (const LightId i : all.ids()) {
    const LightSource& source = all[i];
    const double bright = brightnessOf(scene, all, i);
    const auto add = [&](const V3d& normal, double area) {
      near_[i] = {source.center, normal, bright * area, source.radius, normal != V3d(0, 0, 0) ? 0. : 1.};
    };
    match(
        source.shape, [&](const PlaneLight& plane) { add(plane.normal, plane.area); },
        [&](const BallLight&) { add(V3d(0, 0, 0), kPi * source.radius * source.radius); },
        [&](const TubeLight& tube) { add(V3d(0, 0, 0), tube.area); },
        [&](const DistantLight& cone) {
          near_[i] = {V3d(0, 0, 0), V3d(0, 0, 0), 0, 1, 0};
          special_.push_back({.distant = true,
                              .direction = source.center,
                              .power = bright * 2 * kPi * (1 - cone.cosHalfAngle),
                              .sine = source.outermost});
        });
    if (!source.isDistant() && (source.reach > 0 || source.spot))
      special_.push_back({.reach = source.reach, .spot = source.spot});
    else if (!source.isDistant())
      continue;
    near_[i].special = static_cast<uint32_t>(special_.size());
  }
}

// usual: the weight of the source if it had neither reach nor cone.
double SourceChoice::weightOf(const Special& special, const Near& near, const V3d& point, const V3d& front,
                              double usual) {
  if (special.distant)
    return special.power * (front == V3d(0, 0, 0) ? 1 : before(special.direction.dot(front), special.sine));
  const V3d towards = near.center - point;
  const double distance = towards.length();
  const bool tooFar = special.reach > 0 && distance > special.reach + near.radius;
  // aim . direction, for the direction towards the source that is closest to the spotlight's axis.
  const double deepest =
      distance > near.radius
          ? (special.spot ? special.spot->aim.dot(towards) : 0) / distance - near.radius / distance
          : -1;
  const bool outside = special.spot && special.spot->solidAngle < 2 * kPi * (1 + deepest);
  return tooFar || outside ? 0 : usual;
}

double SourceChoice::weigh(const V3d& point, const V3d& front, std::span<const uint32_t> sources,
                           std::vector<double>& weights) const {
  weights.resize(sources.size());
  const double anySide = front == V3d(0, 0, 0) ? 1 : 0;
  double sum = 0;
  for (size_t i = 0; i < sources.size(); ++i) {
    const Near& s = near_[LightId(sources[i])];
    const V3d towards = s.center - point;
    // Distances below the source's radius are raised to it, since the source is then seen more obliquely.
    const double square = std::max(towards.length2(), s.radius * s.radius);
    const double distance = std::sqrt(square);
    const double above = -towards.dot(s.normal);
    // In the plane of the source, `above` is a rounding error. If its sign mattered, a point on a luminous
    // surface, such as an importance goal, would choose that surface half of the time.
    const bool inFront = above > kNegligible * distance;
    const double facing =
        s.everywhere * distance + (inFront ? above + s.radius * s.radius * s.radius / (2 * square) : 0);
    const double cosine = anySide * distance + before(towards.dot(front), s.radius) * (1 - anySide);
    weights[i] = s.power * facing * cosine / (square * square);
    if (s.special > 0) weights[i] = weightOf(special_[s.special - 1], s, point, front, weights[i]);
    sum += weights[i];
  }
  return sum;
}

}  // namespace rsphere
