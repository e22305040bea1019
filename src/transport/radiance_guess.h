#pragma once
// A cheap guess of the radiance along a ray, which costs only the search for its first hit: the diffuse
// reflectance there, times the sum of
// - the unoccluded direct light of each source, times the mean visibility of that source, and
// - uniform ambient light.
// The guess is a control variate: the estimate is the mean of traced minus guessed radiance, plus the mean of
// many guesses. It reduces the variance where radiance is correlated with the guess, as between the bright
// part of a partition beside a goal and the edge of a dark desktop. The paper names diffuse objects near
// light sources as future work; the guess covers these and all other diffuse objects that are seen directly.
//
// Rejected alternatives:
// - Dynamic directions to surfaces near sources: 20% more directions gained 7% there.
// - Guesses of the highlights of sources in glossy surfaces: an office gained 3%.
// - Directions of indirect rays that are distributed among neighbouring directions, against the noise of
//   indirect rays: no gain.
// - Several guessed rays for each indirect ray that is followed: no gain (tests/bench/mechanisms).
#include <span>
#include <vector>

#include "transport/prepared_scene.h"
#include "transport/ray.h"

namespace rsphere {

class RadianceGuess;

// The guess as fitted to the view from a point. Its answers depend only on that fit and on the arguments.
// Keeps a reference to the guess.
class LocalGuess {
 public:
  // The hit of a ray. If the reflectance is 0, the guess is 0.
  struct Place {
    V3d point{0, 0, 0}, normal{0, 0, 1};  // world; unit, towards where the ray came from
    Coefficient reflectance;
  };

  // The guessed radiance from a place, W/sr/m2.
  Radiance from(const Place& place) const;
  // The guessed radiance along a ray from a point (world), W/sr/m2.
  Radiance along(const V3d& point, const V3d& direction) const;

 private:
  friend class RadianceGuess;
  explicit LocalGuess(const RadianceGuess& guess) : guess_(&guess) {}
  // Shadow rays decide the visibility of sources that light the place brightly.
  Radiance direct(const Place& at) const;

  struct Light {
    LightId source;
    Radiance radiance;
    double share = 0;  // mean visibility from the places that face it
  };
  const RadianceGuess* guess_;
  std::vector<Light> lights_;
  Radiance ambient_;   // other light, as the radiance of a white surface
  double bright_ = 0;  // shadow rays are traced if a source adds more brightness than this, W/sr/m2
};

class RadianceGuess {
 public:
  using Place = LocalGuess::Place;

  // unguessed: by surface (index in Scene::surfaces), whether its guess is to be 0. It is 0 anyway for all
  // materials but plastic and metal. Keeps a reference to the prepared scene.
  RadianceGuess(const PreparedScene& prepared, const ById<SurfaceId, bool>& unguessed);

  // The hit of a traced direction, and the radiance from there.
  struct Traced {
    Place place;
    Radiance radiance;
  };

  // The place of a hit that Tracer::nearest found from a point (world) in a direction.
  Place placeOf(const V3d& point, const V3d& direction, const Hit& hit) const;

  // Fits the guess to the view from a point (world). glances: evenly spread directions. The estimate stays
  // unbiased as long as it contains neither the glances nor the traced directions.
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
  std::vector<Coefficient> reflectance_;  // diffuse, by number of finish
  ById<SurfaceId, bool> unguessed_;       // surfaces that are black here
  std::vector<Light> lights_;             // share not set
};

}  // namespace rsphere
