#include "shade/surface_scattering.h"

namespace rsphere {
namespace {

static_assert(ScattersLight<RoundScattering> && ScattersLight<EllipticScattering> &&
              ScattersLight<AshikhminLobeScattering> && ScattersLight<ProgrammedScattering>);

// Cap on the draws for a sample of ashik2 above the surface; as in RADIANCE.
constexpr int kMostTries = 10;
// -ss below 1 does not narrow the lobe of ashik2. The original draws one sample per ray, evenly distributed
// over successive rays. Here samples of a ray are independent of other rays, and four of them have the same
// noise.
constexpr int kAshikhminSamples = 4;

// A sample of a lobe, stratified in the first random number. sample: a function like sampleReflection().
template <class Sample>
LobeSample drawStratified(const Color& share, int i, int n, Random& random, const Sample& sample) {
  LobeSample drawn;
  const double u1 = (i + random.uniform()) / n, u2 = random.uniform();
  const double weight = sample(u1, u2, drawn.direction);
  if (weight > 0) drawn.coefficient = Coefficient(share * (weight / n));
  return drawn;
}

}  // namespace

// ---- round lobes

LobeSample RoundScattering::draw(Component component, int i, int n, Random& random) const {
  const Scattering& s = scattering_;
  if (component == Component::reflected)
    return drawStratified(s.specularReflection, i, n, random, [&](double u1, double u2, V3d& d) {
      return sampleReflection(s, at_, spread_.lobe, u1, u2, d);
    });
  return drawStratified(s.specularTransmission, i, n, random, [&](double u1, double u2, V3d& d) {
    return sampleTransmission(s, at_, spread_.lobe, u1, u2, d);
  });
}

// Compares the peak of a lobe at normal incidence, share / (4 pi alpha^2), with the diffuse part, share / pi.
bool RoundScattering::isEven() const {
  constexpr double kMost = 4;
  const Scattering& s = scattering_;
  return maxChannel(s.specularReflection + s.specularTransmission) <=
         kMost * 4 * s.alpha2 * maxChannel(s.diffuseReflection + s.diffuseTransmission);
}

// ---- elliptic lobes

LobeSample EllipticScattering::draw(Component component, int i, int n, Random& random) const {
  if (component == Component::reflected)
    return drawStratified(scattering_.reflected.share, i, n, random, [&](double u1, double u2, V3d& d) {
      return sampleReflection(scattering_.reflected, at_, spread_.lobe, u1, u2, d);
    });
  return drawStratified(scattering_.transmitted.share, i, n, random, [&](double u1, double u2, V3d& d) {
    return sampleTransmission(scattering_.transmitted, at_, spread_.lobe, u1, u2, d);
  });
}

// ---- ashik2

std::optional<Lobe> AshikhminLobeScattering::lobe(Component component, Random&) const {
  if (component == Component::transmitted || !scattering_.sampled) return {};
  return Lobe{.leastSamples = kAshikhminSamples};
}

LobeSample AshikhminLobeScattering::draw(Component, int i, int n, Random& random) const {
  return drawStratified(scattering_.share, i, n, random, [&](double u1, double u2, V3d& d) {
    for (int tries = 0; tries < kMostTries; ++tries) {
      if (sampleReflection(scattering_, at_, u1, u2, d)) return 1;
      u1 = random.uniform();
      u2 = random.uniform();
    }
    return 0;
  });
}

// ---- functions

bool ProgrammedScattering::takesDirect(Component component) const {
  const FunctionScattering& s = scattering_;
  return component == Component::transmitted &&
         (!isBlack(s.diffuseReflection) || !isBlack(s.diffuseTransmission) ||
          !isBlack(s.directionalReflection) || !isBlack(s.directionalTransmission));
}

}  // namespace rsphere
