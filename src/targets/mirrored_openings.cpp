#include "targets/mirrored_openings.h"

#include <array>
#include <cmath>
#include <utility>

#include "targets/glints.h"
#include "targets/tuning.h"

namespace rsphere {
namespace {

// A line to a place on a surface ends before that place by this fraction of its length.
constexpr double kEnd = 1e-6;

// Whether the point sees the middle of the image, or the middle of one of its quarters.
bool isVisible(const PreparedScene& prepared, const OpeningImage& image, const Silhouette& region,
               const V3d& point) {
  constexpr std::array<std::pair<double, double>, 5> kPlaces = {
      {{.5, .5}, {.25, .25}, {.75, .25}, {.75, .75}, {.25, .75}}};
  const Tracer& tracer = prepared.tracer();
  const V3d& normal = image.mirror.normal;
  bool tested = false;
  for (const auto& [u, v] : kPlaces) {
    const V3d place = image.at(u, v), direction = (place - point).normalized();
    if (!region.contains(direction) || !(image.mirror.above(place) < 0)) continue;
    tested = true;
    const V3d at = image.crossing(point, place);
    const V3d back = place - 2 * image.mirror.above(place) * normal - at;
    if (tracer.shadow(point, direction, (at - point).length() * (1 - kEnd), kNone, nullptr, kInSpace) !=
            Shadow::blocked &&
        tracer.shadow(at + tracer.samePlace() * normal, back.normalized(), back.length() * (1 - kEnd),
                      kNone) != Shadow::blocked)
      return true;
  }
  return !tested;
}

}  // namespace

std::vector<FoundRegion> MirroredOpenings::find(const V3d& point, double usual) const {
  std::vector<FoundRegion> found;
  if (!images_ || !(usual > 0)) return found;
  const Scene& scene = prepared_.scene();
  const double least = leastGlint(usual);
  for (const OpeningImage& image : images_->all()) {
    if (!(image.mirror.above(point) > 0) || !(image.above(point) > 0)) continue;
    const double square = image.radiance * image.radiance;
    const double nearest = (image.at(.5, .5) - point).length() - std::hypot(image.width, image.height) / 2;
    if (nearest > 0 && !(image.area() / (nearest * nearest) * square > least)) continue;
    Silhouette region = hullOf(image.corners(), point)
                            .within(silhouetteOf(scene.surfaces[image.surface].shape, scene.vertices, point));
    if (!(region.regionSolidAngle() * square > least) || !isVisible(prepared_, image, region, point))
      continue;
    found.push_back({std::move(region), tuning::Targets::kPartlyLit * image.radiance});
  }
  return found;
}

}  // namespace rsphere
