#pragma once
// What the rays of a patch of the coarse solution found (coarse_solution.h).
#include <Imath/ImathVec.h>

#include <vector>

#include "base/radiometry.h"

namespace rsphere {

using Imath::V3f;

// A patch of the coarse solution, which owns it.
struct Patch;

// Most rays of a patch end at the patch that they hit first. Where no patch serves that hit, the ray is
// followed; `bounces` is the number of diffuse bounces that it makes beyond it. Coefficients: contribution to
// the mean radiance that arrives at the patch that owns the links.
struct PatchLinks {
  struct Link {
    Patch* patch;
    V3f coefficient;  // factor on the mean radiance that arrives at `patch`
    int bounces;
  };
  std::vector<Link> links;
  std::vector<V3f> light;  // by bounces: radiance that depends on no patch (W/sr/m2)
  std::vector<V3f> ends;   // by bounces: factor on -av, used if the path ends there for lack of bounces
  int rays = 0;            // that were followed, with their descendants, without shadow rays

  void add(Patch* patch, const Coefficient& coefficient, int bounces);
  void addLight(int bounces, const Radiance& radiance);
  void addEnd(int bounces, const Coefficient& coefficient);

  // The bands of each element of those above, empty until one has some.
  std::vector<Bands> bandsOfLinks, bandsOfLight, bandsOfEnds;
};

// The color of an element of PatchLinks, of which bands may be kept beside it.
inline Color colorAt(const V3f& channels, const std::vector<Bands>& bands, size_t i) {
  return Color(V3d(channels), i < bands.size() ? bands[i] : Bands());
}

}  // namespace rsphere
