#pragma once
// The surfaces and light sources that bidirectional estimation can handle, called "known" (light_vertices.h,
// vertex_light.h):
// - plastic, metal, glass and mirrors without textures, mixtures or antimatter; plastic and metal may have
//   patterns, if these depend on place alone;
// - local sources at which shadow rays can be aimed, and their images in mirrors;
// - in scenes without these, distant sources, their images in mirrors that they light only through portals
//   (portals.h), and all light that enters through portals.
// Paths from both ends estimate the light of known sources that has met only known surfaces. Paths from the
// eye (path_tracer.h) estimate all other light. All code uses this definition of "known", so that each light
// path is estimated by exactly one method, or by several with weights that add up to 1.
#include <vector>

#include "openings/portals.h"
#include "rays/prepared_scene.h"

namespace rsphere {

// A place on a surface of plastic or metal, seen from one side.
struct PlainPlace {
  V3d point{0, 0, 0}, normal{0, 0, 1};  // world; normal: unit, towards the viewer
  const Opaque* material = nullptr;     // null: the surface is not known
  SurfaceId surface;
  bool flat = false;  // Interaction::flat
  Color pattern{1, 1, 1};

  Color color() const { return material->color * pattern; }
};

// The first hit along a straight line that is not a pane of glass; none if the line leaves through a portal
// first.
struct Sight {
  Hit hit;                // its distance is measured from the last pane
  double distance = 0;    // of the hit from the line's start, world units
  Coefficient passed{1};  // fraction of the light that the panes in between transmit
  bool leaves = false;    // through a portal, at this distance
};

// The material of a finish (scene/surface_list.h) as seen by bidirectional estimation. At most one is not
// null; all are null if the finish is not known.
struct PlainFinish {
  const Opaque* opaque = nullptr;  // plastic or metal
  const Glass* pane = nullptr;
  const Mirror* mirror = nullptr;
  ModifierId patterns = kNone;  // first one in its chain of patterns; kNone: none
};

// Shared by all threads. Keeps references to the scene and its tracer.
class PlainSurfaces {
 public:
  // portals: none if daylight is not known.
  explicit PlainSurfaces(const PreparedScene& prepared, Portals portals = {});

  // The reason why paths from both ends cannot be used, or why they would provide too little light; null if
  // they can be used.
  const char* obstacle() const;

  // How much of the scene's light paths from both ends estimate.
  struct Coverage {
    bool anySource = false;  // at least one source is known
    bool allSources = true;  // all sources are known
    bool all = true;         // all light: all surfaces and sources are known
    bool allDirect = true;   // all direct light of known surfaces
    // Some surface emits light that shadow rays miss, wholly or in part; only a ray that hits the surface
    // finds it.
    bool glows = false;
    // More than half of the area of all surfaces is not known (one side of each, without instances and
    // meshes).
    bool mostlyUnknown = false;
    // Shadow rays to a known source may also carry light that passes unknown surfaces.
    bool passUnknown = false;
    bool mirrors = false;  // panes, mirrors or polished surfaces reflect light between known surfaces
  };
  const Coverage& coverage() const { return coverage_; }

  const PlainFinish& finishOf(SurfaceId surface) const {
    return finishes_[scene_.surfaces.face(surface).finish];
  }
  bool knows(SurfaceId surface) const {
    const PlainFinish& f = finishOf(surface);
    return f.opaque || f.pane || f.mirror;
  }
  bool knows(LightId source) const { return knownSources_[source]; }
  const Portals& portals() const { return portals_; }
  // The radiance (W/sr/m2) that a known real source sends from a point on it. normal: of its front at the
  // point (unit). direction: of the ray that hits the point (unit).
  Radiance radianceOf(LightId source, const V3d& point, const V3d& normal, const V3d& direction,
                      FunctionScratch& scratch) const;
  // SourceChoice::weigh() for the sources that are not certainly hidden from the point (hidden_boxes.h); sets
  // `sources` to these. Sources for which knows() is false get the weight 0.
  double weigh(const V3d& point, const V3d& normal, std::span<const uint32_t>& sources,
               std::vector<double>& weights) const;

  // Follows a straight line through panes of glass, up to a portal. direction: unit. start: the surface on
  // which the line starts, or kNone.
  Sight look(const V3d& origin, const V3d& direction, double farthest, SurfaceId start) const;
  // The transmittance of the panes on the straight line between two places (world); black if anything else
  // lies between them, or if the line from `to` leaves through a portal. start: the surface of `to`, as in
  // look().
  Coefficient passing(const V3d& to, const V3d& from, SurfaceId start) const;
  // The transmittance of the panes between a place and a source in a direction (unit); portals are ignored.
  Coefficient passingToSource(const V3d& to, const V3d& direction, double distance, SurfaceId start) const;

  // The place that is hit by a line from `origin` in a direction, given the result of look().
  PlainPlace placeOf(const V3d& origin, const V3d& direction, const Sight& sight,
                     FunctionScratch& scratch) const;

 private:
  Sight straight(const V3d& origin, const V3d& direction, double farthest, SurfaceId start) const;
  void placePortals();
  void findSources();
  bool isKnown(LightId source) const;
  bool isLitOutdoors(const LightSource& image) const;
  void findSurfaces();
  Color patternAt(const PlainPlace& at, const V3d& direction, const Hit& hit, FunctionScratch& scratch) const;

  const PreparedScene& prepared_;
  const Scene& scene_;
  const Tracer& tracer_;
  Portals portals_;
  std::vector<PlainFinish> finishes_;
  ById<LightId, bool> knownSources_;
  Coverage coverage_;
  bool hasPanes_ = false;
};

// The probability of choosing this source by the weights of PlainSurfaces::weigh(); 0 if it is certainly
// hidden. weights: room for these.
double chanceOf(LightId source, const PlainSurfaces& surfaces, const V3d& point, const V3d& normal,
                std::vector<double>& weights);

// Whether paths from both ends estimate the light of a source, or of an image of it, that arrives at a point
// from a direction (unit). Light of distant sources has to enter through a portal, and pass no other later.
bool bringLightOf(LightId source, const PreparedScene& prepared, const PlainSurfaces& surfaces, V3d point,
                  V3d direction);

// Describes a hit on a plain material, for scatter().
Interaction plainInteraction(const V3d& direction, const V3d& normal, bool flat,
                             const Color& pattern = Color(1, 1, 1));

// Whether a material has rough highlights of sources. They are sampled together with its diffuse light.
inline bool hasRoughHighlight(const Opaque& material) {
  return material.specularity > kNegligible && material.roughness * material.roughness > kNegligible;
}

// Whether it has a sharp reflection.
inline bool isPolished(const Opaque& material) {
  return material.specularity > kNegligible && material.roughness * material.roughness <= kNegligible;
}

// Parts of the reflected direct light at a place.
enum class Shown : uint8_t { none, highlight, all };

// The radiance that a place reflects, diffusely and in its rough highlight, relative to the radiance of a
// source of this solid angle (sr). toSource: direction to the source (unit). view: direction of the ray that
// hits the place (unit).
Coefficient shownOfSource(const PlainPlace& at, const V3d& view, const V3d& toSource, double solidAngle,
                          Shown shown = Shown::all);

}  // namespace rsphere
