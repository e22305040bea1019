#include "shade/anisotropic.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/constants.h"

namespace rsphere {
namespace {

constexpr double kLeastCosine = .001;

// The Fresnel increase of reflection for a polished WGMDfunc: Ward's exponential for an index of about 1.5.
// The constant is RADIANCE's; it leaves an increase of .0008 at normal incidence.
double fresnelRiseOfFunction(double cosine) { return std::exp(-5.85 * cosine) - .00202943064; }

double schlick(double cosine) {
  const double c = 1 - cosine, c2 = c * c;
  return c2 * c2 * c;
}

Color gray(double x) { return Color(x, x, x); }

// Sets the lobe's tangents and its mean square slopes along them.
void orient(EllipticLobe& lobe, const V3d& along, double roughnessAlong, double roughnessAcross) {
  lobe.tangents = tangents(lobe.normal, along);
  lobe.alongSquare = roughnessAlong * roughnessAlong;
  lobe.acrossSquare = roughnessAcross * roughnessAcross;
  if (lobe.tangents.given) return;
  constexpr double kAlike = .001;  // difference below which roughnesses are treated as equal; RADIANCE's
                                   // value
  lobe.disoriented = std::abs(roughnessAlong - roughnessAcross) > kAlike;
  lobe.alongSquare = lobe.acrossSquare = (lobe.alongSquare + lobe.acrossSquare) / 2;
}

double reflectedLobe(const EllipticLobe& lobe, const V3d& direction, const V3d& toSource, double widening) {
  const double along2 = lobe.alongSquare + widening, across2 = lobe.acrossSquare + widening;
  const V3d half = toSource - direction;
  const double a = lobe.tangents.along.dot(half), b = lobe.tangents.across.dot(half);
  const double up = lobe.normal.dot(half), up2 = up * up;
  return std::exp(-(a * a / along2 + b * b / across2) / up2) * half.length2() /
         (kPi * up2 * up2 * std::sqrt(along2 * across2));
}

// The lobe's value (1/sr) times cosineBeyond (above 0), the cosine of the direction to the source.
double transmittedLobe(const EllipticLobe& lobe, const V3d& toSource, double cosineBeyond,
                       double solidAngle) {
  const double widening = solidAngle / kPi;
  const double along2 = lobe.alongSquare + widening, across2 = lobe.acrossSquare + widening;
  const V3d off = toSource - lobe.transmitted;
  const double length2 = off.length2(), up = off.dot(lobe.normal);
  double exponent = 0;
  if (length2 > kNegligible * kNegligible) {
    const double within = 1 - up * up / length2;
    if (within > kNegligible * kNegligible) {
      const double a = lobe.tangents.along.dot(off), b = lobe.tangents.across.dot(off);
      exponent = (a * a / along2 + b * b / across2) / within;
    }
  }
  return std::exp(-exponent) / kPi * std::sqrt(cosineBeyond / (lobe.cosine * along2 * across2));
}

// A sample of the lobe's Gaussian distribution of slopes, as an offset in the tangent plane.
V3d offset(const EllipticLobe& lobe, double spread, double u1, double u2) {
  const double v = std::max(1 - std::min(spread, 1.) * u2, kNegligible);
  const double radius = std::sqrt(-std::log(v)), angle = 2 * kPi * u1;
  return radius * std::cos(angle) * std::sqrt(lobe.alongSquare) * lobe.tangents.along +
         radius * std::sin(angle) * std::sqrt(lobe.acrossSquare) * lobe.tangents.across;
}

// The lobe of a component of WGMDfunc. Sets `sharp` if the component must become a sharp path instead.
EllipticLobe beginLobe(const WgmdComponent& c, const V3d& along, bool& sharp) {
  EllipticLobe lobe;
  lobe.share = c.at.pattern * c.share;
  lobe.normal = normalOf(c.at, lobe.cosine);
  lobe.cosine = std::max(lobe.cosine, kLeastCosine);
  sharp = !(c.roughnessAlong > kNegligible && c.roughnessAcross > kNegligible);
  if (!sharp) orient(lobe, along, c.roughnessAlong, c.roughnessAcross);
  return lobe;
}

// Decides whether a lobe is sampled (-st). Otherwise its share is added to the indirect light of the diffuse
// component, unless that is black.
void sampleOrAdd(EllipticLobe& lobe, double share, double threshold, DiffuseComponent& diffuse) {
  lobe.sampled = threshold < share - kNegligible;
  if (!lobe.sampled && maxChannel(diffuse.share) > kNegligible) diffuse.ambient += lobe.share;
}

bool present(const WgmdComponent& c) {
  return c.share > kNegligible && maxChannel(c.at.pattern) > kNegligible;
}

}  // namespace

Tangents tangents(const V3d& normal, const V3d& direction) {
  Tangents t;
  t.across = normal.cross(direction);
  const double length = t.across.length();
  // The direction is 0 or, within rounding, parallel to the normal.
  if (!(length > 1e-12 * direction.length())) {
    t.given = false;
    std::tie(t.along, t.across) = frame(normal);
    return t;
  }
  t.across /= length;
  t.along = t.across.cross(normal);
  return t;
}

AnisotropicScattering scatter(const Anisotropic& m, const Interaction& at, const V3d& along,
                              double specularThreshold) {
  AnisotropicScattering s;
  double cosine = 0;
  const V3d normal = normalOf(at, cosine);
  cosine = std::max(cosine, kLeastCosine);
  s.reflection.normal = s.transmission.normal = normal;
  s.widenReflection = at.flat && !isPerturbed(at);
  const Color color = m.color * at.pattern;
  const double passes = m.transmissivity * (1 - m.specularity);
  const double straight = passes * m.transmittedSpecular;
  s.reflection.share = s.reflection.ambient = color * (1 - passes - m.specularity);
  s.transmission.share = s.transmission.ambient = color * (passes - straight);
  EllipticLobe lobe;
  lobe.normal = normal;
  lobe.cosine = cosine;
  orient(lobe, along, m.roughnessAlong, m.roughnessAcross);
  if (m.specularity > kNegligible) {
    s.reflected = lobe;
    s.reflected.share = m.metal ? color * m.specularity : gray(m.specularity);
    sampleOrAdd(s.reflected, m.specularity, specularThreshold, s.reflection);
  }
  if (straight > kNegligible) {
    s.transmitted = lobe;
    s.transmitted.share = color * straight;
    s.transmitted.transmitted = at.direction;
    if (isPerturbed(at) && !at.smoothed) {
      const V3d bent = at.direction - at.perturbation;
      if (bent.dot(at.normal) < -kNegligible) s.transmitted.transmitted = bent.normalized();
    }
    sampleOrAdd(s.transmitted, straight, specularThreshold, s.transmission);
  }
  return s;
}

AnisotropicScattering scatter(const WgmdFunction& m, const WgmdComponent& reflected,
                              const WgmdComponent& transmitted, const Interaction& diffuseReflected,
                              const Interaction& diffuseTransmitted, const V3d& along,
                              double specularThreshold) {
  AnisotropicScattering s;
  double cosine = 0;
  s.reflection.normal = normalOf(diffuseReflected, cosine);
  s.reflection.share = (diffuseReflected.front ? m.diffuseFront : m.diffuseBack) * diffuseReflected.pattern;
  s.transmission.normal = normalOf(diffuseTransmitted, cosine);
  s.transmission.share = m.diffuseTransmitted * diffuseTransmitted.pattern;
  bool mirrors = false, passes = false;
  if (present(reflected)) s.reflected = beginLobe(reflected, along, mirrors);
  if (present(transmitted)) s.transmitted = beginLobe(transmitted, along, passes);
  if (mirrors && brightness(s.reflected.share) >= kFresnelSpecularity) {
    double mirrorCosine = 0;
    s.polished = true;
    s.polishedNormal = normalOf(reflected.at, mirrorCosine);
    const double rise = fresnelRiseOfFunction(mirrorCosine);
    s.reflected.share += rise * (Color(1, 1, 1) - s.reflected.share);
    s.reflection.share *= 1 - rise;
    s.transmission.share *= 1 - rise;
    s.transmitted.share *= 1 - rise;
  }
  s.reflection.ambient = s.reflection.share;
  s.transmission.ambient = s.transmission.share;
  s.widenReflection = reflected.at.flat && !isPerturbed(reflected.at);

  if (maxChannel(s.transmitted.share) > 0) {
    const Interaction& at = transmitted.at;
    V3d& through = s.transmitted.transmitted;
    through = at.direction;
    if (isPerturbed(at) && !(at.kinds & (kShadow | kAmbient)) && !at.smoothed) {
      const V3d bend = s.transmitted.normal - at.normal;
      const V3d bent = at.front ? at.direction - bend : at.direction + bend;
      if (bent.dot(at.normal) < 0) through = bent.normalized();
    }
    if (passes) {
      const double bright = brightness(s.transmitted.share);
      const bool image = bright > brightness(s.reflection.share) + brightness(s.transmission.share);
      s.sharp.add({through, Coefficient(s.transmitted.share), kTransmitted, image});
      s.transmitted.share = Color(0, 0, 0);
    } else {
      sampleOrAdd(s.transmitted, brightness(s.transmitted.share), specularThreshold, s.transmission);
    }
  }
  if (mirrors) {
    const Interaction& at = reflected.at;
    V3d mirrored = at.direction - 2 * at.direction.dot(s.reflected.normal) * s.reflected.normal;
    if (isPerturbed(at) && mirrored.dot(at.normal) <= 0) mirrored = at.direction + 2 * at.cosine * at.normal;
    s.sharp.add({mirrored.normalized(), Coefficient(s.reflected.share), kReflected,
                 s.widenReflection && (at.kinds & kAmbient) != 0});
    s.reflected.share = Color(0, 0, 0);
  } else if (maxChannel(s.reflected.share) > 0) {
    sampleOrAdd(s.reflected, brightness(s.reflected.share), specularThreshold, s.reflection);
  }
  return s;
}

Coefficient directCoefficient(const AnisotropicScattering& s, const V3d& direction, const V3d& toSource,
                              double solidAngle, double sourceJitter) {
  Coefficient sum;
  const double enters = s.polished ? 1 - fresnelRiseOfFunction(std::abs(s.polishedNormal.dot(toSource))) : 1;
  const double before = s.reflection.normal.dot(toSource), beyond = -s.transmission.normal.dot(toSource);
  if (before > kNegligible) sum.color += s.reflection.share * (enters * before * solidAngle / kPi);
  if (beyond > kNegligible) sum.color += s.transmission.share * (enters * beyond * solidAngle / kPi);
  if (maxChannel(s.reflected.share) > 0) {
    const double cosine = s.reflected.normal.dot(toSource);
    if (cosine > kNegligible) {
      const double widening = s.widenReflection ? (1 - sourceJitter) * solidAngle * .25 / kPi : 0;
      const double lobe = reflectedLobe(s.reflected, direction, toSource, widening);
      if (lobe > kNegligible) sum.color += s.reflected.share * (lobe * cosine * solidAngle);
    }
  }
  if (maxChannel(s.transmitted.share) > 0) {
    const double cosine = -s.transmitted.normal.dot(toSource);
    if (cosine > kNegligible) {
      const double lobe = transmittedLobe(s.transmitted, toSource, cosine, solidAngle);
      if (lobe > kNegligible) sum.color += s.transmitted.share * (lobe * solidAngle);
    }
  }
  return sum;
}

double sampleReflection(const EllipticLobe& lobe, const Interaction& at, double spread, double u1, double u2,
                        V3d& direction) {
  const V3d half = lobe.normal + offset(lobe, spread, u1, u2);
  direction = at.direction - 2 * half.dot(at.direction) / half.length2() * half;
  const double out = direction.dot(lobe.normal);
  if (out <= kNegligible || direction.dot(at.normal) <= kNegligible) return 0;
  return 2 / (1 + lobe.cosine / out);
}

double reflectedDensity(const EllipticLobe& lobe, const Interaction& at, const V3d& direction) {
  const double cosine = lobe.normal.dot(direction);
  if (cosine <= kNegligible || direction.dot(at.normal) <= kNegligible) return 0;
  const double density = reflectedLobe(lobe, at.direction, direction, 0);
  return density > kNegligible ? density * cosine : 0;
}

double sampleTransmission(const EllipticLobe& lobe, const Interaction& at, double spread, double u1,
                          double u2, V3d& direction) {
  direction = lobe.transmitted + offset(lobe, spread, u1, u2);
  if (direction.dot(at.normal) >= -kNegligible) return 0;
  direction.normalize();
  return 1;
}

AshikhminScattering scatter(const Ashikhmin& m, const Interaction& at, const V3d& along,
                            double specularThreshold) {
  AshikhminScattering s;
  s.reflection.normal = normalOf(at, s.cosine);
  s.cosine = std::max(s.cosine, kLeastCosine);
  s.reflection.share = s.reflection.ambient = m.diffuse * at.pattern;
  s.powerAlong = m.powerAlong;
  s.powerAcross = m.powerAcross;
  s.tangents = tangents(s.reflection.normal, along);
  if (!s.tangents.given) {  // the harmonic mean of the powers; the constant avoids a division by zero
    constexpr double kAbove = 1e-5;
    s.powerAlong = s.powerAcross = 2 / (1 / (m.powerAlong + kAbove) + 1 / (m.powerAcross + kAbove));
  }
  if (maxChannel(m.specular) > kNegligible) {
    s.share = m.specular + schlick(s.cosine) * (Color(1, 1, 1) - m.specular);
    s.sampled = specularThreshold < brightness(m.specular) - kNegligible;
    if (!s.sampled && maxChannel(s.reflection.share) > kNegligible) s.reflection.ambient += s.share;
  }
  return s;
}

Coefficient directCoefficient(const AshikhminScattering& s, const V3d& direction, const V3d& toSource,
                              double solidAngle) {
  const double cosine = s.reflection.normal.dot(toSource);
  if (cosine <= kNegligible) return {};
  Coefficient sum(s.reflection.share * ((1 - schlick(cosine)) * cosine * solidAngle / kPi));
  if (maxChannel(s.share) > 0) {
    const V3d half = (toSource - direction).normalized();
    const double up = half.dot(s.reflection.normal);
    const double a = half.dot(s.tangents.along), b = half.dot(s.tangents.across);
    // (h.u)^2 + (h.v)^2 = 1 - (h.n)^2. If this is 0, the base of the power is 1, for any exponent.
    const double within = 1 - up * up;
    const double power = within > 0 ? (s.powerAlong * a * a + s.powerAcross * b * b) / within : 0;
    const double lobe = std::pow(up, power) * std::sqrt((s.powerAlong + 1) * (s.powerAcross + 1)) /
                        (8 * kPi * toSource.dot(half) * std::max(cosine, s.cosine));
    if (lobe > kNegligible) sum.color += s.share * (lobe * cosine * solidAngle);
  }
  return sum;
}

bool sampleReflection(const AshikhminScattering& s, const Interaction& at, double u1, double u2,
                      V3d& direction) {
  const double angle = 2 * kPi * u1;
  double x = std::sqrt(s.powerAcross + 1) * std::cos(angle),
         y = std::sqrt(s.powerAlong + 1) * std::sin(angle);
  const double length = std::hypot(x, y);
  x /= length;
  y /= length;
  const double up = std::pow(1 - u2, 1 / (s.powerAlong * x * x + s.powerAcross * y * y + 1));
  const double within = std::sqrt(std::max(0., 1 - up * up));
  const V3d half = within * (x * s.tangents.along + y * s.tangents.across) + up * s.reflection.normal;
  direction = (at.direction - 2 * half.dot(at.direction) * half).normalized();
  return direction.dot(at.normal) > kNegligible;
}

}  // namespace rsphere
