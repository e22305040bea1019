#pragma once
// Which objects are looked at with directions of their own, and how closely.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "importance/placed_shape.h"
#include "importance/silhouette.h"
#include "scene/scene.h"

namespace rsphere {

// How irregular a material scatters: 1 for what shows a sharp image of its surroundings in another shape or
// place (mirror, dielectric, interface; aBSDF, whose data are meant to have a peak straight on), kPane for
// glass, else the share of light it reflects or transmits specularly, made smaller by roughness a (rms slope
// of facets) as 1 / (1 + (a / kSharpRoughness)^2), as the height of the peak is; of two roughnesses
// (plastic2, metal2, trans2, WGMDfunc), by the root of both factors; ashik2's powers n are taken for
// roughnesses sqrt(2 / (n + 1)), where its lobe has the same peak. Where a function decides, the most that
// may be is taken: all of the light, and sharp (BRTDfunc, WGMDfunc); but the directional scattering of
// plasfunc, its kin and BRTDfunc is given no width at all, and is taken for kSharpRoughness. 0 for diffuse
// materials, BSDF and light sources.
double irregularity(const Material& material);

// The paper gives neither densities nor the criterion's numbers, but what came of them: 2048 directions and
// 1030 +- 176 more, 2200 to 3500 in all, with 1 to 100 small spheres in a furnished open-plan office. These
// numbers are set so that examples/openplan gives 2200 to 3500 too, at every one of its points:
//
// Directions per sr that an irregularity of 1 asks for, times -Sk: 1000 for a hundred spheres of 0.1 m.
inline constexpr double kDirectionsPerSr = 32000;
// A highlight is called sharp where no more than some 16 such directions fall in it, four across: it fills 4
// pi a^2 sr.
inline constexpr double kSharpRoughness = .0065;
// A pane's glass: what is seen straight through is no smaller than without it, and its mirror image is faint.
// Gets 64 directions per sr, a few hundred at most, where as a mirror it would have taken all there are.
inline constexpr double kPane = .002;
// Less irregular objects are treated as diffuse: their 16 directions per sr are a tenth of the base's own.
inline constexpr double kSpecialIrregularity = .0005;

struct SpecialObject {
  uint32_t surface = 0;  // index in Scene::surfaces
  double irregularity = 0;
  double density = 0;                   // directions per sr
  std::optional<PlacedShape> placed{};  // in the world, where that is not the surface's own shape
  bool several = false;                 // `placed` is a ball around others than `surface` too
};

// Beyond so many special objects in octrees and meshes each outermost instance is one object: silhouettes are
// computed for all of them at every point.
inline constexpr size_t kMostPlacedObjects = 4096;

// Every surface whose material, or one that its modifiers may stand for, is special; in the order of the
// scene. Distant sources are none. Those in octrees are placed in the world, as shapes of their own; those in
// meshes are a ball for each material of a mesh, and so is an instance whose own modifier is special. Beyond
// kMostPlacedObjects, a ball around each outermost instance that holds any, by its most irregular one.
// factor: -Sk.
std::vector<SpecialObject> findSpecialObjects(const Scene& scene, double factor);

// The object's shape in the world, or the ball around it.
const Shape& shapeOf(const Scene& scene, const SpecialObject& object);

// Whether a hit on this surface (index in Scene::surfaces) is one on the object.
bool shows(const Scene& scene, const SpecialObject& object, int32_t surface);

// The object as it is seen from a point (world).
Silhouette silhouetteOf(const Scene& scene, const SpecialObject& object, const V3d& point);

// A point on the object, or on the ball around it (world).
SurfacePoint samplePoint(const Scene& scene, const SpecialObject& object, Random& random);

// A line for each: surface, material with its type, place, density and why; for -Sl.
std::string specialObjectsText(const Scene& scene, const std::vector<SpecialObject>& objects);

}  // namespace rsphere
