#pragma once
// Where light from the sources falls thickest on diffuse surfaces: the inside of a lampshade, a partition at
// the edge of a goal, a sunlit sill. Small and bright, they are most of the noise of indirect light where
// directions find them by chance; so some directions are aimed at them, and each is weighted by all the ways
// in which it might have been chosen (the balance heuristic: Veach and Guibas 1995, "Optimally combining
// sampling techniques for Monte Carlo rendering"). Where they lie is told by particles that the sources send
// out once a scene (Jensen 1995, "Importance driven path tracing using the photon map"); how well it is told
// decides how much answers scatter, not what they are in the mean.
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "light/sources.h"
#include "scene/random.h"
#include "trace/tracer.h"
#include "transport/openings.h"

namespace rsphere {

class BrightSpots {
 public:
  // Sends out particles: 8192, about 5 ms. The same scene gives the same spots; a scene that is lit evenly
  // has none. openings: where distant sources shine into a room, which gets as many particles again; or null.
  // Keeps nothing of the arguments.
  BrightSpots(const Scene& scene, const Tracer& tracer, const LightSources& lights,
              const Openings* openings = nullptr);

  bool empty() const { return count_ == 0; }
  static constexpr size_t kMost = 64;

  // What a diffuse surface at a place aims at.
  struct Aim {
    double share = 0;  // of its directions that are aimed, kMostAimed at most; 0: none is worth it
    size_t count = 0;
    std::array<float, kMost> x, y, z;  // to the spots' middles (world units)
    std::array<float, kMost> sine2;    // of half the angle that a spot is seen within, squared
    std::array<float, kMost> squared;  // its distance's
    std::array<float, kMost> sum;      // of what comes from the spots up to this one
  };
  static constexpr double kMostAimed = .5;

  // front: unit normal. aim.share is all that is set where it is 0.
  void aim(const V3d& point, const V3d& front, Aim& aim) const;

  // One of the aimed directions (unit), for even u1, u2, u3 in [0, 1). REQUIRES aim.share > 0.
  V3d sample(const Aim& aim, double u1, double u2, double u3) const;

  // How likely the aimed directions are to be this one, per sr.
  double density(const Aim& aim, const V3d& direction) const;

 private:
  struct Spot {
    V3d center{0, 0, 0}, normal{0, 0, 0};  // normal: mean of those of its surfaces, shorter than 1
    double radius = 0;
    double power = 0;  // that it sends back, W of luminance
  };
  struct Particle;
  struct Node;
  std::vector<Particle> particles(const Scene& scene, const Tracer& tracer, const LightSources& lights) const;
  std::vector<Particle> particlesThrough(const Openings& openings, const Scene& scene, const Tracer& tracer,
                                         const LightSources& lights) const;
  static std::optional<Particle> arrived(const Scene& scene, const Tracer& tracer, V3d origin,
                                         const V3d& direction, double power, Random& random);
  // most: spots to find. area: of the surfaces that share the light (square world units).
  void find(std::vector<Particle> all, double area, size_t most);
  void keep(const Spot& spot, double usual);

  // Of the spots, each in an array of its own.
  using Numbers = std::array<float, kMost>;
  size_t count_ = 0;
  V3d origin_{0, 0, 0};  // what centers are counted from
  Numbers x_{}, y_{}, z_{}, normalX_{}, normalY_{}, normalZ_{}, radius_{}, anyway_{}, power_{};
};

}  // namespace rsphere
