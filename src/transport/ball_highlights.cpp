#include "transport/ball_highlights.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "scene/frame.h"
#include "transport/ball_reflection.h"

namespace rsphere {
namespace {

using Tuning = tuning::BallHighlights;

// Square of the error of a vector in single precision relative to its length, times 100: with a hundredth of the
// square of a radius, it then exceeds the error of the square of a distance from an axis that is near to the radius.
constexpr float kRounding = 2e-11f;

// The solid angle (sr) of a source as seen from a place that is not near to it, as if all of it were where one part is.
// way: from the place to the middle of that part (world units).
double solidAngleOf(const LightSource& source, const V3d& way) {
  if (source.distant) return 2 * kPi * (1 - source.cosHalfAngle);
  const double squared = way.length2(), distance = std::sqrt(squared);
  double area = kPi * source.radius * source.radius;
  if (source.isPlane()) area = source.area * std::max(0., -source.normal.dot(way)) / distance;
  if (source.map == LightSource::Map::tube)
    area = source.area * source.u.cross(way).length() / (source.u.length() * distance);
  return std::min(2 * kPi, area / squared);
}

// The light that all sources send out (W, of brightness). reach: of the scene (world units), within which distant
// sources shine.
double powerOf(const Scene& scene, const LightSources& lights, double reach) {
  double power = 0;
  for (const LightSource& light : lights.all()) {
    if (light.isVirtual()) continue;
    const Surface& surface = scene.surfaces[light.surface];
    const auto* distant = std::get_if<Distant>(&surface.shape);
    power += brightness(sourceRadiance(scene, surface)) * kPi *
             (distant ? distant->solidAngle * reach * reach : areaOf(surface.shape));
  }
  return power;
}

}  // namespace

// The highlight of a part of a source on a ball as seen from a point: a normal distribution of directions in two
// dimensions, projected from a plane. Directions and the vector between the normal and the bisector of the directions to
// the point and to the source, by which the roughness is defined, are linear functions of the place on the ball.
class BallHighlights::Lobe {
 public:
  Lobe(const Ball& ball, const Part& part, const V3d& point) {
    const V3d normal = mirroringNormal(ball.sphere, point, part.center, part.distant);
    const V3d at = ball.sphere.center + ball.sphere.radius * normal;
    const double length = (point - at).length();
    const V3d in = (point - at) / length, way = part.towards(at);
    const double toSource = way.length();
    const V3d out = way / toSource;
    const double cosine = std::max(normal.dot(in), Tuning::kGrazing);
    // The tangents across the plane of reflection and in it. x_, y_: the same directions as seen from the point.
    V3d across = normal.cross(in);
    if (across.length2() > 1e-12) {
      across.normalize();
    } else {
      V3d other;
      frame(normal, across, other);
    }
    const V3d along = across.cross(normal);
    axis_ = -in;
    x_ = across;
    y_ = (along - along.dot(in) * in).normalized();
    // How fast the bisector and the normal part, and how fast the direction turns, per length on the ball.
    const double bends = 1 / length + (part.distant ? 0 : 1 / toSource), curved = 1 / ball.sphere.radius;
    const double acrossRate = 1 / length / (curved + bends / (2 * cosine)),
                 alongRate = cosine / length / (curved + bends * cosine / 2);
    // Twice the covariance of the normal's distance from the bisectors of all points of the source.
    double xx = ball.roughness * ball.roughness, xy = 0, yy = xx;
    for (const V3d& half : {part.u, part.v}) {
      const V3d angle = (half - half.dot(out) * out) / (part.distant ? 1 : toSource);
      const double x = angle.dot(across) / (2 * cosine), y = angle.dot(along) / (2 * cosine);
      xx += 2 * part.variance * x * x;
      xy += 2 * part.variance * x * y;
      yy += 2 * part.variance * y * y;
    }
    const double a = Tuning::kWider * acrossRate, b = Tuning::kWider * alongRate;
    // Its Cholesky factor.
    xx_ = a * std::sqrt(xx);
    yx_ = b * xy / std::sqrt(xx);
    yy_ = b * std::sqrt(std::max(yy - xy * xy / xx, 0.));
  }

  V3d sample(double u1, double u2) const {
    const double radius = std::sqrt(-std::log1p(-u1)), angle = 2 * kPi * u2;
    const double x = radius * std::cos(angle), y = radius * std::sin(angle);
    return (axis_ + xx_ * x * x_ + (yx_ * x + yy_ * y) * y_).normalized();
  }
  double density(const V3d& direction) const {
    const double cosine = direction.dot(axis_);
    if (!(cosine > 0)) return 0;
    const double x = direction.dot(x_) / cosine / xx_, y = (direction.dot(y_) / cosine - yx_ * x) / yy_;
    return std::exp(-x * x - y * y) / (kPi * xx_ * yy_ * cosine * cosine * cosine);
  }

