#pragma once
#include <Imath/ImathVec.h>

#include <array>
#include <span>

namespace rad {

// A transparent panel, flat on one side and of prisms on the other: its normal is x, from the flat side to
// the prisms, and they run along z. In section a prism rises from its base, a + b long, to an edge `height`
// above it, where the side towards +y stands on a, the other on b. Units: a, b and height the same, any.
struct PrismPanel {
  enum class Coated { nothing, upper, lower };  // which side is a mirror: towards +y, towards -y

  double a = 0, b = 0, height = 0;
  double index = 1;      // of refraction
  double threshold = 0;  // shares of the light below this are given up
  Coated coated = Coated::nothing;
  double coating = 0;    // its reflectance
  double tolerance = 0;  // directions that differ by less, about z (radians), are one
};

// Light that leaves the panel, as a share of what comes.
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

// Where unpolarized light from a direction (unit, x not 0) goes that falls on the panel evenly: reflected and
// refracted by Fresnel's formulas at every side that it meets, and split where an edge splits it; in the
// order in which it is found. Nothing is absorbed in the glass. Polarization is followed as two fields at
// right angles, which count the same at each side whatever has become of them before; so does RADIANCE's
// fprism. Requires a + b > 0, height > 0, index >= 1, tolerance > 0. Throws Error where that takes more than
// kMost directions or a hundred thousand sides.
PanelRays raysThrough(const PrismPanel& panel, const Imath::V3d& direction);

}  // namespace rad
