#pragma once
// The result of the rays that a patch of the coarse solution has sent (coarse_solution.h).
#include <Imath/ImathVec.h>

#include <vector>

#include "base/radiometry.h"
#include "field/hemisphere.h"

namespace rsphere {

using Imath::V2f;
using Imath::V3f;

// Defined and owned by the coarse solution.
struct Patch;

// A place on a patch. The patch is null if none can be used.
struct PatchPlace {
  Patch* patch = nullptr;
  V2f at{0, 0};  // relative to the mean of the patch's sites, in sides of the patch
};

// A place on a patch where rays start.
struct PatchSite {
  GatherSite site;
  V2f weight{0, 0};  // factor on light that arrives here, in the slopes of the patch's light
};

// Light (W/sr/m2) or a coefficient that varies linearly over a patch.
struct LinearColor {
  V3f mean{0, 0, 0};
  V3f slopes[2] = {V3f(0), V3f(0)};  // change from one side of the patch to the opposite one

  // Adds light, or a coefficient, that arrives at a site of this weight (PatchSite).
  void add(const V3f& part, const V2f& weight) {
    mean += part;
    slopes[0] += weight.x * part;
    slopes[1] += weight.y * part;
  }
  LinearColor& operator+=(const LinearColor& other) {
    mean += other.mean;
    for (int k = 0; k < 2; ++k) slopes[k] += other.slopes[k];
    return *this;
  }
  LinearColor operator*(const V3f& factor) const {
    return {mean * factor, {slopes[0] * factor, slopes[1] * factor}};
  }
  V3f at(const V2f& place) const { return mean + place.x * slopes[0] + place.y * slopes[1]; }
};

// Most rays of a patch end at the first patch that they hit. If no patch can be used there, the ray is
// followed; `bounces` is the number of its diffuse bounces after the first hit. A coefficient is the factor
// by which light contributes to the mean radiance that arrives at the patch that owns the links. Functions
// add light at the site with this `weight`.
struct PatchLinks {
  struct Link {
    PatchPlace to;
    V3f coefficient;  // for the mean radiance that arrives there
    int bounces;
    V2f weight;  // of the site where the ray started
  };
  std::vector<Link> links;
  std::vector<LinearColor> light;  // index: bounces; radiance that depends on no patch (W/sr/m2)
  std::vector<LinearColor> ends;   // index: bounces; coefficient of -av, used if -ab ends the path here
  V2f weight{0, 0};                // of the site whose rays are followed
  int rays = 0;  // number of rays that were followed, with their descendants, without shadow rays

  void addLink(const PatchPlace& to, const Coefficient& coefficient, int bounces);
  void addLight(int bounces, const Radiance& radiance);
  void addEnd(int bounces, const Coefficient& coefficient);

  // The bands of the elements of links, light and ends; empty while no element has bands.
  std::vector<Bands> bandsOfLinks, bandsOfLight, bandsOfEnds;
};

// The color of an element of PatchLinks, from its channels and its bands, if any.
inline Color colorAt(const V3f& channels, const std::vector<Bands>& bands, size_t i) {
  return Color(V3d(channels), i < bands.size() ? bands[i] : Bands());
}

}  // namespace rsphere
