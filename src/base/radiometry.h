#pragma once
// The quantities of light transport as types: passing an irradiance or a coefficient to code that expects a
// radiance does not compile.
//
// Importance is transported as Radiance: goals emit importance 1 like light sources emit radiance, and the
// same paths transport both with the same coefficients. Only those of refraction may differ: see scatter() in
// shade/scattering.h. Both never occur together, because light sources emit nothing in a scene with goals.
#include <type_traits>
#include <utility>

#include "base/color.h"

namespace rsphere {

// A color that is a physical quantity. Kinds are not convertible into each other, and Color is converted only
// where the kind is named. Quantities of the same kind can be added, and all can be scaled by a number or a
// Coefficient. For other arithmetic within a function, use `color`.
template <class Kind>
struct Quantity {
  Color color{0, 0, 0};

  constexpr Quantity() = default;
  explicit constexpr Quantity(const Color& c) : color(c) {}
  explicit constexpr Quantity(Color&& c) : color(std::move(c)) {}
  explicit constexpr Quantity(double gray) : color(gray) {}

  Quantity& operator+=(const Quantity& other) {
    color += other.color;
    return *this;
  }
  Quantity& operator-=(const Quantity& other) {
    color -= other.color;
    return *this;
  }
  Quantity& operator*=(double factor) {
    color *= factor;
    return *this;
  }
  Quantity& operator/=(double divisor) {
    color /= divisor;
    return *this;
  }
  friend Quantity operator+(const Quantity& a, const Quantity& b) { return Quantity(a.color + b.color); }
  friend Quantity operator-(const Quantity& a, const Quantity& b) { return Quantity(a.color - b.color); }
  friend Quantity operator*(const Quantity& a, double factor) { return Quantity(a.color * factor); }
  friend Quantity operator*(double factor, const Quantity& a) { return Quantity(a.color * factor); }
  friend Quantity operator/(const Quantity& a, double divisor) { return Quantity(a.color / divisor); }
};

using Radiance = Quantity<struct RadianceKind>;      // W/sr/m2
using Irradiance = Quantity<struct IrradianceKind>;  // W/m2; any integral of radiance over directions
// The fraction of a quantity that remains after reflection, transmission or sampling; dimensionless.
using Coefficient = Quantity<struct CoefficientKind>;

template <class Kind>
Quantity<Kind> operator*(const Quantity<Kind>& a, const Coefficient& share) {
  return Quantity<Kind>(a.color * share.color);
}
template <class Kind>
requires(!std::is_same_v<Quantity<Kind>, Coefficient>) Quantity<Kind>
operator*(const Coefficient& share, const Quantity<Kind>& a) { return Quantity<Kind>(share.color * a.color); }
template <class Kind>
Quantity<Kind>& operator*=(Quantity<Kind>& a, const Coefficient& share) {
  a.color *= share.color;
  return a;
}

// The irradiance of a surface perpendicular to a radiance from a small solid angle (sr).
inline Irradiance irradianceFrom(const Radiance& radiance, double solidAngle) {
  return Irradiance(radiance.color * solidAngle);
}
// The mean radiance from a solid angle (sr) that causes an irradiance.
inline Radiance meanRadiance(const Irradiance& irradiance, double solidAngle) {
  return Radiance(irradiance.color / solidAngle);
}

template <class Kind>
double brightness(const Quantity<Kind>& a) {
  return brightness(a.color);
}
template <class Kind>
double maxChannel(const Quantity<Kind>& a) {
  return maxChannel(a.color);
}
template <class Kind>
bool isBlack(const Quantity<Kind>& a) {
  return isBlack(a.color);
}

}  // namespace rsphere
