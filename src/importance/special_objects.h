#pragma once
// Which objects are looked at with directions of their own, and how closely.
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace rsphere {

// How irregular a material scatters: 1 for what shows a sharp image of its surroundings (mirror, dielectric,
// interface, glass; aBSDF, whose data are meant to have a peak straight on), else the share of light it
// reflects or transmits specularly, made smaller by roughness a (rms slope of facets) as 1 / (1 + (a /
// kSharpRoughness)^2): a highlight that is spread wide is no peak; of two roughnesses (plastic2, metal2,
// trans2, WGMDfunc), by the root of both factors; ashik2's powers n are taken for roughnesses sqrt(2 / (n +
// 1)), where its lobe has the same peak. Where a function decides, the most that may be is taken: all of the
// light, and sharp (BRTDfunc, WGMDfunc); but the directional scattering of plasfunc, its kin and BRTDfunc is
// given no width at all, and is taken for kSharpRoughness. 0 for diffuse materials, BSDF and light sources.
double irregularity(const Material& material);

// A polished surface's highlight is as sharp as the directions are dense (0.08 rad for 2048) at about this
// roughness.
inline constexpr double kSharpRoughness = .05;
// Less irregular objects are treated as diffuse: 2% in a sharp image, what plain plastic at right angles has,
// is kept.
inline constexpr double kSpecialIrregularity = .02;

// Directions per sr that an irregularity of 1 asks for, times -Sk. Chosen so that the paper's numbers come
// out: with spheres of 0.1 m under the ceiling of an open-plan office, some 1000 directions for the larger
// half of 1 to 100.
inline constexpr double kDirectionsPerSr = 32000;

struct SpecialObject {
  uint32_t surface = 0;  // index in Scene::surfaces
  double irregularity = 0;
  double density = 0;  // directions per sr
};

// Every surface whose material, or one that its modifiers may stand for, is special; in the order of the
// scene. Distant sources are none. factor: -Sk.
std::vector<SpecialObject> findSpecialObjects(const Scene& scene, double factor);

// A line for each: surface, material with its type, place, density and why; for -Sl.
std::string specialObjectsText(const Scene& scene, const std::vector<SpecialObject>& objects);

}  // namespace rsphere
