#pragma once
// The result of the rays that a patch of the coarse solution has sent (coarse_solution.h).
#include <Imath/ImathVec.h>

#include <vector>

#include "base/radiometry.h"

namespace rsphere {

using Imath::V3f;

// Defined and owned by the coarse solution.
struct Patch;

// Most rays of a patch end at the first patch that they hit. If no patch can be used there, the ray is
// followed; `bounces` is the number of its diffuse bounces after the first hit. A coefficient is the factor
// by which light contributes to the mean radiance that arrives at the patch that owns the links.
struct PatchLinks {
  struct Link {
    Patch* patch;
    V3f coefficient;  // for the mean radiance that arrives at `patch`
    int bounces;
  };
  std::vector<Link> links;
  std::vector<V3f> light;  // index: bounces; radiance that depends on no patch (W/sr/m2)
  std::vector<V3f> ends;   // index: bounces; coefficient of -av, used if -ab ends the path here
  int rays = 0;            // number of rays that were followed, with their descendants, without shadow rays

  void add(Patch* patch, const Coefficient& coefficient, int bounces);
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
