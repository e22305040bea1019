#include "targets/mirrored_openings.h"

#include <array>
#include <cmath>
#include <utility>

namespace rsphere {
namespace {

using Image = OpeningImages::Image;

// A line to a place on a surface ends before that place by this fraction of its length.
constexpr double kEnd = 1e-6;

// Whether the point sees the middle of the image, or the middle of one of its quarters.
bool isVisible(const PreparedScene& prepared, const Image& image, const Silhouette& region,
               const V3d& point) {
  constexpr std::array<std::pair<double, double>, 5> kPlaces = {
      {{.5, .5}, {.25, .25}, {.75, .25}, {.75, .75}, {.25, .75}}};
  const Tracer& tracer = prepared.tracer();
  const V3d& normal = image.mirror.normal;
  bool tested = false;
  for (const auto& [u, v] : kPlaces) {
    const V3d place = image.place.at(u, v), direction = (place - point).normalized();
    if (!region.contains(direction) || !(image.above(place) < 0)) continue;
    tested = true;
    const V3d at = image.crossing(point, place);
    const V3d back = place - 2 * image.above(place) * normal - at;
    if (tracer.shadow(point, direction, (at - point).length() * (1 - kEnd), kNone, nullptr, kInSpace) !=
            Shadow::blocked &&
        tracer.shadow(at + tracer.samePlace() * normal, back.normalized(), back.length() * (1 - kEnd),
                      kNone) != Shadow::blocked)
      return true;
  }
  return !tested;
}

}  // namespace

std::vector<Glint> mirroredOpenings(const PreparedScene& prepared, const OpeningImages& images,
                                    const V3d& point, double least) {
  std::vector<Glint> found;
  const Scene& scene = prepared.scene();
  for (const Image& image : images.all()) {
    const Rectangle& place = image.place;
    if (!(image.above(point) > 0) || !((point - place.corner).dot(place.normal) > 0)) continue;
    const std::array corners{place.at(0, 0), place.at(1, 0), place.at(1, 1), place.at(0, 1)};
    const double square = image.radiance * image.radiance;
    const double nearest = (place.at(.5, .5) - point).length() - std::hypot(place.width, place.height) / 2;
    if (nearest > 0 && !(place.area() / (nearest * nearest) * square > least)) continue;
    Silhouette region = hullOf(corners, point)
                            .within(silhouetteOf(scene.surfaces[image.surface].shape, scene.vertices, point));
    if (!(region.regionSolidAngle() * square > least) || !isVisible(prepared, image, region, point)) continue;
    found.push_back({std::move(region), image.radiance});
  }
  return found;
}

}  // namespace rsphere
