#pragma once
// What a ray is likely to show, at the price of finding what it hits: the diffuse reflectance there, times
// what the light sources send, times the share of it that arrives as a rule, and even light from around.
// Where radiance follows the guess, from the bright part of a partition beside a goal to the edge of a dark
// desktop, many cheap guesses tell what few traced rays miss (a control variate: traced less guessed, plus
// the mean of many guesses). The paper names diffuse objects near to light sources as future work; this
// serves them and all other diffuse ones, seen directly or by indirect rays.
//
// Refused: dynamic directions to surfaces near to sources (two tenths more of them gained 7% there);
// highlights of sources in glossy surfaces (an office gained 3%); and, for the noise of indirect rays,
// directions that neighbours share out among them (nothing).
#include <span>
#include <vector>

#include "transport/ray.h"
#include "transport/transport.h"

namespace rsphere {

class RadianceGuess;

// The guess as it was fitted to what is seen from a point. Its answers depend on that and on the arguments
// alone. Keeps a reference to the guess.
class LocalGuess {
 public:
  // What a ray hits; reflectance 0: nothing that is guessed.
  struct Place {
    V3d point{0, 0, 0}, normal{0, 0, 1};  // world; unit, towards where the ray came from
    Rgb reflectance{0, 0, 0};
  };

  // Of the radiance from there, W/sr/m2.
  Rgb from(const Place& place) const { return from(place, true); }
  // Of what a ray from a point (world) brings, W/sr/m2.
  Rgb along(const V3d& point, const V3d& direction) const;

  // The same of an indirect ray, without the shadow rays that a guess of bright places takes: there are many
  // rays, each of which counts little. start: the surface that it leaves (index in Scene::surfaces).
  Rgb indirect(const V3d& point, const V3d& direction, int32_t start) const;
  Rgb indirect(const Ray& traced) const;

  // How many indirect rays to guess for one that is followed, from where `bounces` indirect ones led: what
  // makes most of the time, by what the noise of followed ones adds to what few directions miss. 0 where that
  // is little. REQUIRES fewer bounces than -ab.
  int raysToGuess(int bounces) const;

  bool expectsLight() const { return !lights_.empty(); }

 private:
  friend class RadianceGuess;
  explicit LocalGuess(const RadianceGuess& guess) : guess_(&guess) {}
  // looking: shadow rays tell of bright places.
  Rgb direct(const Place& at, bool looking) const;
  Rgb from(const Place& place, bool looking) const;

  struct Light {
    uint32_t source = 0;    // index in LightSources
    Rgb radiance{0, 0, 0};  // W/sr/m2
    double share = 0;       // of its light that arrives where it might
  };
  const RadianceGuess* guess_;
  std::vector<Light> lights_;
  Rgb ambient_{0, 0, 0};     // other light, as the radiance of a white surface
  double bright_ = 0;        // what a source adds in brightness from which on shadow rays are asked, W/sr/m2
  double shareGuessed_ = 0;  // of the variance of what is left, what guesses of indirect rays vary by
};

class RadianceGuess {
 public:
  using Place = LocalGuess::Place;

  // unguessed: by surface (index in Scene::surfaces), those whose guess is to be 0, as it is for all but
  // plastic and metal. Keeps a reference to transport.
  RadianceGuess(const Transport& transport, const std::vector<bool>& unguessed);

  // What a direction that was traced hit, and the radiance from there.
  struct Traced {
    Place place;
    int32_t surface = kNone;  // index in Scene::surfaces
    Rgb radiance{0, 0, 0};
  };

  // Where Tracer::nearest found hit from a point (world) in a direction.
  Place placeOf(const V3d& point, const V3d& direction, const Hit& hit) const;

  // Fits the guess to what is seen from a point (world). glances: even directions, about kFitGlances of them.
  // The mean stays unbiased where neither glances nor traced take part in what is summed.
  LocalGuess fit(const V3d& point, std::span<const V3d> glances, std::span<const Traced> traced,
                 uint64_t seed) const;

  static constexpr size_t kFitGlances = 128;

 private:
  friend class LocalGuess;
  using Light = LocalGuess::Light;
  Place placeOf(int32_t surface, const V3d& point, const V3d& normal, const V3d& direction) const;
  Place placeAlong(const V3d& point, const V3d& direction, int32_t start) const;
  double factor(uint32_t source, const Place& at) const;
  double sent(const Light& light, const Place& at) const;
  double seenFrom(const Place& at, uint32_t source) const;
  double shareThatArrives(const Light& light, std::span<const double> sent, std::span<const Place> places,
                          Random& random) const;

  const Transport& transport_;
  std::vector<Rgb> reflectance_;  // diffuse, by surface
  std::vector<Light> lights_;     // share not set
};

}  // namespace rsphere
