#include "shade/function_reflection.h"

namespace rsphere {

FunctionScattering scatter(const FunctionScatterer& m, const Interaction& at) {
  FunctionScattering s;
  s.normal = normalOf(at, s.cosine);
  s.color = m.color * at.pattern;
  const double passes = m.transmissivity * (1 - m.specularity);
  const double directional = passes * m.transmittedSpecular;
  s.diffuseReflection = s.color * (1 - passes - m.specularity);
  s.diffuseTransmission = s.color * (passes - directional);
  s.ambientReflection = s.color * (1 - passes);
  s.ambientTransmission = s.color * passes;
  s.directionalReflection =
      m.metal ? s.color * m.specularity : Color(m.specularity, m.specularity, m.specularity);
  s.directionalTransmission = s.color * directional;
  return s;
}

FunctionScattering scatter(const BrtdFunction& m, const Interaction& at) {
  FunctionScattering s;
  s.normal = normalOf(at, s.cosine);
  s.color = at.pattern;
  s.diffuseReflection = s.ambientReflection = (at.front ? m.diffuseFront : m.diffuseBack) * at.pattern;
  s.diffuseTransmission = s.ambientTransmission = m.diffuseTransmitted * at.pattern;
  if (m.directional) s.directionalReflection = s.directionalTransmission = Color(1, 1, 1);
  return s;
}

SharpPath sharpTransmission(const FunctionScattering& s, const Interaction& at,
                            const std::array<double, 3>& c) {
  const bool straight = !isPerturbed(at) || (at.kinds & (kShadow | kAmbient));
  SharpPath path{at.direction, Coefficient(Color(c[0], c[1], c[2])), kTransmitted, false};
  path.lengthCounts = straight && brightness(s.diffuseReflection) + brightness(s.diffuseTransmission) < 1;
  if (!straight && !at.smoothed) {
    const V3d bent = at.direction - at.perturbation;
    const double length = bent.length();
    if (length > 0) path.direction = bent / length;
  }
  return path;
}

SharpPath sharpReflection(const FunctionScattering& s, const Interaction& at,
                          const std::array<double, 3>& c) {
  return {(at.direction + 2 * s.cosine * s.normal).normalized(), Coefficient(Color(c[0], c[1], c[2])),
          kReflected, at.flat && (!isPerturbed(at) || (at.kinds & kAmbient))};
}

}  // namespace rsphere
