#pragma once
// Materials whose directional scattering is a function or table: plasfunc, metfunc, transfunc, plasdata,
// metdata, transdata and BRTDfunc, as pure functions. Source: RADIANCE reference manual, "Material types".
//
// As in RADIANCE, the functions are evaluated for light sources only. For indirect light, the directional
// component is treated as diffuse (plasfunc and the like) or omitted (BRTDfunc). Energy is conserved only if
// the functions of the material do so.
#include <array>
#include <cmath>

#include "base/constants.h"
#include "shade/scattering.h"

namespace rsphere {

struct FunctionScattering {
  V3d normal{0, 0, 1};   // perturbed, on the ray's side
  double cosine = 1;     // -normal . direction
  Color color{1, 1, 1};  // passed to the functions as the material's color
  SharpPaths sharp;
  Color diffuseReflection{0, 0, 0}, diffuseTransmission{0, 0, 0};
  Color ambientReflection{0, 0, 0}, ambientTransmission{0, 0, 0};
  // Factors on the functions' values for sources in front of the surface and behind it. If black, the
  // functions are not evaluated.
  Color directionalReflection{0, 0, 0}, directionalTransmission{0, 0, 0};
};

FunctionScattering scatter(const FunctionScatterer& material, const Interaction& at);

// Returns no sharp paths, because the functions that define them take this result as input.
FunctionScattering scatter(const BrtdFunction& material, const Interaction& at);
// The sharp paths of BRTDfunc. coefficient: values of the material's functions, by channel.
SharpPath sharpTransmission(const FunctionScattering& scattering, const Interaction& at,
                            const std::array<double, 3>& coefficient);
SharpPath sharpReflection(const FunctionScattering& scattering, const Interaction& at,
                          const std::array<double, 3>& coefficient);

// The fraction of a source's radiance that is scattered towards the ray's origin; see scattering.h.
// distribution: returns the functions' values (1/sr); it is called at most once.
template <class Distribution>
Coefficient directCoefficient(const FunctionScattering& s, const V3d& toSource, double solidAngle,
                              const Distribution& distribution) {
  const double cosine = s.normal.dot(toSource);
  if (std::abs(cosine) <= kNegligible) return {};
  const double projected = std::abs(cosine) * solidAngle;
  Coefficient sum((cosine > 0 ? s.diffuseReflection : s.diffuseTransmission) * (kPerPi * projected));
  const Color& directional = cosine > 0 ? s.directionalReflection : s.directionalTransmission;
  if (maxChannel(directional) > kNegligible) {
    const Color value = distribution();
    if (brightness(value) > kNegligible) sum.color += value * directional * projected;
  }
  return sum;
}

}  // namespace rsphere
