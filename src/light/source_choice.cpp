#include "light/source_choice.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "shade/scattering.h"

namespace rsphere {
namespace {

// The brightness (W/sr/m2) of the source, or of the real source whose image it is. Patterns and reflectances
// are taken as 1.
double brightnessOf(const Scene& scene, const ById<LightId, LightSource>& all, LightId index) {
  while (all[index].isVirtual()) index = all[index].relayed;
  return brightness(sourceRadiance(scene, scene.surfaces[all[index].surface]));
}

// The height of a source's center above the surface. If part of the source lies below the surface, half the
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
          distant_.push_back(
              {i, source.center, bright * 2 * kPi * (1 - cone.cosHalfAngle), source.outermost});
        });
    if (source.isDistant()) continue;
    if (source.reach > 0 || source.spot) restricted_.push_back({i, source.reach, source.spot});
  }
}

double SourceChoice::weigh(const V3d& point, const V3d& front, ById<LightId, double>& weights) const {
  weights.resize(near_.size());
  const double anySide = front == V3d(0, 0, 0) ? 1 : 0;
  for (const LightId i : near_.ids()) {
    const Near& s = near_[i];
    const V3d towards = s.center - point;
    // The distance is taken as at least the source's radius: nearer, more of the source is seen obliquely.
    const double square = std::max(towards.length2(), s.radius * s.radius);
    const double distance = std::sqrt(square);
    const double above = -towards.dot(s.normal);
    const double facing =
        s.everywhere * distance + (above > 0 ? above + s.radius * s.radius * s.radius / (2 * square) : 0);
    const double cosine = anySide * distance + before(towards.dot(front), s.radius) * (1 - anySide);
    weights[i] = s.power * facing * cosine / (square * square);
  }
  for (const Distant& s : distant_)
    weights[s.source] = s.power * (anySide > 0 ? 1 : before(s.direction.dot(front), s.sine));
  for (const Restricted& r : restricted_) {
    const Near& s = near_[r.source];
    const V3d towards = s.center - point;
    const double distance = towards.length();
    const bool tooFar = r.reach > 0 && distance > r.reach + s.radius;
    // aim . direction for the direction to the source that is closest to the axis of the spot.
    const double deepest =
        distance > s.radius ? (r.spot ? r.spot->aim.dot(towards) : 0) / distance - s.radius / distance : -1;
    const bool outside = r.spot && r.spot->solidAngle < 2 * kPi * (1 + deepest);
    if (tooFar || outside) weights[r.source] = 0;
  }
  double sum = 0;
  for (const double w : weights) sum += w;
  return sum;
}

}  // namespace rsphere
