#include "openings/opening_images.h"

#include <algorithm>
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
    : AimedAtOpenings({}, openings.inside()) {
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
      if (mirror.above(o.at(.5, .5)) < 0) {
        if (reflection->frontOnly) continue;
        mirror.normal = -mirror.normal;
      }
      const double power = o.power * reflection->brightness * shareOf(o, mirror);
      if (power > 0)
        places_.push_back(
            {{imageIn(mirror, o), o.filled, o.isHole, o.radiance * reflection->brightness, power},
             mirror,
             surface});
    }
  }
  keepLargest(places_, tuning::Caps::kAsked, [](const OpeningImage& image) { return image.power; });
  while (aimed_ < std::min(places_.size(), tuning::Caps::kAimed) &&
         places_[aimed_].power > tuning::Openings::kLeastMirrored * all)
    ++aimed_;
}

V3d OpeningImage::crossing(const V3d& from, const V3d& to) const {
  const double height = mirror.above(from);
  return from + height / (height - mirror.above(to)) * (to - from);
}

void OpeningImages::aim(const AimFrom& from, Aim& aim) const {
  aimAtFirst(aimed_, from, aim, [&](const OpeningImage& image, const V3d& at) {
    return image.mirror.above(from.point) > 0 && image.mirror.above(at) < 0 &&
           contains(image.mirror, image.crossing(from.point, at));
  });
}

}  // namespace rsphere
