#pragma once
// What a direction is likely to show, at the price of finding what it hits: the diffuse reflectance there,
// times what the light sources send, times the share of it that arrives as a rule, and even light from
// around. Where radiance follows the guess, from the bright part of a partition beside a goal to the edge of
// a dark desktop, many cheap guesses tell what few traced directions miss (a control variate). The paper
// names diffuse objects near to light sources as future work; this serves them and all other diffuse ones.
//
// Refused: dynamic directions to surfaces near to sources. Two tenths more directions gained 7% there.
#include <optional>
#include <span>
#include <vector>

#include "transport/path_tracer.h"

namespace rsphere {

class RadianceGuess {
 public:
  // unguessed: by surface (index in Scene::surfaces), those whose guess is to be 0, as it is for all but
  // plastic and metal. Keeps a reference to transport.
  RadianceGuess(const Transport& transport, const std::vector<bool>& unguessed);

  // What the guesses at one point are made with.
  struct Light {
    uint32_t source = 0;    // index in LightSources
    Rgb radiance{0, 0, 0};  // W/sr/m2
    double share = 0;       // of its light that arrives where it might
  };
  struct Local {
    std::vector<Light> lights;
    Rgb ambient{0, 0, 0};  // other light, as the radiance of a white surface
    double bright = 0;     // what a source adds in brightness from which on shadow rays are asked, W/sr/m2
  };

  // What a direction hits; reflectance 0: nothing that is guessed.
  struct Place {
    V3d point{0, 0, 0}, normal{0, 0, 1};
    Rgb reflectance{0, 0, 0};
  };

  // What a direction that was traced hit, and the radiance from there.
  struct Traced {
    Place place;
    Rgb radiance{0, 0, 0};
  };

  // Where Tracer::nearest found hit from a point (world) in a direction.
  Place placeOf(const V3d& point, const V3d& direction, const Hit& hit) const;

  // Fits the guess to what is seen from a point (world). glances: even directions, about kFitGlances of them.
  // The mean stays unbiased where neither glances nor traced take part in what is summed.
  Local fit(const V3d& point, std::span<const V3d> glances, std::span<const Traced> traced,
            uint64_t seed) const;

  // Of the radiance from there, W/sr/m2. Depends on the arguments alone.
  Rgb from(const Place& place, const Local& local) const;
  Rgb along(const V3d& point, const V3d& direction, const Local& local) const;

  static constexpr size_t kFitGlances = 128;

 private:
  Place placeAlong(const V3d& point, const V3d& direction) const;
  double factor(uint32_t source, const Place& at) const;
  double sent(const Light& light, const Place& at) const;
  double seenFrom(const Place& at, uint32_t source) const;
  double shareThatArrives(const Light& light, std::span<const double> sent, std::span<const Place> places,
                          Random& random) const;
  Rgb direct(const Place& at, const Local& local) const;

  const Transport& transport_;
  std::vector<Rgb> reflectance_;  // diffuse, by surface
  std::vector<Light> lights_;     // share not set
};

}  // namespace rsphere
