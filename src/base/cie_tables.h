#pragma once
// Spectral curves of the CIE.
#include <span>

namespace rsphere {

struct CieCurve {
  std::span<const double> values;
  int shortest = 0;  // nm, of the first value
  int step = 1;      // nm

  // nm, of the last value.
  int longest() const { return shortest + step * (static_cast<int>(values.size()) - 1); }
};

// The color matching functions of the observer of 1931 (2 degrees). The second is V(lambda). Source: CIE
// dataset 10.25039/CIE.DS.xvudnb9b, with 7 digits.
CieCurve colorMatchingX();
CieCurve colorMatchingY();
CieCurve colorMatchingZ();

// V'(lambda), CIE 1951.
CieCurve scotopicEfficiency();

// The melanopic action spectrum. Source: CIE S 026:2018, table 2.
CieCurve melanopicSensitivity();

// The action spectra of the cones, from the same table, each 5 nm, and linear in between: integrals over
// bands of 20 nm differ by at most .3% of that over the brightest band.
CieCurve sConeSensitivity();
CieCurve mConeSensitivity();
CieCurve lConeSensitivity();

}  // namespace rsphere
