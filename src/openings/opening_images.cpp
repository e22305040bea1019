#include "openings/opening_images.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/constants.h"
#include "base/keep_largest.h"
#include "scene/material_questions.h"

namespace rsphere {
namespace {

// The material's mirror reflection; empty for clear and rough ones.
std::optional<MirrorReflection> sharpReflection(const Material& material) {
  const auto mirrored = mirrorReflection(material);
  if (!mirrored || mirrored->boundaries > 0 || isTransparent(material)) return {};
  return mirrored->roughness * mirrored->roughness <= kNegligible ? mirrored : std::nullopt;
}

Rectangle imageIn(const Rectangle& mirror, const Rectangle& place) {
  const auto turned = [&](const V3d& direction) {
    return direction - 2 * direction.dot(mirror.normal) * mirror.normal;
  };
  return {mirror.corner + turned(place.corner - mirror.corner),
          turned(place.x),
          turned(place.y),
          turned(place.normal),
          place.width,
          place.height};
}

// The fraction of the opening's light that falls on the mirror, estimated between the middles of both.
double shareOf(const Rectangle& opening, const Rectangle& mirror) {
  const V3d way = mirror.at(.5, .5) - opening.at(.5, .5);
  const double squared = way.length2();
  const double leaving = way.dot(opening.normal), arriving = -way.dot(mirror.normal);
  if (!(leaving > 0) || !(arriving > 0)) return 0;
  return std::min(1., leaving * arriving * mirror.area() / (kPi * squared * squared));
}

}  // namespace

static_assert(kShapes == 8, "Is a new shape flat?");
OpeningImages::OpeningImages(const PreparedScene& prepared, const Openings& openings)
    : inside_(openings.inside()) {
  const Scene& scene = prepared.scene();
  double all = 0;
  for (const Opening& o : openings.all()) all += o.power;
  for (const SurfaceId surface : scene.outermostIds()) {
    const auto* polygon = scene.surfaces[surface].shape.as<Polygon>();
    const Material* material = polygon ? scene.materialOf(scene.surfaces[surface]) : nullptr;
    const auto reflection = material ? sharpReflection(*material) : std::nullopt;
    if (!reflection) continue;
    const Rectangle front = rectangleAround(scene, {&polygon, 1});
    for (const Opening& o : openings.all()) {
      Rectangle mirror = front;
      if ((o.at(.5, .5) - mirror.corner).dot(mirror.normal) < 0) {
        if (reflection->frontOnly) continue;
        mirror.normal = -mirror.normal;
      }
      const double power = o.power * reflection->brightness * shareOf(o, mirror);
      if (power > 0)
        images_.push_back({imageIn(mirror, o), mirror, surface, o.filled,
                           o.power / o.filled * reflection->brightness, power});
    }
  }
  keepLargest(images_, tuning::Caps::kAsked, [](const Image& image) { return image.power; });
  while (aimed_ < std::min(images_.size(), tuning::Caps::kAimed) &&
         images_[aimed_].power > tuning::Openings::kLeastMirrored * all)
    ++aimed_;
}

V3d OpeningImages::Image::crossing(const V3d& from, const V3d& to) const {
  const double height = above(from);
  return from + height / (height - above(to)) * (to - from);
}

void OpeningImages::aim(const AimFrom& from, Aim& aim) const {
  aim.clear();
  aim.seen = 0;
  for (uint32_t i = 0; i < aimed_; ++i) {
    const Image& image = images_[i];
    if (!(image.above(from.point) > 0)) continue;
    const double factor =
        formFactorTo(image.place, image.filled, from.point, from.normal, [&](const V3d& at) {
          return image.above(at) < 0 && contains(image.mirror, image.crossing(from.point, at));
        });
    if (!(factor > 0)) continue;
    aim.seen += factor;
    aim.add(i, factor * kPi * image.radiance);
  }
  aim.finish(from.point);
}

V3d OpeningImages::sample(const Aim& aim, double u1, double u2, double u3) const {
  return (images_[aim.number[aim.chosen(u1)]].place.at(u2, u3) - aim.point).normalized();
}

double OpeningImages::density(const Aim& aim, const V3d& direction) const {
  double sum = 0;
  for (size_t i = 0; i < aim.count; ++i)
    sum += (aim.upTo[i] - aim.before(i)) * densityTo(images_[aim.number[i]].place, aim.point, direction);
  return sum / aim.before(aim.count);
}

}  // namespace rsphere
