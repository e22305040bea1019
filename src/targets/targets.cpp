#include "targets/targets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "openings/tuning.h"
#include "targets/tuning.h"

namespace rsphere {
namespace {

constexpr double kFullSphere = 4 * std::numbers::pi;  // sr

// Boxes thinner than this share of their diagonal are flat; the rest is rounding.
constexpr double kFlat = 1e-6;

// The corners of a box, without duplicates: the box around a flat surface is flat.
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

static_assert(kShapes == 8, "May a new shape be the pane of an opening?");
// Whether the object is a polygon inside the rectangle, within rounding.
bool liesIn(const Scene& scene, const SpecialObject& object, const Rectangle& place) {
  const auto* polygon = shapeOf(scene, object).as<Polygon>();
  if (!polygon) return false;
  const double slack = kFlat * (place.width + place.height);
  const auto corners = verticesOf(scene, object).subspan(polygon->firstVertex, polygon->vertices);
  return std::all_of(corners.begin(), corners.end(), [&](const V3d& corner) {
    const V3d from = corner - place.corner;
    const double u = from.dot(place.x), v = from.dot(place.y);
    return std::abs(from.dot(place.normal)) < slack && u > -slack && u < place.width + slack && v > -slack &&
           v < place.height + slack;
  });
}

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
  const auto expected = [&](const Target& target) {
    return target.silhouette.regionSolidAngle() * (baseDensity + target.density);
  };
  for (Target& target : targets)
    if (expected(target) > tuning::Targets::kFewestFitted) large.push_back(&target);
  std::ranges::stable_sort(large,
                           [&](const Target* a, const Target* b) { return expected(*a) > expected(*b); });
  if (large.size() > tuning::Caps::kAsked) large.resize(tuning::Caps::kAsked);
  for (Target* target : large) {
    target->fitted = std::ranges::none_of(
        chosen, [&](const Target* other) { return overlap(target->silhouette, other->silhouette); });
    if (target->fitted) chosen.push_back(target);
  }
  for (Target& target : targets) target.hasOwnEdge = target.fitted || target.density > baseDensity;
}

bool isVisible(const Tracer& tracer, const BrightSpots::Sunlit& spot, const V3d& point) {
  return std::any_of(spot.places.begin(), spot.places.end(), [&](const V3d& place) {
    const V3d way = place - point;
    const double distance = way.length();
    return way.dot(spot.normal) < 0 && tracer.shadow(point, way / distance, distance * (1 - 1e-6), kNone,
                                                     nullptr, kInSpace) != Shadow::blocked;
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
    if (targets_[i].hasOwnEdge) region.id = mixBits(region.id + i + 1);
    if (targets_[i].fitted && region.fitted == 0) region.fitted = i + 1;
  }
  return region;
}

TargetChoice::TargetChoice(const SphereTracing& tracing, std::span<const SpecialObject> objects,
                           const SeenSources& sources, double densityFactor)
    : prepared_(tracing.prepared),
      sunlit_(tracing.aims.of<BrightSpots>() ? tracing.aims.of<BrightSpots>()->sunlit()
                                             : std::span<const BrightSpots::Sunlit>()),
      densityFactor_(densityFactor),
      contrasts_(tracing, objects, sources),
      glints_(tracing.prepared, objects),
      images_(tracing.aims.of<OpeningImages>()) {
  const Openings* const openings = tracing.aims.of<Openings>();
  radiances_.resize(contrasts_.objects().size());
  if (!openings) return;
  for (const Openings::View& view : openings->views()) {
    bool hasSpecial = false;
    for (size_t i = 0; i < radiances_.size(); ++i) {
      if (!liesIn(prepared_.scene(), contrasts_.objects()[i], view.place)) continue;
      radiances_[i] = view.radiance;
      hasSpecial = true;
    }
    if (!hasSpecial) openings_.push_back(view);
  }
}

Targets TargetChoice::at(const V3d& point, double meanBrightness, size_t baseDirections, size_t most) const {
  std::vector<Target> targets;
  if (most == 0) return Targets({});
  const double usual = contrasts_.baseError() * meanBrightness;
  const double baseDensity = static_cast<double>(baseDirections) / kFullSphere;
  double sum = 0;
  // opening: mean radiance of the daylight that it may show, W/sr/m2; 0: not an opening.
  const auto add = [&](Silhouette silhouette, double deviation, bool continues, double opening = 0) {
    const double solidAngle = silhouette.regionSolidAngle();
    if (!(solidAngle > 0)) return;
    double density = 0;
    if (deviation > usual)
      density = usual > 0 ? (deviation / usual - 1) * baseDensity * densityFactor_
                          : static_cast<double>(most) / solidAngle;
    if (opening * solidAngle > tuning::Targets::kLeastOpening * kFullSphere * meanBrightness)
      density = std::max(density, tuning::Caps::kProbes / solidAngle - baseDensity);
    if (!(density > 0) && solidAngle * baseDensity < tuning::Targets::kFewestFitted) return;
    sum += density * solidAngle;
    targets.push_back({std::move(silhouette), density, density * solidAngle, continues});
  };
  const Contrasts::View view = contrasts_.from(point);
  for (const uint32_t i : view.objects)
    add(silhouetteOf(prepared_.scene(), contrasts_.objects()[i], point),
        contrasts_.deviationOn(i, *view.region), false, radiances_[i]);
  const auto addGlints = [&](std::vector<Glint> found) {
    for (Glint& g : found) add(std::move(g.region), tuning::Targets::kPartlyLit * g.brightness, g.continues);
  };
  const double least = tuning::Targets::kLeastGlint * kFullSphere * usual * usual;
  if (usual > 0) addGlints(glints_.find(point, least));
  if (usual > 0 && images_) addGlints(mirroredOpenings(prepared_, *images_, point, least));
  for (const auto& [place, radiance] : openings_) {
    if (!((point - place.corner).dot(place.normal) > 0)) continue;
    const std::array corners{place.at(0, 0), place.at(1, 0), place.at(1, 1), place.at(0, 1)};
    add(hullOf(corners, point), tuning::Targets::kPartlyLit * radiance, false, radiance);
  }
  for (const BrightSpots::Sunlit& spot : sunlit_)
    if (tuning::Targets::kPartlyLit * spot.radiance > usual && isVisible(prepared_.tracer(), spot, point))
      add(hullOf(cornersOf(spot.box), point), tuning::Targets::kPartlyLit * spot.radiance, false);
  if (sum > static_cast<double>(most)) {
    const double scale = static_cast<double>(most) / sum;
    for (Target& target : targets) {
      target.density *= scale;
      target.expected *= scale;
    }
  }
  chooseFitted(targets, baseDensity);
  return Targets(std::move(targets));
}

}  // namespace rsphere
