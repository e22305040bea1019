#include "targets/glints.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/constants.h"
#include "silhouettes/tuning.h"
#include "spots/ball_reflection.h"
#include "spots/tuning.h"
#include "targets/tuning.h"

namespace rsphere {
namespace {

using std::numbers::pi;

static_assert(kShapes == 8, "Does a new shape mirror sources, or has it corners?");
static_assert(kLightForms == 8, "Is its image that of a parallelogram, a disk or a polygon?");
// A part of a source, small enough that its image in a ball is hardly curved. The members are positions, or
// unit directions if the source is distant.
struct Part {
  V3d middle;
  std::vector<V3d> corners;
};

std::vector<Part> partsOf(const Scene& scene, const LightSource& source, const Sphere& ball) {
  const auto* polygon = scene.surfaces[source.surface].shape.as<Polygon>();
  const auto* plane = source.as<PlaneLight>();
  const bool outlined = polygon && !std::holds_alternative<PlaneLight::Parallelogram>(plane->map);
  if (outlined && polygon->vertices <= static_cast<size_t>(tuning::Silhouettes::kCorners)) {
    const auto first = scene.vertices.begin() + polygon->firstVertex;
    return {{source.center, std::vector<V3d>(first, first + polygon->vertices)}};
  }
  const V3d away = source.isDistant() ? source.center : source.center - ball.center;
  const double distance = std::max(away.length() - ball.radius, scene.samePlace);
  V3d u(0, 0, 0), v(0, 0, 0);
  const auto setRound = [&](const V3d& axis, double radius) { std::tie(u, v) = frame(axis, radius); };
  match(
      source.shape,
      [&](const PlaneLight& flat) {
        u = flat.u;
        v = flat.v;
        if (outlined) setRound(flat.normal, source.radius);
      },
      [&](const BallLight&) { setRound(away.normalized(), source.radius); },
      [&](const TubeLight& tube) {
        u = tube.half;
        v = acrossTube(tube, away);
      },
      [&](const DistantLight& cone) { setRound(away.normalized(), cone.sinHalfAngle); });
  const auto divided = [&](const V3d& half) {
    if (source.isDistant()) return 1;
    return static_cast<int>(std::min(std::ceil(half.length() / (tuning::Highlights::kHalf * distance)),
                                     static_cast<double>(tuning::Silhouettes::kCorners)));
  };
  const int columns = divided(u), rows = divided(v);
  u /= columns;
  v /= rows;
  std::vector<Part> parts;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double alongU = 2 * column + 1 - columns, alongV = 2 * row + 1 - rows;
      Part part{source.center + alongU * u + alongV * v, {}};
      for (const auto& [x, y] :
           {std::pair(1., 1.), std::pair(-1., 1.), std::pair(-1., -1.), std::pair(1., -1.)}) {
        const V3d corner = part.middle + x * u + y * v;
        part.corners.push_back(source.isDistant() ? corner.normalized() : corner);
      }
      parts.push_back(std::move(part));
    }
  return parts;
}

// The approximate solid angle of the source as seen from the ball, `distance` from its surface. It is rather
// too large than too small.
double solidAngleFrom(const LightSource& source, const Sphere& ball, double distance) {
  const auto ofBall = [&] {
    const double sine = std::min(1., source.radius / distance);
    return pi * sine * sine;
  };
  return match(
      source.shape,
      [&](const PlaneLight& plane) {
        const V3d away = ball.center - source.center;
        const double front = (plane.normal.dot(away) + ball.radius) / away.length();
        return plane.area * std::clamp(front, 0., 1.) / (distance * distance);
      },
      [&](const OneOf<BallLight, TubeLight> auto&) { return ofBall(); },
      [](const DistantLight& cone) { return 2 * pi * (1 - cone.cosHalfAngle); });
}

}  // namespace

double mirroredShare(const Material& material) {
  const auto mirrored = mirrorReflection(material);
  if (!mirrored) return 0;
  if (mirrored->boundaries > 0) return kGlassReflectance;
  if (isTransparent(material) || mirrored->roughness > tuning::SpecialObjects::kSharpRoughness) return 0;
  return mirrored->brightness;
}

double leastGlint(double usual) { return tuning::Targets::kLeastGlint * 4 * pi * usual * usual; }

Glints::Glints(const TargetScene& from)
    : prepared_(from.tracing.prepared),
      balls_(ballsAmong(prepared_.scene(), from.objects)),
      // In buildings, this pays even for a few balls, because the sources of each ball are looked up.
      hidden_(prepared_.lights().hidden().blockers(), boxesOf(balls_),
              prepared_.lights().hidden().divides() ? 1 : tuning::SpecialObjects::kFewHidden) {
  const Scene& scene = prepared_.scene();
  const auto& all = prepared_.lights().all();
  lights_.resize(all.size());
  for (const LightId i : all.ids()) {
    if (all[i].isVirtual()) continue;
    const double bright = brightness(sourceRadiance(scene, scene.surfaces[all[i].surface]));
    if (bright > 0) lights_[i] = Light{i, bright};
  }
}

