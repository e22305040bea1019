#pragma once
// The CIE's observers: weighted integrals of spectra.
//
// A spectrum is given by bins of equal width between `first` and `last` (nm), which may be in either order.
// Each value is the mean of a bin; the first value is that of the bin at `first`. It is 0 outside.
//
// All integrals are normalized to 1 for a spectrum that is 1 at all wavelengths. Source: CIE 15 (X, Y, Z of
// 1931, V'(lambda)), CIE S 026 (melanopic, cones).
#include <Imath/ImathVec.h>

#include <cstdint>
#include <span>

namespace rsphere {

using Imath::V3d;

struct Spectrum {
  std::span<const double> values;
  double first = 780, last = 380;  // nm
};

// X, Y (the photopic integral), Z; scotopic and melanopic integrals.
V3d tristimulus(const Spectrum& spectrum);
double scotopic(const Spectrum& spectrum);
double melanopic(const Spectrum& spectrum);

// The receptors of the eye, in the order of CIE S 026; the action spectrum of rods is V'(lambda).
enum class Receptor : uint8_t { sCone, mCone, lCone, rod, melanopsin };
double seenBy(Receptor receptor, const Spectrum& spectrum);

// X, Y, Z as RADIANCE 6.1 computes them, with the limits of the bins rounded down to whole nanometers: see
// BandWeights (spectral_sampling.h).
V3d tristimulusInRadiance(const Spectrum& spectrum);

}  // namespace rsphere