 private:
  V3d axis_, x_, y_;  // unit
  double xx_ = 0, yx_ = 0, yy_ = 0;
};

BallHighlights::BallHighlights(const Scene& scene, const Tracer& tracer, const LightSources& lights) {
  if (tracer.bounds().isEmpty()) return;
  struct Asked {
    const Sphere* sphere;
    const Opaque* material;
  };
  std::vector<Asked> asked;
  for (const Surface& surface : scene.outermost()) {
    const auto* sphere = std::get_if<Sphere>(&surface.shape);
    const Material* any = sphere && !sphere->inward ? scene.materialOf(surface) : nullptr;
    const auto* material = any ? std::get_if<Opaque>(any) : nullptr;
    if (!material || !(material->roughness * material->roughness > kNegligible)) continue;
    if (material->specularity > 0) asked.push_back({sphere, material});
  }
  if (asked.empty()) return;
  std::stable_sort(asked.begin(), asked.end(),
                   [](const Asked& a, const Asked& b) { return a.sphere->radius > b.sphere->radius; });
  if (asked.size() > Tuning::kMostAsked) asked.resize(Tuning::kMostAsked);
  for (const Asked& a : asked)
    if (Ball ball = lit(*a.sphere, *a.material, scene, tracer, lights); ball.intensity > 0)
      balls_.push_back(std::move(ball));
  std::stable_sort(balls_.begin(), balls_.end(),
                   [](const Ball& a, const Ball& b) { return a.intensity > b.intensity; });
  if (balls_.size() > Tuning::kMost) balls_.resize(Tuning::kMost);
  const V3d size = tracer.bounds().size();
  double area = 0;
  for (const Surface& s : scene.outermost()) area += areaOf(s.shape);
  // Surfaces in octrees and meshes are not looked at.
  area = std::max(area, 2 * (size.x * size.y + size.y * size.z + size.z * size.x));
  usual_ = Tuning::kMeanReflectance * powerOf(scene, lights, size.length() / 2) / (kPi * area);
  origin_ = tracer.bounds().center();
  rounding_ = kRounding * static_cast<float>(size.length2());
  for (const Ball& ball : balls_) {
    const size_t i = count_++;
    const V3d center = ball.sphere.center - origin_;
    x_[i] = static_cast<float>(center.x);
    y_[i] = static_cast<float>(center.y);
    z_[i] = static_cast<float>(center.z);
    radius_[i] = static_cast<float>(ball.sphere.radius);
    intensity_[i] = static_cast<float>(ball.intensity);
    hot_[i] = static_cast<float>(ball.hot);
  }
}

std::vector<BallHighlights::Part> BallHighlights::partsOf(const LightSource& source, const Sphere& ball) {
  const V3d way = source.distant ? source.center : source.center - ball.center;
  const double distance = way.length();
  const bool isRound = source.map == LightSource::Map::disk || source.map == LightSource::Map::ball ||
                       source.map == LightSource::Map::cone;
  Part whole{.distant = source.distant, .center = source.center, .u = source.u, .v = source.v};
  if (isRound) whole.variance = 1. / 4;
  if (source.map == LightSource::Map::tube)
    whole.v = source.u.cross(way).normalized() * (source.area / (4 * source.u.length()));
  if (isRound && !source.isPlane()) {
    const double radius = source.distant ? source.outermost : source.radius;
    frame(way / distance, whole.u, whole.v);
    whole.u *= radius;
    whole.v *= radius;
  }
  const auto divided = [&](const V3d& half) {
    if (isRound) return 1.;
    return std::clamp(std::ceil(half.length() / (Tuning::kHalfPart * distance)), 1., Tuning::kMostParts);
  };
  const double columns = divided(whole.u), rows = divided(whole.v);
  whole.u /= columns;
  whole.v /= rows;
  whole.radius = std::hypot(whole.u.length(), whole.v.length());
  std::vector<Part> parts;
  for (double row = 0; row < rows; ++row)
    for (double column = 0; column < columns; ++column) {
      parts.push_back(whole);
      parts.back().center += (2 * column + 1 - columns) * whole.u + (2 * row + 1 - rows) * whole.v;
    }
  return parts;
}

// Whether a place sees the middle of a part, or one of the places halfway to its ends.
bool BallHighlights::sees(const Tracer& tracer, SurfaceId source, const Part& part, const V3d& at) {
  const V3d middle = part.towards(at);
  for (const auto& [a, b] :
       {std::pair(0., 0.), std::pair(.5, .5), std::pair(-.5, .5), std::pair(-.5, -.5), std::pair(.5, -.5)}) {
    const V3d way = middle + a * part.u + b * part.v;
    const double distance = part.distant ? kFarAway : way.length();
    if (tracer.shadow(at, way.normalized(), distance, source) != Shadow::blocked) return true;
  }
  return false;
}

// The sources that light a ball. A ball sends distant light on evenly in all directions: the image of a source fills
// its solid angle as seen from the ball, times the square of the ball's radius over twice the distance to it.
BallHighlights::Ball BallHighlights::lit(const Sphere& sphere, const Opaque& material, const Scene& scene,
                                         const Tracer& tracer, const LightSources& lights) {
  Ball ball{sphere, material.roughness, 0, 0, {}};
  const double reflectance = material.specularity * (material.metal ? brightness(material.color) : 1);
  struct Candidate {
    Part part;
    SurfaceId surface;
    double solidAngle, intensity;
  };
  std::vector<Candidate> candidates;
  for (const LightSource& source : lights.all()) {
    if (source.isVirtual()) continue;
    const V3d way = source.center - sphere.center;
    if (!source.distant) {
      const double apart = way.length() - sphere.radius;
      if (!(apart > 0) || (source.reach > 0 && apart - source.radius > source.reach)) continue;
      if (source.spot && outsideSpot(*source.spot, way.normalized())) continue;
    }
    const double radiance = brightness(sourceRadiance(scene, scene.surfaces[source.surface]));
    if (!(radiance > 0)) continue;
    const std::vector<Part> parts = partsOf(source, sphere);
    for (const Part& part : parts) {
      const double solidAngle =
          solidAngleOf(source, part.towards(sphere.center)) / static_cast<double>(parts.size());
      const double intensity = radiance * reflectance * solidAngle * sphere.radius * sphere.radius / 4;
      if (intensity > 0) candidates.push_back({part, source.surface, solidAngle, intensity});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.intensity > b.intensity; });
  if (candidates.size() > Tuning::kMostOfBall) candidates.resize(Tuning::kMostOfBall);
  for (const Candidate& c : candidates) {
    const V3d out = c.part.towards(sphere.center).normalized();
    if (!sees(tracer, c.surface, c.part, sphere.center + (sphere.radius + 2 * kSamePlace) * out)) continue;
    ball.intensity += c.intensity;
    ball.parts.push_back(c.part);
    ball.parts.back().upTo = ball.intensity;
    // By the mean square of a normal distribution, whose variance is that of a disk of the source's solid angle.
    const double spread =
        sphere.radius * sphere.radius * (ball.roughness * ball.roughness + c.solidAngle / (8 * kPi));
    ball.hot += c.intensity * c.intensity / (2 * kPi * kPi * spread);
  }
  for (Part& part : ball.parts) part.upTo /= ball.intensity;
  return ball;
}

// As from a small source. From nearby, an image is as far behind the ball's surface as the focus, half its radius.
__attribute__((target_clones("avx2", "default"))) void BallHighlights::aim(const V3d& point, const V3d& front,
                                                                           double least, Aim& aim) const {
  const auto atX = static_cast<float>(point.x - origin_.x), atY = static_cast<float>(point.y - origin_.y),
             atZ = static_cast<float>(point.z - origin_.z);
  const auto frontX = static_cast<float>(front.x), frontY = static_cast<float>(front.y),
             frontZ = static_cast<float>(front.z);
  Numbers squared, falloff;
  float most = 0;
  for (size_t i = 0; i < count_; ++i) {
    const float x = x_[i] - atX, y = y_[i] - atY, z = z_[i] - atZ;
    const float distance = std::sqrt(x * x + y * y + z * z), inverse = 1 / distance;
    const float cosine = (x * frontX + y * frontY + z * frontZ + radius_[i]) * inverse;
    const float before = std::min(std::max(cosine, 0.f), 1.f);
    const float apart = distance > Tuning::kApart * radius_[i] ? 1.f : 0.f;
    const float toImage = 1 / (distance - .5f * radius_[i]);
    falloff[i] = apart * before * toImage * toImage;
    squared[i] = hot_[i] * falloff[i];
    most = std::max(most, squared[i]);
  }
  aim.count = 0;
  aim.mean = 0;
  if (!(most > least)) return;
  aim.point = point;
  float sum = 0;
  for (size_t i = 0; i < count_; ++i) {
    if (!(squared[i] > least)) continue;
    const size_t k = aim.count++;
    const float x = x_[i] - atX, y = y_[i] - atY, z = z_[i] - atZ;
    aim.x[k] = x;
    aim.y[k] = y;
    aim.z[k] = z;
    aim.beside2[k] = 1.01f * radius_[i] * radius_[i] + kRounding * (x * x + y * y + z * z) + rounding_;
    aim.ball[k] = static_cast<uint32_t>(i);
    aim.sum[k] = sum += intensity_[i] * falloff[i];
  }
  aim.mean = sum / kPi;
}

// Whether a ray meets a ball, and the normal there.
bool BallHighlights::meets(const Ball& ball, const V3d& point, const V3d& direction, V3d& normal) {
  const V3d way = ball.sphere.center - point;
  const double along = way.dot(direction);
  const V3d beside = along * direction - way;
  const double squared = ball.sphere.radius * ball.sphere.radius - beside.length2();
  if (!(along > 0 && squared > 0)) return false;
  normal = (beside - std::sqrt(squared) * direction) / ball.sphere.radius;
  return true;
}

// Whether a ray meets a ball where it shows more than a negligible part of a source's highlight. It saves most
// evaluations of lobes.
bool BallHighlights::isNear(const Ball& ball, const Part& part, const V3d& direction, const V3d& normal) {
  const V3d way = part.towards(ball.sphere.center + ball.sphere.radius * normal);
  const double distance = way.length(), angle = part.radius / (part.distant ? 1 : distance);
  const V3d bisector = way / distance - direction;
  const double cosine = normal.dot(bisector);
  if (!(cosine > 0)) return false;
  // bisector has twice the length of its cosine to both directions.
  const double most = (Tuning::kReach * ball.roughness + angle / std::max(cosine, Tuning::kGrazing)) * cosine;
  return bisector.length2() - cosine * cosine <= most * most;
}

V3d BallHighlights::sample(const Aim& aim, double u1, double u2, double u3) const {
  const double due = u1 * aim.sum[aim.count - 1];
  size_t i = 0;
  while (i + 1 < aim.count && !(due < aim.sum[i])) ++i;
  const Ball& ball = balls_[aim.ball[i]];
  const double before = i > 0 ? aim.sum[i - 1] : 0, share = (due - before) / (aim.sum[i] - before);
  size_t k = 0;
  while (k + 1 < ball.parts.size() && !(share < ball.parts[k].upTo)) ++k;
  const Part& part = ball.parts[k];
  const V3d direction = Lobe(ball, part, aim.point).sample(u2, u3);
  V3d normal;
  const bool counts = meets(ball, aim.point, direction, normal) && isNear(ball, part, direction, normal);
  return counts ? direction : V3d(0, 0, 0);
}

__attribute__((target_clones("avx2", "default"))) double BallHighlights::density(const Aim& aim,
                                                                                 const V3d& direction) const {
  const auto dx = static_cast<float>(direction.x), dy = static_cast<float>(direction.y),
             dz = static_cast<float>(direction.z);
  std::array<bool, kRoom> in;
  bool any = false;
  for (size_t i = 0; i < aim.count; ++i) {
    const float x = aim.x[i], y = aim.y[i], z = aim.z[i];
    // The cross product is precise for small angles; the cosine is not.
    const float cx = y * dz - z * dy, cy = z * dx - x * dz, cz = x * dy - y * dx;
    in[i] = (cx * cx + cy * cy + cz * cz <= aim.beside2[i]) & (x * dx + y * dy + z * dz > 0);
    any |= in[i];
  }
  return any ? densityOf(aim, direction, in) : 0;
}

double BallHighlights::densityOf(const Aim& aim, const V3d& direction,
                                 const std::array<bool, kRoom>& in) const {
  double sum = 0;
  for (size_t i = 0; i < aim.count; ++i) {
    const double chance = i > 0 ? aim.sum[i] - aim.sum[i - 1] : aim.sum[i];
    const Ball& ball = balls_[aim.ball[i]];
    V3d normal;
    if (!in[i] || !(chance > 0) || !meets(ball, aim.point, direction, normal)) continue;
    double before = 0;
    for (const Part& part : ball.parts) {
      const double share = part.upTo - before;
      before = part.upTo;
      if (!isNear(ball, part, direction, normal)) continue;
      sum += chance * share * Lobe(ball, part, aim.point).density(direction);
    }
  }
  return sum / aim.sum[aim.count - 1];
}

}  // namespace rsphere
