#include "shade/scattering.h"

#include <algorithm>
#include <cmath>

namespace rsphere {
namespace {

// Ward's exponential approximation of Fresnel's equations for a polished surface with a refractive index of
// about 1.5. The constant makes it 0 at normal incidence.
double fresnelRise(double cosine) { return std::exp(-5.85 * cosine) - 0.00287989916; }

V3d mirrored(const V3d& direction, const V3d& normal, double cosine) {
  return direction + 2 * cosine * normal;
}

// Mirrors at the perturbed normal, or at the true normal if the result would be below the surface.
V3d safelyMirrored(const Interaction& at, const V3d& normal, double cosine) {
  V3d d = mirrored(at.direction, normal, cosine);
  if (isPerturbed(at) && d.dot(at.normal) <= kNegligible) d = mirrored(at.direction, at.normal, at.cosine);
  return d.normalized();
}

// The specular reflection of plastic, metal and trans.
struct Gloss {
  bool polished = false;
  double fresnel = 0;   // increase of the specular share towards grazing angles
  double specular = 0;  // the specular share, including this increase
};

Gloss gloss(double specularity, double roughness, double cosine) {
  Gloss g;
  g.polished = roughness * roughness <= kNegligible;
  g.specular = specularity;
  if (g.polished && specularity >= kFresnelSpecularity) {
    g.fresnel = fresnelRise(cosine);
    g.specular += g.fresnel * (1 - specularity);
  }
  return g;
}

void beginScattering(Scattering& s, const Interaction& at, double roughness) {
  s.normal = normalOf(at, s.cosine);
  s.cosine = std::max(s.cosine, .001);
  s.alpha2 = roughness * roughness;
  s.widenReflection = at.flat && !isPerturbed(at);
}

void addReflection(Scattering& s, const Interaction& at, const Gloss& g, const Color& color,
                   double specularThreshold) {
  if (g.specular <= kNegligible) return;
  if (g.polished) {
    s.sharp.add({safelyMirrored(at, s.normal, s.cosine), Coefficient(color), kReflected,
                 s.widenReflection && (at.kinds & kAmbient) != 0});
  } else {
    s.specularReflection = color;
    s.sampleReflection = specularThreshold < g.specular - kNegligible;
    if (!s.sampleReflection && maxChannel(s.diffuseReflection) > kNegligible) s.ambientReflection += color;
  }
}

// Fresnel's reflectance for unpolarised light; 1 for total reflection. ratio: the refractive index on the
// ray's side divided by that on the other side. Sets cosineBeyond, the cosine of the refracted ray.
double fresnelReflectance(double cosine, double ratio, double& cosineBeyond) {
  const double square = 1 - ratio * ratio * (1 - cosine * cosine);
  if (square < kNegligible) return 1;
  cosineBeyond = std::sqrt(square);
  const double s = (cosine - cosineBeyond / ratio) / (cosine + cosineBeyond / ratio);
  const double p = (cosine / ratio - cosineBeyond) / (cosine / ratio + cosineBeyond);
  return (s * s + p * p) / 2;
}

// Converts transmission per unit length to extinction per unit length. It is limited to 0 to 100: no medium
// is completely black, and none amplifies light.
Color extinctionOf(const Color& transmission, const Color& pattern) {
  Color e = transmission * pattern;
  e.transform([](double t) { return t < 1e-40 ? 100 : t >= 1 ? 0 : -std::log(t); });
  // Each of the three channels is the mean of the extinctions of its bands, not the extinction of the mean
  // transmission. It is then 0 only if that of every band is, although the pattern of a band may exceed 1.
  if (e.bands()) [[unlikely]]
    e = Color(e.bands());
  return e;
}

// Reflection and refraction at a boundary. inner, outer: refractive index behind the surface and in front of
// it, each followed by the medium there.
Scattering scatterAtBoundary(const Interaction& at, double inner, const Medium& innerMedium, double outer,
                             const Medium& outerMedium, bool basic) {
  Scattering s;
  beginScattering(s, at, 0);
  s.medium = at.front ? outerMedium : innerMedium;
  const double ratio = at.front ? outer / inner : inner / outer;
  double cosineBeyond = 0;
  const double reflectance = fresnelReflectance(s.cosine, ratio, cosineBeyond);
  const bool image = at.flat && (!isPerturbed(at) || (at.kinds & kAmbient));
  if (reflectance < 1) {
    // Refraction changes a beam's solid angle, and thus its radiance, by the ratio of the squared indices.
    const double transmittance = (1 - reflectance) * (basic ? 1 : ratio * ratio);
    const double bend = ratio * s.cosine - cosineBeyond;
    V3d d = ratio * at.direction + bend * s.normal;
    if (isPerturbed(at) && d.dot(at.normal) >= -kNegligible) d = ratio * at.direction + bend * at.normal;
    s.sharp.add({d.normalized(), Coefficient(transmittance), kRefracted,
                 image || std::abs(ratio - 1) <= kNegligible, true, at.front ? innerMedium : outerMedium});
  }
  if (!(at.kinds & kShadow))
    s.sharp.add({safelyMirrored(at, s.normal, s.cosine), Coefficient(reflectance), kReflected, image, true,
                 s.medium});
  return s;
}

// The reflected lobe towards a source, per sr and share, without the cosine factor.
double reflectedLobe(const Scattering& s, const Interaction& at, const V3d& toSource, double alpha2) {
  const V3d half = toSource - at.direction;
  const double along = half.dot(s.normal);
  const double along2 = along * along, length2 = half.length2();
  const double tangent2 = (length2 - along2) / along2;
  return std::exp(-tangent2 / alpha2) * length2 / (kPi * along2 * along2 * alpha2);
}

// The two branches of directCoefficient(), for sources in front of the surface and behind it. enters: the
// fraction of the light that is not reflected specularly, and is therefore scattered diffusely.
Coefficient reflectedCoefficient(const Scattering& s, const Interaction& at, const V3d& toSource,
                                 double cosine, double enters, double solidAngle, double sourceJitter) {
  Coefficient sum(s.diffuseReflection * (enters * cosine * solidAngle * kPerPi));
  if (maxChannel(s.specularReflection) > 0) {
    double alpha2 = s.alpha2;
    if (s.widenReflection) alpha2 += (1 - sourceJitter) * solidAngle * .25 / kPi;
    const double lobe = reflectedLobe(s, at, toSource, alpha2);
    if (lobe > kNegligible) sum.color.addScaled(s.specularReflection, lobe * cosine * solidAngle);
  }
  return sum;
}

Coefficient transmittedCoefficient(const Scattering& s, const V3d& toSource, double cosine, double enters,
                                   double solidAngle) {
  Coefficient sum(s.diffuseTransmission * (enters * -cosine * solidAngle * kPerPi));
  if (maxChannel(s.specularTransmission) > 0) {
    const double alpha2 = s.alpha2 + solidAngle / kPi;
    const double lobe = std::exp((2 * s.transmitted.dot(toSource) - 2) / alpha2) / (kPi * alpha2);
    if (lobe > kNegligible)
      sum.color.addScaled(s.specularTransmission, lobe * solidAngle * std::sqrt(-cosine / s.cosine));
  }
  return sum;
}

// Distance of a lobe's sample from its middle, in the tangent plane: inverts exp(-(d/alpha)^2).
double lobeRadius(double alpha2, double spread, double u) {
  const double v = 1 - std::min(spread, 1.) * u;
  return v > kNegligible ? std::sqrt(-alpha2 * std::log(v)) : 1;
}

}  // namespace

V3d diffuseDirection(const V3d& normal, double u1, double u2) {
  const auto [x, y] = frame(normal);
  const double radius = std::sqrt(u1), angle = 2 * kPi * u2;
  return radius * std::cos(angle) * x + radius * std::sin(angle) * y + std::sqrt(1 - u1) * normal;
}

V3d perturbedNormal(const Interaction& at, double& cosine) {
  V3d n = at.normal + at.perturbation;
  const double length = n.length();
  if (!(length > 0)) {
    cosine = at.cosine;
    return at.normal;
  }
  n /= length;
  cosine = -n.dot(at.direction);
  if (cosine < 0) {  // facing away from the ray: reflect it at the plane perpendicular to the ray
    n += 2 * cosine * at.direction;
    cosine = -cosine;
  }
  return n;
}

double diffuseShare(const Opaque& material, double cosine) {
  return 1 - gloss(material.specularity, material.roughness, std::max(cosine, .001)).specular;
}

double enteringShare(const Opaque& material, double cosine) {
  const Gloss g = gloss(material.specularity, material.roughness, cosine);
  return g.polished && material.specularity >= kFresnelSpecularity ? 1 - fresnelRise(cosine) : 1;
}

Scattering scatter(const Opaque& material, const Interaction& at, double specularThreshold) {
  Scattering s;
  beginScattering(s, at, material.roughness);
  const Color color = material.color * at.pattern;
  const Gloss g = gloss(material.specularity, material.roughness, s.cosine);
  s.diffuseReflection = s.ambientReflection = color * (1 - g.specular);
  s.diffuseFresnel = g.polished && g.specular >= kFresnelSpecularity;
  Color highlight(g.specular, g.specular, g.specular);
  if (material.metal)
    highlight = g.fresnel > kNegligible ? Color(g.fresnel, g.fresnel, g.fresnel) +
                                              color * (material.specularity * (1 - g.fresnel))
                                        : color * g.specular;
  addReflection(s, at, g, highlight, specularThreshold);
  return s;
}

Scattering scatter(const Trans& material, const Interaction& at, double specularThreshold) {
  Scattering s;
  beginScattering(s, at, material.roughness);
  const Color color = material.color * at.pattern;
  const Gloss g = gloss(material.specularity, material.roughness, s.cosine);
  const double passes = material.transmissivity * (1 - g.specular);
  const double straight = passes * material.transmittedSpecular;
  s.diffuseReflection = s.ambientReflection = color * (1 - passes - g.specular);
  s.diffuseTransmission = s.ambientTransmission = color * (passes - straight);
  s.diffuseFresnel = g.polished && g.specular >= kFresnelSpecularity;
  if (straight > kNegligible) {
    s.transmitted = at.direction;
    if (isPerturbed(at) && !(at.kinds & (kShadow | kAmbient)) && !at.smoothed) {
      const V3d bent = at.direction - at.perturbation;
      if (bent.dot(at.normal) < -kNegligible) s.transmitted = bent.normalized();
    }
    if (g.polished) {
      const bool image = straight >= 1 - kNegligible || 2 * straight > 1 - g.specular;
      s.sharp.add({s.transmitted, Coefficient(color * straight), kTransmitted, image});
    } else {
      s.specularTransmission = color * straight;
      s.sampleTransmission = specularThreshold < straight - kNegligible;
      if (!s.sampleTransmission && maxChannel(s.diffuseTransmission) > kNegligible)
        s.ambientTransmission = color * passes;
    }
  }
  if (!(at.kinds & kShadow))
    addReflection(s, at, g, Color(g.specular, g.specular, g.specular), specularThreshold);
  return s;
}

Scattering scatter(const Dielectric& material, const Interaction& at, const Medium& outer, bool basic) {
  // Hartmann's formula at a mean wavelength of 500 nm.
  return scatterAtBoundary(at, material.refraction + material.hartmann / 500,
                           {extinctionOf(material.transmission, at.pattern)}, 1, outer, basic);
}

Scattering scatter(const Interface& material, const Interaction& at, bool basic) {
  return scatterAtBoundary(at, material.innerRefraction,
                           {extinctionOf(material.innerTransmission, at.pattern)}, material.outerRefraction,
                           {extinctionOf(material.outerTransmission, at.pattern)}, basic);
}

Scattering scatter(const Glass& material, const Interaction& at) {
  Scattering s;
  s.normal = normalOf(at, s.cosine);
  const double n = material.refraction;
  const double inside = std::sqrt(1 - 1 / (n * n) + s.cosine * s.cosine / (n * n));
  double reflected[2];  // amplitudes at a single surface, for the two polarisations
  reflected[0] = (s.cosine - n * inside) / (s.cosine + n * inside);
  reflected[1] = (1 / s.cosine - n / inside) / (1 / s.cosine + n / inside);
  Color transmittance(0, 0, 0), reflectance(0, 0, 0);
  V3d passed(0, 0, 0);  // once through the pane
  for (int i = 0; i < 3; ++i)
    if (material.transmissivity[i] > 0) passed[i] = std::pow(material.transmissivity[i], 1 / inside);
  for (const double amplitude : reflected) {
    const double r = amplitude * amplitude;
    for (int i = 0; i < 3; ++i) {
      const double t = passed[i];
      const double between = 1 - r * r * t * t;
      transmittance[i] += .5 * (1 - r) * (1 - r) * t / between;
      reflectance[i] += .5 * r * (1 + (1 - 2 * r) * t * t) / between;
    }
  }
  transmittance *= at.pattern;
  if (maxChannel(transmittance) > 0) {
    V3d d = at.direction;
    const bool bends = isPerturbed(at) && !(at.kinds & (kShadow | kAmbient)) && !at.smoothed;
    if (bends) {
      d += 2 * (1 - n) * at.perturbation;
      const double length = d.length();
      d = length > 0 ? d / length : at.direction;
    }
    s.sharp.add({d, Coefficient(transmittance), kTransmitted,
                 !isPerturbed(at) || (at.kinds & (kShadow | kAmbient)) != 0});
  }
  if (!(at.kinds & kShadow))
    s.sharp.add({mirrored(at.direction, s.normal, s.cosine).normalized(), Coefficient(reflectance),
                 kReflected, at.flat && (!isPerturbed(at) || (at.kinds & kAmbient))});
  return s;
}

Scattering scatter(const Mirror& material, const Interaction& at) {
  Scattering s;
  s.normal = at.normal;
  s.cosine = at.cosine;
  const bool bends = isPerturbed(at) && !(at.kinds & kAmbient);
  if (bends) s.normal = perturbedNormal(at, s.cosine);
  s.sharp.add({.direction = safelyMirrored(at, s.normal, s.cosine),
               .coefficient = Coefficient(material.reflectance * at.pattern),
               .lengthCounts = at.flat && !bends,
               .imagesLamps = at.flat});
  return s;
}

Coefficient directCoefficient(const Scattering& s, const Interaction& at, const V3d& toSource,
                              double solidAngle, double sourceJitter) {
  const double cosine = s.normal.dot(toSource);
  const double enters = s.diffuseFresnel > 0 ? 1 - fresnelRise(std::abs(cosine)) : 1;
  if (cosine > kNegligible)
    return reflectedCoefficient(s, at, toSource, cosine, enters, solidAngle, sourceJitter);
  if (cosine < -kNegligible) return transmittedCoefficient(s, toSource, cosine, enters, solidAngle);
  return {};
}

double sampleReflection(const Scattering& s, const Interaction& at, double spread, double u1, double u2,
                        V3d& direction) {
  const auto [x, y] = frame(s.normal);
  const double radius = lobeRadius(s.alpha2, spread, u2), angle = 2 * kPi * u1;
  const V3d half = s.normal + radius * (std::cos(angle) * x + std::sin(angle) * y);
  // The mirror image of a unit vector has unit length.
  direction = at.direction - 2 * half.dot(at.direction) / (1 + radius * radius) * half;
  const double out = direction.dot(s.normal);
  if (out <= kNegligible || direction.dot(at.normal) <= kNegligible) return 0;
  return 2 / (1 + s.cosine / out);
}

double reflectedDensity(const Scattering& s, const Interaction& at, const V3d& direction) {
  const double cosine = s.normal.dot(direction);
  if (!(s.alpha2 > 0) || cosine <= kNegligible || direction.dot(at.normal) <= kNegligible) return 0;
  const double density = reflectedLobe(s, at, direction, s.alpha2);
  return density > kNegligible ? density * cosine : 0;
}

double sampleTransmission(const Scattering& s, const Interaction& at, double spread, double u1, double u2,
                          V3d& direction) {
  const auto [x, y] = frame(s.normal);
  const double radius = lobeRadius(s.alpha2, spread, u2), angle = 2 * kPi * u1;
  direction = s.transmitted + radius * (std::cos(angle) * x + std::sin(angle) * y);
  if (direction.dot(at.normal) >= -kNegligible) return 0;
  direction.normalize();
  return 1;
}

}  // namespace rsphere
