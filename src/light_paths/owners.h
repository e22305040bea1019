#pragma once
// Which method estimates a part of the light at the end of a ray from the eye, where paths from both ends are
// used. Each part of the light of known sources that has met only known surfaces (plain_surfaces.h) has one
// owner, so that none is lost or counted twice. All other light belongs to paths from the eye. In ray mode
// there are no light paths, and all light belongs to paths from the eye.
#include <cstdint>

#include "rays/ray.h"

namespace rsphere {

enum class Owner : uint8_t {
  eye,     // the ray itself, and shadow rays, gathers and lobe samples from its end
  here,    // VertexLight at its end: a shadow ray, and connections with light vertices
  earlier  // VertexLight at an earlier place or at the eye, to which this light is already connected
};

enum class LightPart : uint8_t {
  emitted,    // at the end of the ray
  ofSources,  // of sources that shine on the end, reflected diffusely
  highlight,  // of these sources, in a rough highlight
  // Light that arrives after at least one diffuse reflection, or from beyond a portal. Its owner connects the
  // end of the ray with light vertices and portals.
  indirect,
  // The part of `indirect` from beyond a portal, such as a pane, where a ray from the eye leaves through it.
  // From the first diffuse surface on, the place that the ray comes from is already connected with the
  // portal: Owner::earlier.
  throughPortal
};

// The data of a ray on which its owners depend.
struct OwnedRay {
  Known known = Known::no;  // of the ray; for the light that its end reflects: of the end (RayEnd::known)
  bool isShadow = false;
  int ambientLevel = 0;                         // PathContext::ambientLevel
  bool isMirrored = false;                      // after the eye or the last diffuse surface
  bool hasHighlight = false, isStrong = false;  // of the material at its end: rough highlights
};

inline Owner ownerOf(LightPart part, const OwnedRay& ray) {
  if (ray.known == Known::no) return Owner::eye;
  // An earlier place is not connected with light vertices through a mirror.
  const bool unconnected = ray.isMirrored && (ray.ambientLevel == 0 || ray.known == Known::unjoined);
  switch (part) {
    // A shadow ray towards a known source finds other light only on its way.
    case LightPart::emitted: return ray.isShadow ? Owner::earlier : Owner::eye;
    case LightPart::throughPortal:
      return ray.isShadow || ray.ambientLevel == 0 || unconnected ? Owner::eye : Owner::earlier;
    case LightPart::indirect: return unconnected ? Owner::here : Owner::earlier;
    case LightPart::highlight:
      if (!unconnected && ray.known == Known::unjoined && ray.hasHighlight) return Owner::here;
      [[fallthrough]];
    case LightPart::ofSources:
      if (!unconnected) return Owner::earlier;
      // A strong highlight needs more than one shadow ray.
      return ray.hasHighlight && ray.isStrong ? Owner::eye : Owner::here;
  }
  return Owner::eye;
}

// RayEnd::known for the rays that gather indirect light at a place, given who owns that light.
inline Known knownAfter(Owner indirect) { return indirect == Owner::here ? Known::unjoined : Known::joined; }

}  // namespace rsphere
