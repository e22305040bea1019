#pragma once
#include <Imath/ImathVec.h>

#include <array>
#include <span>

namespace rad {

// A transparent panel with a flat side and a side of prisms. Its normal is x, from the flat side to the
// prisms, which run along z. In cross-section a prism has a base of length a + b and an edge at `height`
// above it. Its side towards +y stands on the part a of the base, its other side on b. a, b and height are in
// the same unit, whichever it is.
struct PrismPanel {
  // The side with a mirror coating: neither, that towards +y, or that towards -y.
  enum class Coated { nothing, upper, lower };

  double a = 0, b = 0, height = 0;
  double index = 1;      // index of refraction
  double threshold = 0;  // smaller shares of the light are not followed
  Coated coated = Coated::nothing;
  double coating = 0;    // reflectance of the coating
  double tolerance = 0;  // directions whose angles about z differ by less (radians) are merged
};

// Light that leaves the panel in one direction, as a share of the incident light.
struct PanelRay {
  Imath::V3d direction;
  double share = 0;
};

struct PanelRays {
  static constexpr size_t kMost = 256;
  std::array<PanelRay, kMost> rays;
  size_t count = 0;

  std::span<const PanelRay> all() const { return {rays.data(), count}; }
  std::span<PanelRay> all() { return {rays.data(), count}; }
};

// The directions in which unpolarized light leaves the panel, in the order in which they are found.
// direction: that of the incident light, of unit length, with x not 0. The light falls evenly on the panel.
// It is reflected and refracted by Fresnel's formulas at every side that it meets, and split where an edge
// divides it. The glass absorbs nothing. Polarization is represented by two fields at right angles; as in
// RADIANCE's fprism, both have the same weight at each side, whatever their losses so far.
// Requires a + b > 0, height > 0, index >= 1, tolerance > 0. Throws Error if there are more than kMost
// directions or if the light meets more than a hundred thousand sides.
PanelRays raysThrough(const PrismPanel& panel, const Imath::V3d& direction);

}  // namespace rad
