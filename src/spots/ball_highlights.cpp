#include "spots/ball_highlights.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "spots/ball_reflection.h"
#include "spots/tuning.h"

namespace rsphere {

HighlightLobe BallHighlights::lobeOf(const Ball& ball, const SourcePart& part, const V3d& point) {
  const V3d normal = mirroringNormal(ball.sphere, point, part.center, part.distant);
  return Highlight(ball.sphere.center + ball.sphere.radius * normal, normal, {.radius = ball.sphere.radius},
                   ball.roughness, part, point)
      .lobe;
}

BallHighlights::BallHighlights(const Scene& scene, const Tracer& tracer, const LightSources& lights,
                               double least) {
  const auto size = [](const Sphere& sphere) { return sphere.inward ? 0 : sphere.radius; };
  const auto reflectors = largestReflectors<Sphere>(scene, tuning::Caps::kAsked, size);
  if (reflectors.empty()) return;
  const BrightestSources sources(scene, lights);
  for (const auto& r : reflectors)
    if (Ball ball = lit(*r.shape, *r.material, tracer, sources); ball.intensity > 0)
      balls_.push_back(std::move(ball));
  keepLargest(balls_, balls_.size(), [](const Ball& ball) { return ball.intensity; });
  std::vector<ReachGrid::Reach> reaches;
  for (const Ball& ball : balls_)
    reaches.push_back(
        {ball.sphere.center, ball.sphere.center, ball.sphere.radius / 2 + std::sqrt(ball.hot / least)});
  if (!reaches.empty()) near_ = ReachGrid(reaches, tracer.bounds());
}

// Finds the sources that light a ball. A mirroring ball of radius r distributes the light of a distant source
// uniformly over all directions: at a distance d, the solid angle of the source's image is (r / 2d)^2 times
// the solid angle of the source as seen from the ball.
BallHighlights::Ball BallHighlights::lit(const Sphere& sphere, const Opaque& material, const Tracer& tracer,
                                         const BrightestSources& sources) {
  Ball ball{sphere, material.roughness, 0, 0, {}};
  const double reflectance = reflectanceOf(material);
  struct Candidate {
    LightingPart part;
    double solidAngle, intensity;
  };
  std::vector<Candidate> candidates;
  const auto placeFor = [&](const LightSource&) { return sphere.center; };
  for (const LightingPart& part :
       sources.at(Box3d(sphere.center), sphere.radius, tuning::Caps::kAimed, placeFor)) {
    const double solidAngle = part.solidAngle(sphere.center);
    const double intensity = part.radiance * reflectance * solidAngle * sphere.radius * sphere.radius / 4;
    if (intensity > 0) candidates.push_back({part, solidAngle, intensity});
  }
  keepLargest(candidates, tuning::Caps::kAimed, [](const Candidate& c) { return c.intensity; });
  for (const Candidate& c : candidates) {
    const V3d out = c.part.part.towards(sphere.center).normalized();
    if (!seesPart(tracer, c.part, sphere.center + (sphere.radius + 2 * tracer.samePlace()) * out)) continue;
    ball.intensity += c.intensity;
    ball.parts.push_back({c.part.part, ball.intensity});
    // The highlight is approximated by a normal distribution of directions. Its variance includes that of a
    // disk with the source's solid angle.
    const double spread =
        sphere.radius * sphere.radius * (ball.roughness * ball.roughness + c.solidAngle / (8 * kPi));
    ball.hot += c.intensity * c.intensity / (2 * kPi * kPi * spread);
  }
  for (Part& part : ball.parts) part.upTo /= ball.intensity;
  return ball;
}

// Each ball is treated as a small source. For points nearby, its images lie at its focus, half a radius below
// the surface.
void BallHighlights::aim(const V3d& point, const V3d& front, double least, Aim& aim) const {
  aim.clear();
  for (const uint32_t number : near_.at(point)) {
    const Ball& ball = balls_[number];
    const V3d way = ball.sphere.center - point;
    const double distance = way.length();
    if (!(distance > tuning::Highlights::kApart * ball.sphere.radius)) continue;
    const double cosine = std::clamp((way.dot(front) + ball.sphere.radius) / distance, 0., 1.);
    const double toImage = distance - ball.sphere.radius / 2, falloff = cosine / (toImage * toImage);
    if (!(ball.hot * falloff > least)) continue;
    aim.way[aim.count] = way;
    // Reduced by more than rounding errors, so that no direction towards the ball is rejected.
    aim.tangent2[aim.count] =
        (1 - 1e-12) * distance * distance - 1.0001 * ball.sphere.radius * ball.sphere.radius;
    aim.add(number, ball.intensity * falloff);
    if (aim.count == tuning::Caps::kAimed) break;
  }
  aim.finish(point);
}

// Whether a ray meets a ball; sets the normal at the hit.
bool BallHighlights::meets(const Ball& ball, const V3d& point, const V3d& direction, V3d& normal) {
  const V3d way = ball.sphere.center - point;
  const double along = way.dot(direction);
  const V3d beside = along * direction - way;
  const double squared = ball.sphere.radius * ball.sphere.radius - beside.length2();
  if (!(along > 0 && squared > 0)) return false;
  normal = (beside - std::sqrt(squared) * direction) / ball.sphere.radius;
  return true;
}

// Whether a ray meets a ball at a point where a source's highlight is not negligible. This test avoids most
// evaluations of lobes.
bool BallHighlights::isNear(const Ball& ball, const SourcePart& part, const V3d& direction,
                            const V3d& normal) {
  const V3d way = part.towards(ball.sphere.center + ball.sphere.radius * normal);
  const double distance = way.length(), angle = part.radius / (part.distant ? 1 : distance);
  const V3d bisector = way / distance - direction;
  const double cosine = normal.dot(bisector);
  if (!(cosine > 0)) return false;
  // The length of bisector is twice its cosine with both directions.
  const double most =
      (tuning::Highlights::kReach * ball.roughness + angle / std::max(cosine, tuning::Highlights::kEdgeOn)) *
      cosine;
  return bisector.length2() - cosine * cosine <= most * most;
}

V3d BallHighlights::sample(const Aim& aim, double u1, double u2, double u3) const {
  const size_t i = aim.chosen(u1);
  const Ball& ball = balls_[aim.number[i]];
  const double share = (u1 * aim.before(aim.count) - aim.before(i)) / (aim.upTo[i] - aim.before(i));
  size_t k = 0;
  while (k + 1 < ball.parts.size() && !(share < ball.parts[k].upTo)) ++k;
  const SourcePart& part = ball.parts[k].source;
  const V3d direction = lobeOf(ball, part, aim.point).sample(u2, u3);
  V3d normal;
  const bool counts = meets(ball, aim.point, direction, normal) && isNear(ball, part, direction, normal);
  return counts ? direction : V3d(0, 0, 0);
}

double BallHighlights::density(const Aim& aim, const V3d& direction) const {
  double sum = 0;
  for (size_t i = 0; i < aim.count; ++i) {
    const double along = aim.way[i].dot(direction);
    if (!(along > 0 && along * along > aim.tangent2[i])) continue;  // rejects most directions
    const Ball& ball = balls_[aim.number[i]];
    V3d normal;
    if (!meets(ball, aim.point, direction, normal)) continue;
    const double chance = aim.upTo[i] - aim.before(i);
    double before = 0;
    for (const Part& part : ball.parts) {
      const double share = part.upTo - before;
      before = part.upTo;
      if (!isNear(ball, part.source, direction, normal)) continue;
      sum += chance * share * lobeOf(ball, part.source, aim.point).density(direction);
    }
  }
  return aim.count > 0 ? sum / aim.before(aim.count) : 0;
}

}  // namespace rsphere
