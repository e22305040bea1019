#include "spots/source_parts.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/constants.h"
#include "base/frame.h"
#include "openings/tuning.h"
#include "rays/ray_functions.h"
#include "spots/light_particles.h"
#include "spots/tuning.h"

namespace rsphere {
namespace {

// Cap on the number of parts along each side of a source. A single source then has at most Caps::kAimed
// parts, which is the cap for all sources together.
const double kMostAlong = std::sqrt(static_cast<double>(tuning::Caps::kAimed));

static_assert(kLightForms == 8, "Is it round?");
std::vector<SourcePart> partsOf(const LightSource& source, const V3d& from) {
  const V3d way = source.isDistant() ? source.center : source.center - from;
  const double distance = way.length();
  SourcePart whole{.distant = source.isDistant(), .center = source.center};
  bool isRound = false;
  const auto setRound = [&](double radius) {
    isRound = true;
    std::tie(whole.u, whole.v) = frame(way / distance, radius);
  };
  match(
      source.shape,
      [&](const PlaneLight& plane) {
        isRound = std::holds_alternative<PlaneLight::Disk>(plane.map);
        whole.u = plane.u;
        whole.v = plane.v;
      },
      [&](const BallLight&) { setRound(source.radius); },
      [&](const TubeLight& tube) {
        whole.u = tube.half;
        whole.v = acrossTube(tube, way);
      },
      [&](const DistantLight&) { setRound(source.outermost); });
  if (isRound) whole.variance = 1. / 4;
  const auto divided = [&](const V3d& half) {
    if (isRound) return 1.;
    return std::clamp(std::ceil(half.length() / (tuning::Highlights::kHalf * distance)), 1., kMostAlong);
  };
  const double columns = divided(whole.u), rows = divided(whole.v);
  whole.u /= columns;
  whole.v /= rows;
  whole.radius = std::hypot(whole.u.length(), whole.v.length());
  std::vector<SourcePart> parts;
  for (double row = 0; row < rows; ++row)
    for (double column = 0; column < columns; ++column) {
      parts.push_back(whole);
      parts.back().center += (2 * column + 1 - columns) * whole.u + (2 * row + 1 - rows) * whole.v;
    }
  return parts;
}

}  // namespace

double LightingPart::solidAngle(const V3d& from) const {
  if (const auto* cone = source->as<DistantLight>()) return share * 2 * kPi * (1 - cone->cosHalfAngle);
  const V3d way = part.towards(from);
  const double squared = way.length2(), distance = std::sqrt(squared);
  const double area = match(
      source->shape,
      [&](const PlaneLight& plane) { return plane.area * std::max(0., -plane.normal.dot(way)) / distance; },
      [&](const BallLight&) { return kPi * source->radius * source->radius; },
      [&](const TubeLight& tube) {
        return tube.area * tube.half.cross(way).length() / (tube.half.length() * distance);
      },
      [](const DistantLight&) { return 0.; });
  return share * std::min(2 * kPi, area / squared);
}

std::vector<LightingPart> partsThatLight(const LightSource& source, const V3d& from, double radius,
                                         const Scene& scene) {
  if (source.isVirtual()) return {};
  if (!source.isDistant()) {
    const V3d way = source.center - from;
    const double apart = way.length() - radius;
    if (!(apart > 0) || (source.reach > 0 && apart - source.radius > source.reach)) return {};
    if (source.spot && outsideSpot(*source.spot, way.normalized())) return {};
  }
  const double radiance = brightness(sourceRadiance(scene, scene.surfaces[source.surface]));
  if (!(radiance > 0)) return {};
  const std::vector<SourcePart> parts = partsOf(source, from);
  std::vector<LightingPart> lighting;
  for (const SourcePart& part : parts)
    lighting.push_back({part, &source, radiance, 1 / static_cast<double>(parts.size())});
  return lighting;
}

bool seesPart(const Tracer& tracer, const LightingPart& lighting, const V3d& from) {
  const SourcePart& part = lighting.part;
  const V3d middle = part.towards(from);
  for (const auto& [a, b] :
       {std::pair(0., 0.), std::pair(.5, .5), std::pair(-.5, .5), std::pair(-.5, -.5), std::pair(.5, -.5)}) {
    const V3d way = middle + a * part.u + b * part.v;
    const double distance = part.distant ? kFarAway : way.length();
    if (tracer.shadow(from, way.normalized(), distance, lighting.source->surface) != Shadow::blocked)
      return true;
  }
  return false;
}

double usualRadiance(const Scene& scene, const Tracer& tracer, const LightSources& lights) {
  const V3d size = tracer.bounds().size();
  // scene.area() lacks surfaces in octrees and meshes, so that the area of the bounds is a lower limit.
  const double area = std::max(scene.area(), 2 * (size.x * size.y + size.y * size.z + size.z * size.x));
  double power = 0;
  for (const LightSource& light : lights.all())
    if (!light.isVirtual()) power += powerOf(scene, light, size.length() / 2);
  return kMeanReflectance * power / (kPi * area);
}

}  // namespace rsphere
