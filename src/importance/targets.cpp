#include "importance/targets.h"

#include <algorithm>
#include <numbers>

#include "importance/tuning.h"

namespace rsphere {
namespace {

using Tuning = tuning::Targets;

constexpr double kFullSphere = 4 * std::numbers::pi;  // sr

}  // namespace

Targets::Targets(std::vector<Target> targets) : targets_(std::move(targets)) {
  for (uint32_t i = 0; i < targets_.size(); ++i) index_.add(i, targets_[i].silhouette);
}

double Targets::densityAt(const V3d& direction) const {
  double density = 0;
  for (const uint32_t i : index_.near(direction))
    if (targets_[i].silhouette.contains(direction)) density += targets_[i].density;
  return density;
}

TargetChoice::TargetChoice(const Transport& transport, std::span<const SpecialObject> objects,
                           const SeenSources& sources, const Aims& aims, double densityFactor)
    : scene_(transport.scene()),
      densityFactor_(densityFactor),
      contrasts_(measureContrasts(transport, objects, sources, aims)),
      glints_(transport, objects) {}

Targets TargetChoice::at(const V3d& point, double meanBrightness, size_t baseDirections, size_t most) const {
  std::vector<Target> targets;
  if (contrasts_.objects.empty() || most == 0) return Targets({});
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
    if (c.deviation > usual) add(silhouetteOf(scene_, c.object, point), c.deviation, false);
  if (usual > 0)
    for (Glint& g : glints_.find(point, Tuning::kLeastGlint * kFullSphere * usual * usual))
      add(std::move(g.region), Tuning::kGlintDeviation * g.brightness, g.continues);
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
