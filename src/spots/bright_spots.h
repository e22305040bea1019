#pragma once
// Spots of strong direct light on diffuse surfaces, such as the inside of a lampshade, a partition at the
// edge of an importance goal, or a sunlit sill. They are small and bright, and cause most of the variance of
// indirect light if rays hit them only by chance. Some rays are therefore aimed at them, with multiple
// importance sampling (balance heuristic: Veach and Guibas 1995, "Optimally combining sampling techniques for
// Monte Carlo rendering"). Spots are found once per scene, by tracing particles from the light sources
// (Jensen 1995, "Importance driven path tracing using the photon map"). Spots that are missed or misplaced
// change the variance, not the mean.
//
// Another kind of small and bright places are highlights of light sources on rough balls and cylinders, which
// follow from the geometry (highlights.h).
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "base/random.h"
#include "light/sources.h"
#include "openings/openings.h"
#include "openings/tuning.h"
#include "trace/tracer.h"

namespace rsphere {

class BrightSpots {
 public:
  // Traces tuning::BrightSpots::kParticles particles from the sources. The spots depend only on the scene; an
  // evenly lit scene has none. openings: if not null, equally many particles are also traced from distant
  // sources through the openings. Keeps no references.
  BrightSpots(const Scene& scene, const Tracer& tracer, const LightSources& lights,
              const SurfaceFunctions& functions, const Openings* openings = nullptr);

  bool empty() const { return spots_.count == 0; }
  // The mean brightness (W/sr/m2) of all surfaces that are lit by the sources of the spots.
  double usual() const { return usual_; }
  static constexpr size_t kRoom = tuning::Caps::kAimed;

  // A spot of light that enters through openings.
  struct Sunlit {
    Box3d box;                  // around its particles (world)
    V3d normal;                 // mean of the normals of its surfaces, not normalized
    double radiance;            // mean brightness, W/sr/m2
    std::array<V3d, 4> places;  // positions of some of its particles (world)
  };
  const std::vector<Sunlit>& sunlit() const { return sunlit_; }

  // The sampling distribution for a point of a diffuse surface.
  struct Aim {
    double mean = 0;  // mean radiance over the hemisphere from the spots, W/sr/m2, without occlusion
    size_t count = 0;
    std::array<float, kRoom> x, y, z;  // vectors to the centers of the spots (world units)
    std::array<float, kRoom> sine2;    // squared sine of the angular radius of each spot
    std::array<float, kRoom> squared;  // squared distances (square world units)
    std::array<float, kRoom> sum;      // cumulative contributions of the spots
  };

  // See LightFinder.
  static constexpr AimedAt kKind = AimedAt::spots;
  void aim(const AimFrom& from, Aim& aim) const;
  V3d sample(const Aim& aim, double u1, double u2, double u3) const;
  double density(const Aim& aim, const V3d& direction) const;

 private:
  struct Spot {
    V3d center{0, 0, 0}, normal{0, 0, 0};  // normal: mean of the normals of its surfaces, not normalized
    double radius = 0;
    double power = 0;  // reflected luminous power, W
  };
  struct Particle;
  struct Node;
  std::vector<Particle> particles(const Scene& scene, const Tracer& tracer, const LightSources& lights,
                                  const SurfaceFunctions& functions) const;
  std::vector<Particle> particlesThrough(const Openings& openings, const Scene& scene, const Tracer& tracer,
                                         const LightSources& lights) const;
  static std::optional<Particle> arrived(const Scene& scene, const Tracer& tracer, const V3d& origin,
                                         const V3d& direction, double power, Random& random);
  static double meanSquareAcrossRooms(std::span<const Particle> particles, const Tracer& tracer);
  // Finds spots, keeps them, and returns the groups of particles that form them. most: cap on the number of
  // spots. area: of the surfaces that receive the light (square world units). brighter, leastWorth: the
  // thresholds for a spot's brightness and for the worth of all spots; see tuning::BrightSpots::kBrighter.
  std::vector<Node> find(std::span<Particle> all, double area, size_t most, double brighter,
                         double leastWorth);
  void keep(const Spot& spot);

  // The spots as a structure of arrays.
  struct Spots {
    using Numbers = std::array<float, kRoom>;
    size_t count = 0;
    V3d origin{0, 0, 0};  // origin of the coordinates of the centers
    Numbers x{}, y{}, z{}, normalX{}, normalY{}, normalZ{}, radius{}, anyway{}, power{};
  };
  Spots spots_;
  double samePlace_ = kSamePlace;  // Scene::samePlace
  double usual_ = 0;               // result of usual(), for the first spots that were found
  std::vector<Sunlit> sunlit_;
};

}  // namespace rsphere
