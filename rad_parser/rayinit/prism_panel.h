#pragma once
#include <Imath/ImathVec.h>

#include <array>
#include <span>

namespace rad {

// A transparent panel with a flat side and a side of prisms. Its normal is x, from the flat side to the
// prisms, which are parallel to z. In cross-section, a prism has a base of length a + b and an edge at
// `height` above it. The side that faces +y is above the part a of the base, the other side above b. The unit
// of a, b and height is arbitrary.
struct PrismPanel {
  // The side with a mirror coating: none, the one towards +y, or the one towards -y.
  enum class Coated { nothing, upper, lower };

  double a = 0, b = 0, height = 0;
  double index = 1;      // index of refraction
  double threshold = 0;  // smaller shares of the light are ignored
  Coated coated = Coated::nothing;
  double coating = 0;    // reflectance of the coating
  double tolerance = 0;  // directions whose angles about z differ by less (radians) are merged
};

// Light that leaves the panel in one direction. share: fraction of the incident light.
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
// direction: of the incident light, of unit length, with x not 0. The panel is lit evenly. Light is reflected
// and refracted by Fresnel's formulas at each side, and split where an edge divides it. The glass absorbs
// nothing. Polarization is represented by two perpendicular fields; as in RADIANCE's fprism, both have the
// same weight at each side, regardless of earlier losses. Requires a + b > 0, height > 0, index >= 1,
// tolerance > 0. Throws Error if there are more than kMost directions or if the light hits more than a
// hundred thousand sides.
PanelRays raysThrough(const PrismPanel& panel, const Imath::V3d& direction);

}  // namespace rad
