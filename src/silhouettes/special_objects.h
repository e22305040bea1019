#pragma once
// The special objects, which get extra directions, and the density of these directions.
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "silhouettes/placed_shape.h"
#include "silhouettes/silhouette.h"

namespace rsphere {

// The irregularity of a material, 0 to 1: how much the light that it scatters varies with direction. For the
// constants, see tuning.h.
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

struct SpecialObject {
  SurfaceId surface;
  double irregularity = 0;
  double density = 0;                   // directions per sr
  std::optional<PlacedShape> placed{};  // in world coordinates; empty: the surface's own shape
  bool several = false;                 // whether `placed` is a ball around several surfaces
};

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
