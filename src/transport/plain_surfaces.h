#pragma once
// The surfaces and light sources that paths from both ends know (light_vertices.h, vertex_light.h):
// - plastic, metal, glass and mirrors without textures, mixtures or antimatter, plastic and metal also with
//   patterns that are the same for all rays;
// - local sources that shadow rays can be aimed at, and their images in mirrors.
// Paths from both ends bring the light of known sources that has met known surfaces alone. All other light is
// left to the paths that path_tracer.h follows from the eye. All code uses this one rule of what is known, so
// that each path of light is found by one method only, or by several with weights that add up to 1.
#include <vector>

#include "transport/prepared_scene.h"

namespace rsphere {

// A place on a surface of plastic or metal, as seen from one side.
struct PlainPlace {
  V3d point{0, 0, 0}, normal{0, 0, 1};  // world; unit, towards the side that it is seen from
  const Opaque* material = nullptr;     // null: none of the surfaces that are known
  SurfaceId surface;
  bool flat = false;  // Interaction::flat
  Color pattern{1, 1, 1};

  Color color() const { return material->color * pattern; }
};

// The first hit of a straight line that is not a pane of glass.
struct Sight {
  Hit hit;                // its distance is measured from the last pane
  double distance = 0;    // of the hit from the start, world units
  Coefficient passed{1};  // share of the light that the panes in between let pass
};

// What a finish (scene/surface_list.h) is to paths from both ends. Null: it is none of that material, or not
// a known one.
struct PlainFinish {
  const Opaque* opaque = nullptr;  // plastic or metal
  const Glass* pane = nullptr;
  const Mirror* mirror = nullptr;
  ModifierId patterns = kNone;  // the first in its chain; kNone: none
};

// Shared by all threads. Keeps references to the scene and its tracer.
class PlainSurfaces {
 public:
  explicit PlainSurfaces(const PreparedScene& prepared);

  // The reason why paths from both ends cannot be used, or would bring too little light; null if they can be
  // used.
  const char* obstacle() const;

  // How much of the scene's light is light of known paths.
  struct Coverage {
    bool allSources = true;    // all sources are known
    bool all = true;           // known paths bring all of the light: all surfaces and sources are known
    bool allDirect = true;     // known paths bring all of the direct light of known surfaces
    bool passUnknown = false;  // shadow rays to a known source may bring light of paths that are not known
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
  bool isFlat(SurfaceId surface) const;  // Interaction::flat
  // The radiance (W/sr/m2) that a known source, not an image, sends from a point on it. normal: of its front
  // at the point (unit). direction: towards the point (unit).
  Radiance radianceOf(LightId source, const V3d& point, const V3d& normal, const V3d& direction,
                      FunctionScratch& scratch) const;
  // SourceChoice::weigh() of the sources that are not certainly hidden from the point (hidden_boxes.h). It
  // returns these sources in `sources`. Sources for which knows() is false get the weight 0.
  double weigh(const V3d& point, const V3d& normal, std::span<const uint32_t>& sources,
               std::vector<double>& weights) const;

  // Follows a straight line through panes of glass. direction: unit. start: the surface that the line starts
  // on, or kNone.
  Sight look(const V3d& origin, const V3d& direction, double farthest, SurfaceId start) const;
  // The share of light that passes straight between two places (world): black if anything but panes lies
  // between. start: as for look().
  Coefficient passing(const V3d& from, const V3d& to, SurfaceId start) const;

  // The place that a sight from `origin` along a direction shows.
  PlainPlace placeOf(const V3d& origin, const V3d& direction, const Sight& sight,
                     FunctionScratch& scratch) const;

 private:
  void findSources();
  bool isKnown(LightId source) const;
  void findSurfaces();
  Color patternFrom(ModifierId first, const FunctionPoint& here, FunctionScratch& scratch) const;
  Color patternAt(const PlainPlace& at, const V3d& direction, const Hit& hit, FunctionScratch& scratch) const;

  const PreparedScene& prepared_;
  const Scene& scene_;
  const Tracer& tracer_;
  std::vector<PlainFinish> finishes_;
  ById<LightId, bool> knownSources_;
  Coverage coverage_;
  bool hasPanes_ = false, hasKnownSources_ = false;
};

// A hit as scatter() of a plain material takes it.
Interaction plainInteraction(const V3d& direction, const V3d& normal, bool flat,
                             const Color& pattern = Color(1, 1, 1));

// Whether a material shows rough highlights of sources, which are sampled together with its diffuse light.
inline bool hasRoughHighlight(const Opaque& material) {
  return material.specularity > kNegligible && material.roughness * material.roughness > kNegligible;
}

// The parts of the direct light of a place.
enum class Shown : uint8_t { none, highlight, all };

// The radiance that a place shows by diffuse reflection and its rough highlight, relative to the radiance of
// a source of this solid angle (sr) in a direction (unit). view: direction (unit) of the ray that sees the
// place.
Coefficient shownOfSource(const PlainPlace& at, const V3d& view, const V3d& toSource, double solidAngle,
                          Shown shown = Shown::all);

}  // namespace rsphere
