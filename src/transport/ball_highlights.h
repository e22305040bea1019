#pragma once
// Highlights of light sources on rough balls: chrome knobs, feet and handles. A ball sends the light of a
// source in all directions, from a highlight that is far smaller and brighter than the ball. If rays of a
// gather meet highlights only by chance, they cause much of the variance of indirect light beside the ball.
// Some rays are therefore aimed at them and combined with the others by multiple importance sampling (balance
// heuristic: Veach and Guibas 1995). The law of reflection gives the place of a highlight; curvature,
// roughness and the source give its extent. Highlights that are hidden or misplaced change the variance, not
// the mean.
//
// Smooth balls have none: an indirect ray that a smooth surface mirrors to a light source adds nothing, as in
// rtrace.
#include "transport/highlight_choice.h"
#include "transport/proposals.h"
#include "transport/reach_grid.h"
#include "transport/tuning.h"

namespace rsphere {

class BallHighlights {
 public:
  // Uses spheres of plastic or metal. Shadow rays find which sources each of them sees. Keeps no references.
  // least: a ball is ignored at points where its highlights add less than this to the variance, as in aim();
  // above 0.
  BallHighlights(const Scene& scene, const Tracer& tracer, const LightSources& lights, double least);

  bool empty() const { return balls_.empty(); }
  static constexpr size_t kRoom = tuning::Caps::kAimedRoom;

  // The sampling distribution for a point of a diffuse surface. Each element is the highlights of one ball.
  struct Aim : Proposals<kRoom> {
    std::array<V3d, kRoom> way;  // vectors to the centers of the balls (world units)
    // Upper bound of the squared distance along a tangent (square world units).
    std::array<double, kRoom> tangent2;
  };

  // front: unit normal. least: threshold below which a ball is left out (square of W/sr/m2). It is compared
  // with the variance that the ball's highlights are estimated to add to the radiance from a direction drawn
  // by projected solid angle.
  void aim(const V3d& point, const V3d& front, double least, Aim& aim) const;

  // As in Highlights (highlights.h).
  V3d sample(const Aim& aim, double u1, double u2, double u3) const;
  double density(const Aim& aim, const V3d& direction) const;

 private:
  struct Part {
    SourcePart source;
    double upTo = 0;  // cumulative share of the ball's intensity
  };
  struct Ball {
    Sphere sphere;
    double roughness = 0;
    double intensity = 0;  // W/sr, of brightness, sent into every direction
    double hot = 0;        // the mean square of its radiance is this times cosine / distance^2
    std::vector<Part> parts;
  };

  static Ball lit(const Sphere& sphere, const Opaque& material, const Scene& scene, const Tracer& tracer,
                  const LightSources& lights);
  static HighlightLobe lobeOf(const Ball& ball, const SourcePart& part, const V3d& point);
  static bool meets(const Ball& ball, const V3d& point, const V3d& direction, V3d& normal);
  static bool isNear(const Ball& ball, const SourcePart& part, const V3d& direction, const V3d& normal);

  std::vector<Ball> balls_;
  ReachGrid near_;
};

}  // namespace rsphere
