#pragma once
// Virtual light sources: what plane surfaces of mirror, prism1 and prism2 make of the others (RADIANCE
// reference manual, "mirror", "prism1"; doc/notes/secsrc.note). A relay makes an affine image of a source:
// exact for a mirror, right along the ray through the middles of source and relay for a prism. Shadow rays
// aim at the image; the relay's material sends them on to the source, which decides what they bring.
//
// An image is left out where geometry alone shows that it lights nothing: the source or the beam that it gets
// from the relay before lies behind the mirror, or the source faces away from it. RADIANCE also drops those
// that none of some test rays reaches (-dp), and never again tests those that all of them reach; here every
// image is tested for shadows, as with its -dp 0.
#include <vector>

#include "light/sources.h"

namespace rsphere {

// Appends the images of all sources by way of up to `relays` relays one after the other. Relays are polygons
// and rings whose material is mirror, prism1 or prism2, or illum with one of them as its alternative. warn:
// of surfaces of other shapes, which relay nothing. functions: of prisms; throws what they throw.
void addVirtualSources(const Scene& scene, int relays, const SurfaceFunctions& functions,
                       const rad::Warn& warn, std::vector<LightSource>& sources);

}  // namespace rsphere
