#pragma once
// The special objects, which get extra directions, and the density of these directions.
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/tuned.h"
#include "scene/scene.h"
#include "silhouettes/placed_shape.h"
#include "silhouettes/silhouette.h"

namespace rsphere {

// The irregularity of a material, 0 to 1: how much the light that it scatters varies with direction.
// - 1 if it shows a sharp image of its surroundings in another shape or place: mirror, dielectric, interface,
//   prisms; aBSDF, whose data are meant to have a peak straight through.
// - kPane for glass, and for an illum that shows what is behind it. Other illums have the irregularity of
//   their alternate material.
// - For other materials the fraction of light that is reflected or transmitted specularly, divided by 1 + (a
//   / kSharpRoughness)^2 for the roughness a (rms slope of facets), in analogy to the height of the peak.
//   With two roughnesses (plastic2, metal2, trans2, WGMDfunc) the divisor is the geometric mean of both. A
//   power n of ashik2 is converted to the roughness sqrt(2 / (n + 1)), with which the lobe has an equal peak.
// - If a function decides, the largest possible value: all light, and sharp (BRTDfunc, WGMDfunc). The width
//   of directional scattering of plasfunc, its relatives and BRTDfunc is unknown; kSharpRoughness is assumed.
// - 0 for diffuse materials, BSDF and light sources.
double irregularity(const Material& material);

// The constants of special objects. The paper gives neither the densities nor the threshold of its criterion,
// only the resulting numbers of directions: with 1 to 100 small spheres in a furnished open-plan office, 2048
// base directions and 1030 +- 176 extra ones, 2200 to 3500 in all. The values below were fitted so that every
// point of examples/openplan also has 2200 to 3500 directions (accuracy_test.cpp,
// SendsAsManyDirectionsAsThePaper; distribution: tests/bench/importance/runs/2026-11-21-histogram.txt). They
// set the numbers of directions of -Sw v, and choose the special objects of both -Sw v and -Sw c. The effects
// of changes are from tests/bench/sensitivity/runs/2026-11-22.txt.
//
// Directions per sr for an irregularity of 1, times -Sk. A hundred spheres of 0.1 m then get 1000. Reducing
// it by 30% changes the time by -17%, raising it by 30% by +15% (Voronoi cells).
RSPHERE_TUNED(SpecialObjects, double, kDirectionsPerSr, 32000);
// Roughness a (rms slope) at which a highlight is half as irregular as a mirror: derived. The highlight fills
// 4 pi a^2 sr, so that about 16 directions, four across, hit it. Raising it by 30% changes the time by +23%
// (Voronoi cells). Rougher balls show no images of light sources (glints.h).
inline constexpr double kSharpRoughness = .0065;
// The value of irregularity() for glass panes. It is low because objects behind a pane look as large as
// without it, and its reflections are faint. A pane gets 64 directions per sr, so that even the largest gets
// only a few hundred. With the irregularity of a mirror it would take all directions. Insensitive.
RSPHERE_TUNED(SpecialObjects, double, kPane, .002);
// Less irregular objects are treated as diffuse: derived. At this threshold they would get 16 directions per
// sr, a tenth of the density of the default base directions.
inline const double kSpecialIrregularity = 16 / kDirectionsPerSr;

// Up to this number of special objects, looking at each of them takes less time than finding out which are
// hidden (HiddenBoxes). Measured.
inline constexpr size_t kFewHidden = 1024;

struct SpecialObject {
  SurfaceId surface;
  double irregularity = 0;
  double density = 0;                   // directions per sr
  std::optional<PlacedShape> placed{};  // in world coordinates; empty: the surface's own shape
  bool several = false;                 // whether `placed` is a ball around several surfaces
};

// If octrees and meshes contain more special objects than this, each outermost instance becomes one object.
// This limits the time, because the silhouettes of all objects are computed at every point. It is also the
// cap on pairs of a mirror and a light source, whose silhouettes are computed as well; the largest mirrors
// are kept. Chosen by experiment. Insensitive.
RSPHERE_TUNED(SpecialObjects, size_t, kMostPlacedObjects, 4096);

// All surfaces with a material of at least kSpecialIrregularity, including alternatives in mixtures; in the
// order of the scene, without distant sources. Surfaces in octrees are converted to world coordinates.
// Surfaces in meshes are represented by one ball for each material of the mesh, and instances with a special
// modifier by one ball. If there are more than kMostPlacedObjects, each outermost instance that contains
// special surfaces is represented by one ball, with their largest irregularity. factor: -Sk.
std::vector<SpecialObject> findSpecialObjects(const Scene& scene, double factor);

// The shape of the object, or the ball around it (world).
ShapeRef shapeOf(const Scene& scene, const SpecialObject& object);

// The vertices that the shape refers to if it is a polygon (world).
std::span<const V3d> verticesOf(const Scene& scene, const SpecialObject& object);

// Whether a ray that hits the surface (index in Scene::surfaces, or kNone) hits the object.
bool shows(const Scene& scene, const SpecialObject& object, SurfaceId surface);

// The object as seen from a point (world).
Silhouette silhouetteOf(const Scene& scene, const SpecialObject& object, const V3d& point);

// A point on the object, or on the ball around it (world).
SurfacePoint samplePoint(const Scene& scene, const SpecialObject& object, Random& random);

// The text of -Sl, one line for each object: place, surface, type and name of its material, density, and
// reason.
std::string specialObjectsText(const Scene& scene, const std::vector<SpecialObject>& objects);

}  // namespace rsphere
