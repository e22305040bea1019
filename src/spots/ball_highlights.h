#pragma once
// Highlights of light sources on rough balls, such as chrome knobs, feet and handles. A ball reflects the
// light of a source in all directions, from a highlight that is far smaller and brighter than the ball. Where
// gathers hit highlights only by chance, these cause much of the variance of indirect light beside a ball.
// Some rays are therefore aimed at them, with multiple importance sampling (balance heuristic: Veach and
// Guibas 1995). The place of a highlight follows from the law of reflection; its extent follows from the
// curvature, the roughness and the source. Highlights that are missed or misplaced change the variance, not
// the mean.
//
// Smooth balls are ignored: as in rtrace, light sources mirrored by smooth surfaces are not visible to
// indirect rays.
#include "openings/proposals.h"
#include "openings/tuning.h"
#include "spots/brightest_sources.h"
#include "spots/highlight_choice.h"
#include "spots/reach_grid.h"

namespace rsphere {

class BallHighlights {
 public:
  // Uses spheres of plastic or metal. Shadow rays find the sources that each sphere sees. Keeps no
  // references. least: see aim(); above 0. Points at which a ball's highlights add less than this to the
  // variance ignore the ball.
  BallHighlights(const Scene& scene, const Tracer& tracer, const LightSources& lights, double least);

  bool empty() const { return balls_.empty(); }
  static constexpr size_t kRoom = tuning::Caps::kAimed;

  // The sampling distribution for a point of a diffuse surface. Each element represents the highlights of one
  // ball.
  struct Aim : Proposals<kRoom> {
    std::array<V3d, kRoom> way;  // vectors to the centers of the balls (world units)
    // Upper bound on the squared distance to the point where a tangent touches the ball (square world units).
    std::array<double, kRoom> tangent2;
  };

  // front: unit normal. least: threshold (square of W/sr/m2) for the estimated variance that a ball's
  // highlights add to the radiance from one direction, if directions are sampled by projected solid angle.
  // Balls below it are ignored.
  void aim(const V3d& point, const V3d& front, double least, Aim& aim) const;

  // See Highlights (highlights.h).
  V3d sample(const Aim& aim, double u1, double u2, double u3) const;
  double density(const Aim& aim, const V3d& direction) const;

 private:
  struct Part {
    SourcePart source;
    double upTo = 0;  // cumulative fraction of the ball's intensity
  };
  struct Ball {
    Sphere sphere;
    double roughness = 0;
    double intensity = 0;  // W/sr, of brightness, in every direction
    double hot = 0;        // mean square radiance seen from a point = hot * cosine / distance^2
    std::vector<Part> parts;
  };

  static Ball lit(const Sphere& sphere, const Opaque& material, const Tracer& tracer,
                  const BrightestSources& sources);
  static HighlightLobe lobeOf(const Ball& ball, const SourcePart& part, const V3d& point);
  static bool meets(const Ball& ball, const V3d& point, const V3d& direction, V3d& normal);
  static bool isNear(const Ball& ball, const SourcePart& part, const V3d& direction, const V3d& normal);

  std::vector<Ball> balls_;
  ReachGrid near_;
};

}  // namespace rsphere
