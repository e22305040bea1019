#include "rays/shared_highlights.h"

#include <algorithm>
#include <cmath>

#include "rays/ray_functions.h"
#include "rays/tuning.h"

namespace rsphere {
namespace {

// The solid angle (sr) of the whole source if all of it had this distance and orientation.
double apparentSize(const LightSource& source, double distance, double cosine) {
  const auto ofBall = [&] {
    const double r = source.radius, toCenter2 = distance * distance + r * r + 2 * distance * r * cosine;
    return 2 * kPi * (1 - std::sqrt(std::max(0., 1 - r * r / toCenter2)));
  };
  return match(
      source.shape,
      [&](const PlaneLight& plane) { return std::min(2 * kPi, plane.area * cosine / (distance * distance)); },
      [&](const OneOf<BallLight, TubeLight> auto&) { return ofBall(); },
      [](const DistantLight& cone) { return 2 * kPi * (1 - cone.cosHalfAngle); });
}

}  // namespace

static_assert(kLightForms == 8, "Is the solid angle of the whole known?");
bool sharesHighlights(const PreparedScene& prepared, LightId source) {
  const LightSource& light = prepared.lights().all()[source];
  if (light.isVirtual() || light.reach > 0 || light.spot || light.as<TubeLight>() ||
      !prepared.lights().constantRadiance(source))
    return false;
  const Surface& surface = prepared.scene().surfaces[light.surface];
  return surface.goal || !std::holds_alternative<Illum>(*prepared.scene().materialOf(surface));
}

double shareOfLobe(const LightSource& source, double distance, double cosine, double density) {
  const double within = density * apparentSize(source, distance, cosine);
  return within > tuning::SharedHighlights::kLeast ? within / (1 + within) : 0;
}

Radiance sourceSeenBy(const PreparedScene& prepared, const RayEnd& sample) {
  if (sample.hit.surface == kNone || !hitFront(sample.hit)) return {};
  const LightId source = prepared.lights().of(sample.hit.surface);
  if (source == kNone || !sharesHighlights(prepared, source)) return {};
  const Medium& medium = sample.medium();  // attenuates it like shadow rays
  return *prepared.lights().constantRadiance(source) *
         passing(medium.extinction * (Color(1, 1, 1) - medium.albedo), sample.hit.length);
}

}  // namespace rsphere
