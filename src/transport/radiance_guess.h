#pragma once
// A cheap guess of the radiance along a ray; its cost is that of finding the first hit. The guess is the
// diffuse reflectance at the hit, times the sum of - the unoccluded direct light of each source, times the
// mean visibility of that source, and - uniform ambient light. It serves as a control variate: the estimate
// is the mean of traced minus guessed radiance, plus the mean of many guesses. This reduces the variance
// where the radiance is correlated with the guess, as between the bright part of a partition beside a goal
// and the edge of a dark desktop. The paper mentions diffuse objects near light sources as future work. The
// guess handles these and all other directly visible diffuse objects.
//
// Rejected alternatives:
// - Adaptive directions towards surfaces near sources: 20% more directions gained 7% there.
// - Guesses of the highlights of sources in glossy surfaces: a gain of 3% in an office.
// - Stratifying indirect rays across neighbouring directions to reduce their noise: no gain.
// - Several guessed rays for each traced indirect ray: no gain (tests/bench/mechanisms).
#include <span>
#include <vector>

#include "transport/prepared_scene.h"
#include "transport/ray.h"

namespace rsphere {

class RadianceGuess;

// The guess, fitted to the view from a point. Its results depend only on the fit and on the arguments. Keeps
// a reference to the RadianceGuess.
class LocalGuess {
 public:
  // The hit of a ray. Where the reflectance is 0, the guess is 0.
  struct Place {
    V3d point{0, 0, 0}, normal{0, 0, 1};  // world; normal: unit, on the side from which the ray came
    Coefficient reflectance;
  };

  // The guessed radiance from a place, W/sr/m2.
  Radiance from(const Place& place) const;
  // The guessed radiance along a ray from a point (world), W/sr/m2.
  Radiance along(const V3d& point, const V3d& direction) const;

 private:
  friend class RadianceGuess;
  explicit LocalGuess(const RadianceGuess& guess) : guess_(&guess) {}
  // Uses the mean visibility of each source, or a shadow ray if the source lights the place brightly.
  Radiance direct(const Place& at) const;

  struct Light {
    LightId source;
    Radiance radiance;
    double share = 0;  // mean visibility from the places that face it
  };
  const RadianceGuess* guess_;
  std::vector<Light> lights_;
  Radiance ambient_;   // light from everything else, as the radiance of a white surface
  double bright_ = 0;  // W/sr/m2; a source that adds more brightness than this is tested by a shadow ray
};

class RadianceGuess {
 public:
  using Place = LocalGuess::Place;

  // unguessed: for each surface, whether its guess must be 0. It is always 0 for materials other than plastic
  // and metal. Keeps a reference to the prepared scene.
  RadianceGuess(const PreparedScene& prepared, const ById<SurfaceId, bool>& unguessed);

  // The hit of a traced direction, and the radiance that arrives from it.
  struct Traced {
    Place place;
    Radiance radiance;
  };

  // The place of a hit that Tracer::nearest() found from a point (world) in a direction.
  Place placeOf(const V3d& point, const V3d& direction, const Hit& hit) const;

  // Fits the guess to the view from a point (world). glances: evenly distributed directions. To stay
  // unbiased, the estimate must use neither the glances nor the traced directions again.
  LocalGuess fit(const V3d& point, std::span<const V3d> glances, std::span<const Traced> traced,
                 uint64_t seed) const;

 private:
  friend class LocalGuess;
  using Light = LocalGuess::Light;
  Place placeAlong(const V3d& point, const V3d& direction) const;
  double factor(LightId source, const Place& at) const;
  double sent(const Light& light, const Place& at) const;
  bool isSeen(const Place& at, LightId source) const;
  double shareThatArrives(const Light& light, std::span<const double> sent, std::span<const Place> places,
                          Random& random) const;

  const PreparedScene& prepared_;
  std::vector<Coefficient> reflectance_;  // diffuse reflectance; index: number of the finish
  ById<SurfaceId, bool> unguessed_;       // surfaces whose guess is 0
  std::vector<Light> lights_;             // `share` is not set
};

}  // namespace rsphere
