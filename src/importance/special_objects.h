#pragma once
// The special objects, those that get directions of their own, and how many.
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/tuned.h"
#include "importance/placed_shape.h"
#include "importance/silhouette.h"
#include "scene/scene.h"

namespace rsphere {

// How irregularly a material scatters light, 0 to 1:
// - 1 if it shows a sharp image of its surroundings in another shape or place: mirror, dielectric, interface,
//   prisms; aBSDF, whose data are meant to have a peak in the straight direction.
// - kPane for glass, and for an illum that shows what is behind it; other illums have the irregularity of
//   their alternate material.
// - For other materials the fraction of light that is reflected or transmitted specularly, divided by 1 + (a
//   / kSharpRoughness)^2 for the roughness a (rms slope of facets), like the height of the peak. With two
//   roughnesses (plastic2, metal2, trans2, WGMDfunc) the divisor is the geometric mean of both. The powers n
//   of ashik2 are converted to roughnesses sqrt(2 / (n + 1)), with which its lobe has the same peak.
// - If a function decides, the largest possible value: all light, and sharp (BRTDfunc, WGMDfunc). The
//   width of directional scattering of plasfunc, its relatives and BRTDfunc is not known;
//   kSharpRoughness is assumed.
// - 0 for diffuse materials, BSDF and light sources.
double irregularity(const Material& material);

// The constants of special objects. The paper states neither densities nor the threshold of its criterion,
// only the resulting numbers of directions: 2048 and 1030 +- 176 more, 2200 to 3500 in all, with 1 to 100
// small spheres in a furnished open-plan office. The following values are fitted so that examples/openplan
// has 2200 to 3500 directions too, at each of its points (accuracy_test.cpp, SendsAsManyDirectionsAsThePaper;
// the distribution is in tests/bench/importance/runs/2026-11-21-histogram.txt). They set the numbers of
// directions of -Sw v, and choose the special objects of both -Sw v and -Sw c. The last sentence of each
// comment is from tests/bench/sensitivity/runs/2026-11-22.txt.
//
// Directions per sr for an irregularity of 1, times -Sk. A hundred spheres of 0.1 m then get 1000. 30% less:
// time -17%; 30% more: time +15% (Voronoi cells; noise: error 8%, time 4%).
RSPHERE_TUNED(SpecialObjects, double, kDirectionsPerSr, 32000);
// Roughness a (rms slope) of a highlight that is half as irregular as a mirror: derived. The highlight fills
// 4 pi a^2 sr, so that about 16 directions, four across, meet it. 30% more: time +23% (Voronoi cells; noise:
// error 5%, time 4%). Balls that are rougher show no images of light sources (glints.h).
inline constexpr double kSharpRoughness = .0065;
// Irregularity of glass panes. Objects behind a pane look as large as without it, and its mirror image is
// faint. A pane gets 64 directions per sr, a few hundred at most; with the irregularity of a mirror, it would
// take all directions. 30% less or more: within noise (Voronoi cells; error 1%, time 5%).
RSPHERE_TUNED(SpecialObjects, double, kPane, .002);
// Less irregular objects are treated as diffuse: derived. Their 16 directions per sr are a tenth of those of
// the default base set.
inline const double kSpecialIrregularity = 16 / kDirectionsPerSr;

// Up to this number it takes less time to look at special objects than to find out that they are hidden
// (HiddenBoxes). By measurement.
inline constexpr size_t kFewHidden = 1024;

struct SpecialObject {
  SurfaceId surface;
  double irregularity = 0;
  double density = 0;                   // directions per sr
  std::optional<PlacedShape> placed{};  // in world coordinates; empty: the surface's own shape
  bool several = false;                 // whether `placed` is a ball around several surfaces
};

// With more special objects in octrees and meshes than this, each outermost instance is one object. This
// limits the time, because the silhouettes of all objects are computed at every point. It is also the cap on
// the pairs of a mirror and a light source, whose silhouettes are computed as well; the largest mirrors are
// kept. Chosen by experiment. 30% less or more: the same answers in all cases.
RSPHERE_TUNED(SpecialObjects, size_t, kMostPlacedObjects, 4096);

// All surfaces, except distant sources, whose material or one of whose alternatives in mixtures has at least
// kSpecialIrregularity; in the order of the scene. Surfaces in octrees are objects with shapes in world
// coordinates. Surfaces in meshes are represented by a ball for each material of the mesh, and instances
// whose own modifier is special by one ball. With more than kMostPlacedObjects, each outermost instance that
// contains any is represented by one ball, with the irregularity of the most irregular one. factor: -Sk.
std::vector<SpecialObject> findSpecialObjects(const Scene& scene, double factor);

// The shape of the object, or the ball around it (world).
ShapeRef shapeOf(const Scene& scene, const SpecialObject& object);

// The vertices that the shape refers to if it is a polygon (world).
std::span<const V3d> verticesOf(const Scene& scene, const SpecialObject& object);

// Whether a hit on the surface (index in Scene::surfaces, or kNone) is a hit on the object.
bool shows(const Scene& scene, const SpecialObject& object, SurfaceId surface);

// The object as seen from a point (world).
Silhouette silhouetteOf(const Scene& scene, const SpecialObject& object, const V3d& point);

// A point on the object, or on the ball around it (world).
SurfacePoint samplePoint(const Scene& scene, const SpecialObject& object, Random& random);

// One line for each object, for -Sl: place, surface, type and name of its material, density, and the reason.
std::string specialObjectsText(const Scene& scene, const std::vector<SpecialObject>& objects);

}  // namespace rsphere