std::vector<Glints::Ball> Glints::ballsAmong(const Scene& scene, std::span<const SpecialObject> objects) {
  std::vector<Ball> balls;
  for (const SpecialObject& object : objects) {
    const auto* sphere = shapeOf(scene, object).as<Sphere>();
    const Surface& surface = scene.surfaces[object.surface];
    if (!sphere || object.several || !surface.shape.as<Sphere>()) continue;
    const Material* material = scene.materialOf(surface);
    const double reflectance = material ? mirroredShare(*material) : 0;
    if (reflectance > 0) balls.push_back({*sphere, reflectance});
  }
  return balls;
}

std::vector<Box3d> Glints::boxesOf(std::span<const Ball> balls) {
  std::vector<Box3d> boxes;
  for (const Ball& ball : balls) boxes.push_back(bounds(ball.sphere));
  return boxes;
}

// Whether `at` sees the source at the middle of a part, or at one of the points halfway and near the end of
// the lines from the middle to its corners and to the middles of its edges. Desks and chairs hide much of a
// source at the floor.
bool Glints::shines(const LightSource& source, std::span<const V3d> corners, const V3d& middle,
                    const V3d& at) const {
  const auto seen = [&](const V3d& place) {
    const V3d direction = source.isDistant() ? place : place - at;
    const double far = source.isDistant() ? kFarAway : direction.length();
    return prepared_.tracer().shadow(at, direction.normalized(), far, source.surface) != Shadow::blocked;
  };
  if (seen(middle)) return true;
  for (const double outward : {.5, .9})
    for (const double along : {0., .5})
      for (size_t i = 0; i < corners.size(); ++i) {
        const V3d edge = corners[i] + along * (corners[(i + 1) % corners.size()] - corners[i]);
        if (seen(middle + outward * (edge - middle))) return true;
      }
  return false;
}

// Adds the images of one light source in one ball.
void Glints::addOf(const Ball& mirror, const Light& light, const V3d& point, double least,
                   std::vector<FoundRegion>& found) const {
  const Sphere& ball = mirror.sphere;
  const double nearest = (point - ball.center).length() - ball.radius;
  const LightSource& source = prepared_.lights().all()[light.source];
  const auto* plane = source.as<PlaneLight>();
  const double distance =
      source.isDistant() ? kFarAway : (source.center - ball.center).length() - ball.radius;
  if (!(distance > 0) || (source.reach > 0 && distance - source.radius > source.reach)) return;
  // A ball of radius r spreads distant light evenly over the sphere. At a distance d, the solid angle of the
  // image is therefore (r / 2d)^2 times that of the source seen from the ball.
  const double reached = ball.radius / nearest, radiance = light.brightness * mirror.reflectance;
  if (!(radiance * radiance * solidAngleFrom(source, ball, distance) * reached * reached / 4 > least)) return;
  const size_t first = found.size();
  std::vector<V3d> around;
  for (const Part& part : partsOf(prepared_.scene(), source, ball)) {
    const V3d normal = mirroringNormal(ball, point, part.middle, source.isDistant());
    const V3d at = ball.center + (ball.radius + 2 * prepared_.tracer().samePlace()) * normal, in = point - at;
    const V3d out = source.isDistant() ? source.center : (part.middle - at).normalized();
    if (!(normal.dot(in) > 0) || (plane && plane->normal.dot(out) >= 0)) continue;
    if (source.spot && outsideSpot(*source.spot, out)) continue;
    if (prepared_.tracer().shadow(at, in.normalized(), in.length(), kNone) == Shadow::blocked) continue;
    if (!shines(source, part.corners, part.middle, at)) continue;
    around.clear();
    for (size_t i = 0; i < part.corners.size(); ++i) {
      const V3d corner = part.corners[i], next = part.corners[(i + 1) % part.corners.size()];
      for (const double share : {0., .5}) {
        const V3d place =
            part.middle + tuning::Highlights::kWider * (corner + share * (next - corner) - part.middle);
        around.push_back(ball.center + ball.radius * mirroringNormal(ball, point, place, source.isDistant()));
      }
    }
    Silhouette region = hullOf(around, point);
    if (region.regionSolidAngle() > 0)
      found.push_back({std::move(region), tuning::Targets::kPartlyLit * radiance, 0, found.size() > first});
  }
}

std::vector<FoundRegion> Glints::find(const V3d& point, double usual) const {
  std::vector<FoundRegion> found;
  if (!(usual > 0)) return found;
  for (const uint32_t i : hidden_.notHiddenFrom(point)) {
    const Sphere& ball = balls_[i].sphere;
    if (!((point - ball.center).length() - ball.radius > 1e-4 * ball.radius)) continue;
    // A ball receives little light from sources that are hidden from its middle.
    for (const uint32_t light : prepared_.lights().hidden().notHiddenFrom(ball.center))
      if (lights_[LightId(light)])
        addOf(balls_[i], *lights_[LightId(light)], point, leastGlint(usual), found);
  }
  return found;
}

}  // namespace rsphere
