#pragma once
// Virtual light sources: the images of other sources in plane surfaces of mirror, prism1 and prism2, called
// relays (RADIANCE reference manual, "mirror", "prism1"; doc/notes/secsrc.note). The image of a source is
// affine. It is exact for a mirror; for a prism it is exact only along the ray through the centers of source
// and relay. Shadow rays are aimed at the image; the relay's material sends them on to the source, whose
// radiance in that direction they return.
//
// An image is omitted if geometry alone shows that it lights nothing: the source lies behind the mirror or
// faces away from the relay, or the source's light misses the relay after passing the preceding relays
// (bounded by planes through the exact corners of source and relays: penumbra.h). RADIANCE also sends test
// rays (-dp): it drops an image if all of them are blocked, and omits its shadow tests if none is. Here every
// image is tested for shadows, as with RADIANCE's -dp 0.

#include "light/light_source.h"
#include "shade/surface_functions.h"

namespace rsphere {

// A number of relays that stands for as many as are worth their shadow rays.
inline constexpr int kRelaysAsNeeded = 1000;

// Appends the images of all sources in sequences of up to `relays` relays. Relays are polygons and rings
// whose material is mirror, prism1 or prism2, or illum with one of these as its alternate material. warn:
// called for surfaces of other shapes with such a material; they produce no images. Also called where
// kRelaysAsNeeded would make too many images, so that light is left out. functions: evaluates the
// arguments of prisms; exceptions that it throws are not caught.
void addVirtualSources(const Scene& scene, int relays, const SurfaceFunctions& functions,
                       const rad::Warn& warn, ById<LightId, LightSource>& sources);

}  // namespace rsphere
