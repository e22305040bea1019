#pragma once
// Highlights of light sources on rough balls: chrome knobs, feet and handles. A ball sends the light of a source in all
// directions, from a highlight that is far smaller and brighter than the ball. If rays of a gather meet highlights only
// by chance, they cause much of the variance of indirect light beside the ball. Some rays are therefore aimed at them
// and combined with the others by multiple importance sampling (balance heuristic: Veach and Guibas 1995). The law of
// reflection gives the place of a highlight; curvature, roughness and the source give its extent. Highlights that are
// hidden or misplaced change the variance, not the mean.
//
// Smooth balls have none: an indirect ray that a smooth surface mirrors to a light source adds nothing, as in rtrace.
#include <array>
#include <cstdint>
#include <vector>

#include "light/sources.h"
#include "trace/tracer.h"
#include "transport/tuning.h"

namespace rsphere {

class BallHighlights {
 public:
  // Uses the spheres of plastic or metal that belong to the scene itself, not to octrees in it. Shadow rays find which
  // sources each of them sees. Keeps no references.
  BallHighlights(const Scene& scene, const Tracer& tracer, const LightSources& lights);

  bool empty() const { return count_ == 0; }
  // An estimate of the mean brightness (W/sr/m2) of all surfaces that are lit by the sources.
  double usual() const { return usual_; }
  static constexpr size_t kRoom = tuning::BallHighlights::kMostRoom;

  // The sampling distribution for a point of a diffuse surface.
  struct Aim {
    double mean = 0;   // radiance over the hemisphere from these highlights, W/sr/m2, without occlusion
    size_t count = 0;  // of balls that are aimed at; below, their numbers
    V3d point{0, 0, 0};
    std::array<uint32_t, kRoom> ball;
    std::array<float, kRoom> x, y, z;  // vectors to the centers of the balls (world units)
    std::array<float, kRoom> beside2;  // squared distance from the center up to which a ray may meet the ball
    std::array<float, kRoom> sum;      // cumulative contributions of the balls
  };

  // front: unit normal. least: balls are left out whose highlights are estimated to add less than this to the variance
  // of the radiance from a direction that is chosen by projected solid angle (square of W/sr/m2).
  void aim(const V3d& point, const V3d& front, double least, Aim& aim) const;

  // One of the aimed directions (unit), for uniform u1, u2, u3 in [0, 1); 0 if the one that was drawn misses the
  // highlight. REQUIRES aim.mean > 0.
  V3d sample(const Aim& aim, double u1, double u2, double u3) const;

  // The density of aimed directions, per sr. It integrates to less than 1 by those that miss.
  double density(const Aim& aim, const V3d& direction) const;

 private:
  // A light source, or a part of one, as seen from a ball.
  struct Part {
    bool distant = false;
    V3d center{0, 0, 0};         // a direction (unit) if distant
    V3d u{0, 0, 0}, v{0, 0, 0};  // half its extent (world units; sines if distant)
    double variance = 1. / 3;    // along u and v, relative to the squares of their lengths
    double radius = 0;           // up to which it extends from the center
    double upTo = 0;             // cumulative share of the ball's intensity

    V3d towards(const V3d& from) const { return distant ? center : center - from; }
  };
  struct Ball {
    Sphere sphere;
    double roughness = 0;
    double intensity = 0;  // W/sr, of brightness, sent into every direction
    double hot = 0;        // mean square of its radiance, as a factor of cosine / distance^2
    std::vector<Part> parts;
  };
  class Lobe;

  static std::vector<Part> partsOf(const LightSource& source, const Sphere& ball);
  static bool sees(const Tracer& tracer, SurfaceId source, const Part& part, const V3d& at);
  static Ball lit(const Sphere& sphere, const Opaque& material, const Scene& scene, const Tracer& tracer,
                  const LightSources& lights);
  double densityOf(const Aim& aim, const V3d& direction, const std::array<bool, kRoom>& in) const;
  static bool meets(const Ball& ball, const V3d& point, const V3d& direction, V3d& normal);
  static bool isNear(const Ball& ball, const Part& part, const V3d& direction, const V3d& normal);

  std::vector<Ball> balls_;
  // The balls, as a structure of arrays.
  using Numbers = std::array<float, kRoom>;
  size_t count_ = 0;
  double usual_ = 0;
  V3d origin_{0, 0, 0};  // origin of the coordinates of the centers
  float rounding_ = 0;   // of the square of a distance (square world units)
  Numbers x_{}, y_{}, z_{}, radius_{}, intensity_{}, hot_{};
};

}  // namespace rsphere
