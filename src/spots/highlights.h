#pragma once
// Highlights of light sources on rough balls and cylinders, at which indirect rays are aimed
// (ball_highlights.h, cylinder_highlights.h).

#include "openings/light_finder.h"
#include "spots/ball_highlights.h"
#include "spots/cylinder_highlights.h"
#include "spots/tuning.h"

namespace rsphere {

class Highlights {
 public:
  // Keeps a reference to lights.
  Highlights(const Scene& scene, const Tracer& tracer, const LightSources& lights)
      : usual_(anyOn(scene) ? usualRadiance(scene, tracer, lights) : 0),
        balls_(scene, tracer, lights, least(usual_)),
        cylinders_(scene, tracer, lights, least(usual_)) {}

  bool empty() const { return balls_.empty() && cylinders_.empty(); }
  // An estimate of the mean brightness (W/sr/m2) of all surfaces under the light of the sources.
  double usual() const { return usual_; }

  // The sampling distribution for a point of a diffuse surface.
  struct Aim {
    double mean = 0;  // mean radiance over the hemisphere from these highlights, W/sr/m2, without occlusion
    BallHighlights::Aim balls;
    CylinderHighlights::Aim cylinders;
  };

  // See LightFinder. Highlights that add little variance relative to from.all are ignored. If there are few
  // rays, only the brightest balls are used, because finding highlights takes as long as tracing some rays.
  static constexpr AimedAt kKind = AimedAt::highlights;
  void aim(const AimFrom& from, Aim& aim) const {
    const bool few = from.rays < tuning::Highlights::kMany;
    balls_.aim(from.point, from.normal, (few ? tuning::Highlights::kLeastOfFew : 1) * least(from.all),
               aim.balls);
    if (!few) cylinders_.aim(from.point, from.normal, least(from.all), aim.cylinders);
    aim.mean = aim.balls.mean + aim.cylinders.mean;
  }

  V3d sample(const Aim& aim, double u1, double u2, double u3) const {
    const double toBalls = aim.balls.mean / aim.mean;
    if (u1 < toBalls) return balls_.sample(aim.balls, u1 / toBalls, u2, u3);
    return cylinders_.sample(aim.cylinders, (u1 - toBalls) / (1 - toBalls), u2, u3);
  }

  // It integrates to less than 1, because some directions of sample() miss the highlight.
  double density(const Aim& aim, const V3d& direction) const {
    double sum = 0;
    if (aim.balls.mean > 0) sum += aim.balls.mean * balls_.density(aim.balls, direction);
    if (aim.cylinders.mean > 0) sum += aim.cylinders.mean * cylinders_.density(aim.cylinders, direction);
    return sum / aim.mean;
  }

 private:
  static_assert(kShapes == 8, "Do highlights of a new shape need directions?");
  static bool anyOn(const Scene& scene) {
    for (const Surface& surface : scene.outermost())
      if ((surface.shape.as<Sphere>() || surface.shape.as<Cone>()) && roughReflector(scene, surface))
        return true;
    return false;
  }
  static double least(double radiance) { return tuning::Highlights::kLeast * radiance * radiance; }

  double usual_;
  BallHighlights balls_;
  CylinderHighlights cylinders_;
};

}  // namespace rsphere
