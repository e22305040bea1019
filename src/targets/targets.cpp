#include "targets/targets.h"

#include <algorithm>
#include <numbers>

#include "base/keep_largest.h"
#include "base/random.h"
#include "openings/tuning.h"
#include "targets/tuning.h"

namespace rsphere {
namespace {

constexpr double kFullSphere = 4 * std::numbers::pi;  // sr

bool overlap(const Silhouette& a, const Silhouette& b) {
  const Silhouette::Cap capA = a.surroundingCap(), capB = b.surroundingCap();
  if (capA.angle + capB.angle < std::numbers::pi &&
      capA.axis.dot(capB.axis) < std::cos(capA.angle + capB.angle))
    return false;
  // Adjacent panes share an edge. If one of the regions is not a polygon, within() returns the smaller one.
  constexpr double kEdge = 1e-6;
  return a.within(b).regionSolidAngle() > kEdge * std::min(a.regionSolidAngle(), b.regionSolidAngle());
}

// Chooses the targets to which cells are fitted: they do not overlap, and enough directions are expected in
// each. Targets with the most expected directions are chosen first. The actual number of directions must not
// decide, because that would bias the mean. Overlapping targets cannot both be fitted: if few directions lie
// outside the overlap, the cells in the overlap would have to represent the solid angles of both targets.
void chooseFitted(std::vector<Target>& targets, double baseDensity) {
  std::vector<Target*> chosen, large;
  const auto expected = [&](const Target* target) {
    return target->silhouette.regionSolidAngle() * (baseDensity + target->density);
  };
  for (Target& target : targets)
    if (expected(&target) > tuning::Targets::kFewestFitted) large.push_back(&target);
  keepLargest(large, tuning::Caps::kAsked, expected);
  for (Target* target : large) {
    target->fitted = std::ranges::none_of(
        chosen, [&](const Target* other) { return overlap(target->silhouette, other->silhouette); });
    if (target->fitted) chosen.push_back(target);
  }
  for (Target& target : targets) target.hasOwnEdge = target.fitted || target.density > baseDensity;
}

// The least number of directions to an opening whose light, unoccluded, is a part of all light at the point.
double leastNumber(double light, double all) {
  if (!(light > tuning::Targets::kLeastOpening * all)) return 0;
  const double part = light < all ? light / all : 1;
  return tuning::Caps::kProbes * std::sqrt(part / tuning::Targets::kLeastOpening);
}

// Reduces the densities so that at most `most` directions are expected. The least densities of openings stay,
// or get half of the directions.
void reduceTo(double most, std::vector<Target>& targets) {
  double sum = 0, least = 0;
  for (const Target& target : targets) {
    sum += target.expected;
    least += target.least * target.silhouette.regionSolidAngle();
  }
  if (!(sum > most)) return;
  const double kept = least > most / 2 ? most / 2 / least : 1,
               share = (most - kept * least) / (sum - kept * least);
  for (Target& target : targets) {
    target.density = kept * target.least + share * (target.density - kept * target.least);
    target.expected = target.density * target.silhouette.regionSolidAngle();
  }
}

}  // namespace

Targets::Targets(std::vector<Target> targets) : targets_(std::move(targets)) {
  for (uint32_t i = 0; i < targets_.size(); ++i) index_.add(i, targets_[i].silhouette);
}

Targets::Region Targets::regionAt(const V3d& direction) const {
  Region region;
  for (const uint32_t i : index_.near(direction)) {
    if (!targets_[i].silhouette.contains(direction)) continue;
    region.density += targets_[i].density;
    if (targets_[i].hasOwnEdge) region.id = mixBits(region.id + i + 1);
    if (targets_[i].fitted && region.fitted == 0) region.fitted = i + 1;
  }
  return region;
}

TargetChoice::TargetChoice(const SphereTracing& tracing, std::span<const SpecialObject> objects,
                           const SeenSources& sources, double densityFactor)
    : densityFactor_(densityFactor),
      contrasts_(tracing, objects, sources),
      finders_({tracing, objects, contrasts_}) {}

Targets TargetChoice::at(const V3d& point, double meanBrightness, size_t baseDirections, size_t most) const {
  if (most == 0) return Targets({});
  std::vector<Target> targets;
  const double usual = contrasts_.baseError() * meanBrightness;
  const double baseDensity = static_cast<double>(baseDirections) / kFullSphere;
  for (FoundRegion& found : finders_.find(point, usual)) {
    const double solidAngle = found.silhouette.regionSolidAngle();
    if (!(solidAngle > 0)) continue;
    double density = 0;
    if (found.deviation > usual)
      density = usual > 0 ? (found.deviation / usual - 1) * baseDensity * densityFactor_
                          : static_cast<double>(most) / solidAngle;
    const double least =
        std::max(0., leastNumber(found.daylight * solidAngle, kFullSphere * meanBrightness) / solidAngle -
                         baseDensity);
    density = std::max(density, least);
    if (!(density > 0) && solidAngle * baseDensity < tuning::Targets::kFewestFitted) continue;
    targets.push_back({std::move(found.silhouette), density, density * solidAngle, found.continues});
    targets.back().least = least;
  }
  reduceTo(static_cast<double>(most), targets);
  chooseFitted(targets, baseDensity);
  return Targets(std::move(targets));
}

}  // namespace rsphere
