#include "targets/special_targets.h"

#include <algorithm>
#include <cmath>

namespace rsphere {

static_assert(kShapes == 8, "May a new shape be the pane of an opening?");
bool liesIn(const Scene& scene, const SpecialObject& object, const Rectangle& place) {
  const auto* polygon = shapeOf(scene, object).as<Polygon>();
  if (!polygon) return false;
  const double slack = 1e-6 * (place.width + place.height);
  const auto corners = verticesOf(scene, object).subspan(polygon->firstVertex, polygon->vertices);
  return std::ranges::all_of(corners, [&](const V3d& corner) {
    const V3d from = corner - place.corner;
    const double u = from.dot(place.x), v = from.dot(place.y);
    return std::abs(from.dot(place.normal)) < slack && u > -slack && u < place.width + slack && v > -slack &&
           v < place.height + slack;
  });
}

SpecialTargets::SpecialTargets(const TargetScene& scene)
    : scene_(scene.tracing.prepared.scene()),
      contrasts_(scene.contrasts),
      daylight_(contrasts_.objects().size()) {
  if (const Openings* const openings = scene.tracing.aims.of<Openings>())
    for (const Opening& opening : openings->all())
      for (size_t i = 0; i < daylight_.size(); ++i)
        if (liesIn(scene_, contrasts_.objects()[i], opening)) daylight_[i] = opening.radiance;
}

std::vector<FoundRegion> SpecialTargets::find(const V3d& point, double) const {
  std::vector<FoundRegion> found;
  const Contrasts::View view = contrasts_.from(point);
  for (const uint32_t i : view.objects)
    found.push_back({silhouetteOf(scene_, contrasts_.objects()[i], point),
                     contrasts_.deviationOn(i, *view.region), daylight_[i]});
  return found;
}

}  // namespace rsphere
