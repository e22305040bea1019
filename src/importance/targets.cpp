#include "importance/targets.h"

#include <algorithm>
#include <numbers>

#include "importance/tuning.h"
#include "scene/random.h"

namespace rsphere {
namespace {

using Tuning = tuning::Targets;

constexpr double kFullSphere = 4 * std::numbers::pi;  // sr

// Thinner boxes, relative to their diagonal, are flat but for rounding.
constexpr double kFlat = 1e-6;

// The corners of a box, each once: boxes around flat surfaces are flat.
std::vector<V3d> cornersOf(const Box3d& box) {
  std::vector<V3d> corners{box.min};
  for (int axis = 0; axis < 3; ++axis) {
    if (!(box.size()[axis] > kFlat * box.size().length())) continue;
    for (size_t i = 0, n = corners.size(); i < n; ++i) {
      corners.push_back(corners[i]);
      corners.back()[axis] = box.max[axis];
    }
  }
  return corners;
}

bool isVisible(const Tracer& tracer, const BrightSpots::Sunlit& spot, const V3d& point) {
  return std::any_of(spot.places.begin(), spot.places.end(), [&](const V3d& place) {
    const V3d way = place - point;
    const double distance = way.length();
    return way.dot(spot.normal) < 0 &&
           tracer.shadow(point, way / distance, distance * (1 - 1e-6), kNone) != Shadow::blocked;
  });
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
    region.id = mixBits(region.id + i + 1);
  }
  return region;
}

TargetChoice::TargetChoice(const Transport& transport, std::span<const SpecialObject> objects,
                           const SeenSources& sources, const Aims& aims, double densityFactor)
    : transport_(transport),
      sunlit_(aims.spots ? aims.spots->sunlit() : std::span<const BrightSpots::Sunlit>()),
      densityFactor_(densityFactor),
      contrasts_(measureContrasts(transport, objects, sources, aims)),
      glints_(transport, objects) {}

Targets TargetChoice::at(const V3d& point, double meanBrightness, size_t baseDirections, size_t most) const {
  std::vector<Target> targets;
  if (most == 0) return Targets({});
  const double usual = contrasts_.surroundings * meanBrightness;
  const double baseDensity = static_cast<double>(baseDirections) / kFullSphere;
  double sum = 0;
  const auto add = [&](Silhouette silhouette, double deviation, bool continues) {
    const double solidAngle = silhouette.regionSolidAngle();
    if (!(deviation > usual) || !(solidAngle > 0)) return;
    const double contrast =
        std::min(usual > 0 ? deviation / usual : Tuning::kMostContrast, Tuning::kMostContrast) - 1;
    const double density = contrast * baseDensity * densityFactor_;
    sum += density * solidAngle;
    targets.push_back({std::move(silhouette), density, density * solidAngle, continues});
  };
  for (const Contrasts::Object& c : contrasts_.objects)
    if (c.deviation > usual) add(silhouetteOf(transport_.scene(), c.object, point), c.deviation, false);
  if (usual > 0)
    for (Glint& g : glints_.find(point, Tuning::kLeastGlint * kFullSphere * usual * usual))
      add(std::move(g.region), Tuning::kGlintDeviation * g.brightness, g.continues);
  for (const BrightSpots::Sunlit& spot : sunlit_)
    if (Tuning::kSunlitDeviation * spot.radiance > usual && isVisible(transport_.tracer(), spot, point))
      add(hullOf(cornersOf(spot.box), point), Tuning::kSunlitDeviation * spot.radiance, false);
  if (sum > static_cast<double>(most)) {
    const double scale = static_cast<double>(most) / sum;
    for (Target& target : targets) {
      target.density *= scale;
      target.expected *= scale;
    }
  }
  return Targets(std::move(targets));
}

}  // namespace rsphere
