#pragma once
// Materials whose directional scattering is a function or table: plasfunc, metfunc, transfunc, plasdata,
// metdata, transdata and BRTDfunc, as pure functions. Source: RADIANCE reference manual, "Material types".
//
// What the functions say is only asked for towards light sources, as the original does: directional indirect
// light is taken for diffuse (plasfunc and its kin) or left out (BRTDfunc). Whether a material gives back
// more than it gets is up to its functions.
#include <array>

#include "shade/scattering.h"

namespace rsphere {

struct FunctionScattering {
  V3d normal{0, 0, 1};  // perturbed, on the ray's side
  double cosine = 1;    // -normal . direction
  Rgb color{1, 1, 1};   // that the functions are told of
  SharpPaths sharp;
  Rgb diffuseReflection{0, 0, 0}, diffuseTransmission{0, 0, 0};
  Rgb ambientReflection{0, 0, 0}, ambientTransmission{0, 0, 0};
  // What the functions' values are multiplied by, before the surface and beyond it; black: they aren't asked.
  Rgb directionalReflection{0, 0, 0}, directionalTransmission{0, 0, 0};
};

FunctionScattering scatter(const FunctionScatterer& material, const Interaction& at);

// Without its sharp paths, which depend on functions that are told what is in here.
FunctionScattering scatter(const BrtdFunction& material, const Interaction& at);
// Its sharp paths, with the coefficients that its functions give.
SharpPath sharpTransmission(const FunctionScattering& scattering, const Interaction& at,
                            const std::array<double, 3>& coefficient);
SharpPath sharpReflection(const FunctionScattering& scattering, const Interaction& at,
                          const std::array<double, 3>& coefficient);

// The share of a source's radiance that leaves along the ray; see scattering.h. distribution: answers the
// functions' values, per sr, and is called once at most.
template <class Distribution>
Rgb directCoefficient(const FunctionScattering& s, const V3d& toSource, double solidAngle,
                      const Distribution& distribution) {
  constexpr double kNegligible = 1e-6;               // what is lit from farther aslant, and less, is not lit
  constexpr double kPerSr = 0.31830988618379067154;  // 1/pi: a diffuse surface's
  const double cosine = s.normal.dot(toSource);
  if (std::abs(cosine) <= kNegligible) return Rgb(0, 0, 0);
  const double projected = std::abs(cosine) * solidAngle;
  Rgb sum = (cosine > 0 ? s.diffuseReflection : s.diffuseTransmission) * (kPerSr * projected);
  const Rgb& directional = cosine > 0 ? s.directionalReflection : s.directionalTransmission;
  if (maxChannel(directional) > kNegligible) {
    const Rgb value = distribution();
    if (brightness(value) > kNegligible) sum += value * directional * projected;
  }
  return sum;
}

}  // namespace rsphere
