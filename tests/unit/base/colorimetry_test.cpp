#include "base/colorimetry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/cie_tables.h"
#include "base/primaries.h"

namespace rsphere {
namespace {

// The relative spectral power of CIE standard illuminant D65 from 300 nm on, in steps of 5 nm (CIE 15:2018).
constexpr std::array<double, 97> kD65 = {
    .0341,   1.6643,  3.2945,  11.7652, 20.236,  28.6447, 37.0535, 38.5011, 39.9488, 42.4302, 44.9117,
    45.775,  46.6383, 49.3637, 52.0891, 51.0323, 49.9755, 52.3118, 54.6482, 68.7015, 82.7549, 87.1204,
    91.486,  92.4589, 93.4318, 90.057,  86.6823, 95.7736, 104.865, 110.936, 117.008, 117.41,  117.812,
    116.336, 114.861, 115.392, 115.923, 112.367, 108.811, 109.082, 109.354, 108.578, 107.802, 106.296,
    104.79,  106.239, 107.689, 106.047, 104.405, 104.225, 104.046, 102.023, 100,     98.1671, 96.3342,
    96.0611, 95.788,  92.2368, 88.6856, 89.3459, 90.0062, 89.8026, 89.5991, 88.6489, 87.6987, 85.4936,
    83.2886, 83.4939, 83.6992, 81.863,  80.0268, 80.1207, 80.2146, 81.2462, 82.2778, 80.281,  78.2842,
    74.0027, 69.7213, 70.6652, 71.6091, 72.979,  74.349,  67.9765, 61.604,  65.7448, 69.8856, 72.4863,
    75.087,  69.3398, 63.5927, 55.0054, 46.4182, 56.6118, 66.8054, 65.0941, 63.3828};

// Spectra of bins of equal width around the wavelengths of a table.
Spectrum around(std::span<const double> values, double first, double step) {
  return {values, first - step / 2, first + (static_cast<double>(values.size()) - .5) * step};
}

double sum(const CieCurve& curve) {
  double total = 0;
  for (const double value : curve.values) total += value;
  return total;
}

// One in a single bin from a wavelength on, as wide as given (nm).
double inBin(double (*integral)(const Spectrum&), double from, double width) {
  const std::array<double, 1> one{1};
  return integral({one, from, from + width});
}

TEST(CieTables, PeaksAreWhereTheCieHasThem) {
  const auto at = [](const CieCurve& c, int nm) { return c.values[static_cast<size_t>(nm - c.shortest)]; };
  EXPECT_EQ(at(colorMatchingX(), 600), 1.0622);
  EXPECT_EQ(at(colorMatchingY(), 555), 1);
  EXPECT_EQ(at(colorMatchingZ(), 445), 1.78260);
  EXPECT_EQ(at(colorMatchingX(), 830), 1.251141e-6);
  EXPECT_EQ(at(scotopicEfficiency(), 507), 1);
  EXPECT_EQ(at(melanopicSensitivity(), 490), 1);
  for (const CieCurve& c : {colorMatchingX(), colorMatchingY(), colorMatchingZ()}) {
    EXPECT_EQ(c.shortest, 360);
    EXPECT_EQ(c.longest(), 830);
    EXPECT_NEAR(sum(c), 106.87, .03) << "the three have equal areas";
  }
  for (const CieCurve& c : {scotopicEfficiency(), melanopicSensitivity()}) {
    EXPECT_EQ(c.shortest, 380);
    EXPECT_EQ(c.longest(), 780);
  }
  for (const auto& [c, peak] : {std::pair(sConeSensitivity(), 445), std::pair(mConeSensitivity(), 540),
                                std::pair(lConeSensitivity(), 570)}) {
    EXPECT_EQ(c.shortest, 390);
    const auto highest = std::max_element(c.values.begin(), c.values.end());
    EXPECT_EQ(c.shortest + 5 * (highest - c.values.begin()), peak);
    EXPECT_NEAR(*highest, 1, .01);
  }
  EXPECT_EQ(sConeSensitivity().longest(), 615);
  EXPECT_EQ(lConeSensitivity().longest(), 780);
}

TEST(Colorimetry, EqualEnergyIsWhite) {
  const std::array<double, 7> flat{1, 1, 1, 1, 1, 1, 1};
  for (const auto& [first, last] : {std::pair(300., 900.), std::pair(900., 300.)}) {
    const Spectrum white{flat, first, last};
    const V3d xyz = tristimulus(white);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(xyz[i], 1, 1e-14);
    EXPECT_NEAR(scotopic(white), 1, 1e-14);
    EXPECT_NEAR(melanopic(white), 1, 1e-14);
    for (int i = 0; i < 5; ++i) EXPECT_NEAR(seenBy(static_cast<Receptor>(i), white), 1, 1e-14);
    const V3d rgb = standardRgb(xyz);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(rgb[i], 1, 1e-13);
  }
  // Within the usual limits the violet end of Z is missing.
  const V3d usual = tristimulus({flat, 780, 380});
  EXPECT_NEAR(usual.x, 1, 2e-4);
  EXPECT_NEAR(usual.y, 1, 1e-5);
  EXPECT_NEAR(usual.z, 1, 6e-4);
}

// The integral over 1 nm is the mean of the two values at its ends.
TEST(Colorimetry, MonochromaticBandsAreThePublishedTable) {
  const std::pair<double (*)(const Spectrum&), CieCurve> curves[] = {
      {[](const Spectrum& s) { return tristimulus(s).x; }, colorMatchingX()},
      {[](const Spectrum& s) { return tristimulus(s).y; }, colorMatchingY()},
      {[](const Spectrum& s) { return tristimulus(s).z; }, colorMatchingZ()},
      {scotopic, scotopicEfficiency()},
      {melanopic, melanopicSensitivity()}};
  for (const auto& [integral, curve] : curves) {
    const double area = sum(curve) - (curve.values.front() + curve.values.back()) / 2;
    for (const int nm : {380, 444, 490, 507, 555, 599, 650, 779}) {
      const auto i = static_cast<size_t>(nm - curve.shortest);
      const double expected = (curve.values[i] + curve.values[i + 1]) / 2;
      EXPECT_NEAR(inBin(integral, nm, 1) * area, expected, 1e-13) << nm;
      EXPECT_NEAR(inBin(integral, nm + .2, .25) * area, .25 * expected, 1e-12) << nm;
      EXPECT_NEAR(inBin(integral, nm + 1, -1) * area, expected, 1e-13) << nm;
    }
    EXPECT_EQ(inBin(integral, 100, 200), 0);
    EXPECT_EQ(inBin(integral, 831, 60), 0);
  }
}

TEST(Colorimetry, DaylightHasItsPublishedValues) {
  const Spectrum d65 = around(kD65, 300, 5);
  const V3d xyz = tristimulus(d65);
  EXPECT_NEAR(xyz.x / (xyz.x + xyz.y + xyz.z), .3127, 1e-4);
  EXPECT_NEAR(xyz.y / (xyz.x + xyz.y + xyz.z), .3290, 1e-4);
  // The sum of the products of both tables at steps of 5 nm.
  double luminance = 0;
  for (size_t i = 0; i < kD65.size(); ++i) {
    const int nm = 300 + 5 * static_cast<int>(i) - colorMatchingY().shortest;
    if (nm >= 0) luminance += 5 * kD65[i] * colorMatchingY().values[static_cast<size_t>(nm)];
  }
  EXPECT_NEAR(tristimulus(d65).y * sum(colorMatchingY()), luminance, 1e-4 * luminance);
  // CIE S 026: the melanopic efficacy of luminous radiation of D65 is 1.3262 mW/lm.
  constexpr double kLumensPerWatt = 683.002;
  const double efficacy = melanopic(d65) * sum(melanopicSensitivity()) /
                          (kLumensPerWatt * tristimulus(d65).y * sum(colorMatchingY()));
  EXPECT_NEAR(efficacy * 1000, 1.3262, 2e-4);
}

// CIE S 026: melanopic daylight efficacy ratios of illuminant A and of equal energy. CIE 15 gives the former
// as the radiation of a black body with c2 = .014350 m K.
TEST(Colorimetry, MelanopicRatiosOfOtherIlluminants) {
  std::vector<double> tungsten;
  for (int nm = 380; nm <= 780; ++nm)
    tungsten.push_back(std::pow(560. / nm, 5) * std::expm1(1.435e7 / (2848 * 560)) /
                       std::expm1(1.435e7 / (2848. * nm)));
  const Spectrum a = around(tungsten, 380, 1), d65 = around(kD65, 300, 5);
  const double daylight = melanopic(d65) / tristimulus(d65).y;
  EXPECT_NEAR(melanopic(a) / tristimulus(a).y / daylight, .496, 5e-4);
  EXPECT_NEAR(1 / daylight, .906, 5e-4);
}

TEST(Colorimetry, BandsHaveTheMeansOfTheSpectrum) {
  const SpectralSampling& sampling = spectralSampling(7, 380, 780);
  const double width = sampling.width();
  // Linear in the wavelength, in narrow bins.
  constexpr size_t kBins = 4000;
  std::vector<double> ramp(kBins);
  for (size_t i = 0; i < kBins; ++i) ramp[i] = 300 + (static_cast<double>(i) + .5) * 600 / kBins;
  const Bands rising = bandsOf({ramp, 300, 900}, sampling);
  for (size_t i = 0; i < sampling.count(); ++i)
    EXPECT_NEAR(rising.values()[i], 780 - (static_cast<double>(i) + .5) * width, 1e-4) << i;
  std::ranges::reverse(ramp);
  const Bands falling = bandsOf({ramp, 900, 300}, sampling);
  for (size_t i = 0; i < sampling.count(); ++i) EXPECT_NEAR(falling.values()[i], rising.values()[i], 1e-9);
}

TEST(Colorimetry, BandsKeepTheWholeOfTheSpectrum) {
  const std::array<double, 5> values{.3, 2, .1, .7, 1.9};
  for (const auto& [first, last] : {std::pair(410., 523.), std::pair(700., 381.), std::pair(380., 780.)})
    for (const int count : {3, 4, 5, 11, 24}) {
      const Bands bands = bandsOf({values, first, last}, spectralSampling(count, 380, 780));
      double total = 0;
      for (const double value : bands.values()) total += value * 400 / count;
      EXPECT_NEAR(total, std::abs(last - first), 1e-10) << first << ' ' << count;
    }
}

TEST(Colorimetry, BandsAreBlackBeyondTheEnds) {
  const std::array<double, 2> values{1, 3};
  const Bands bands = bandsOf({values, 450, 550}, spectralSampling(8, 380, 780));  // of 50 nm
  const std::array<double, 8> expected{0, 0, 0, 0, 1.2, 2.2, .6, 0};
  for (size_t i = 0; i < 8; ++i) EXPECT_NEAR(bands.values()[i], expected[i], 1e-12) << i;
  for (const auto& [first, last] : {std::pair(800., 1200.), std::pair(100., 379.)}) {
    const Bands beyond = bandsOf({values, first, last}, spectralSampling(8, 380, 780));
    for (const double value : beyond.values()) EXPECT_EQ(value, 0);
  }
}

TEST(Colorimetry, SpectraOfBandsAreTheirOwnBands) {
  const SpectralSampling& sampling = spectralSampling(20, 400, 700);
  Bands bands(sampling);
  for (size_t i = 0; i < 20; ++i) bands.values()[i] = std::sin(static_cast<double>(i));
  const Bands same = bandsOf(spectrumOf(bands), sampling);
  for (size_t i = 0; i < 20; ++i) EXPECT_NEAR(same.values()[i], bands.values()[i], 1e-12);
}

TEST(Colorimetry, RedGreenAndBlueReturn) {
  const M33d toXyz = xyzFromRgb(kStandardPrimaries);
  for (const V3d& rgb : {V3d(1, 1, 1), V3d(1, 0, 0), V3d(0, 1, 0), V3d(0, 0, 1), V3d(.2, .9, .4)}) {
    const V3d xyz = rgb * toXyz, back = standardRgb(xyz);
    EXPECT_NEAR(xyz.y, kRedWeight * rgb.x + kGreenWeight * rgb.y + kBlueWeight * rgb.z, 1e-8);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(back[i], rgb[i], 1e-14);
  }
}

TEST(Colorimetry, ColorsOutsideTheGamutKeepTheirLuminance) {
  for (const int nm : {400, 450, 500, 550, 600, 650}) {
    const std::array<double, 1> one{1};
    const V3d xyz = tristimulus({one, nm - 5., nm + 5.}), rgb = standardRgb(xyz);
    EXPECT_NEAR(std::min({rgb.x, rgb.y, rgb.z}), 0, 1e-15) << nm;
    EXPECT_NEAR(brightness(Color(rgb)), xyz.y, 1e-8) << nm;
  }
  EXPECT_EQ(standardRgb(V3d(1, -.1, 1)), V3d(0, 0, 0));
}

// Two spectra of five bands whose difference has no X, Y, Z: the color is the same, the bands are not.
TEST(Colorimetry, MetamersHaveOneColor) {
  const auto xyzOf = [](const std::array<double, 5>& v) { return tristimulus({v, 700, 400}); };
  // Solves for three of the bands such that the change of the other two is compensated.
  M33d rows;
  for (size_t i = 0; i < 3; ++i) {
    std::array<double, 5> unit{};
    unit[2 * i] = 1;
    const V3d xyz = xyzOf(unit);
    for (int column = 0; column < 3; ++column) rows[static_cast<int>(i)][column] = xyz[column];
  }
  const V3d change = xyzOf({0, .01, 0, -.02, 0}) * rows.inverse();
  const std::array<double, 5> a{.5, .5, .5, .5, .5};
  const std::array<double, 5> b{.5 - change.x, .51, .5 - change.y, .48, .5 - change.z};
  const V3d one = standardRgb(xyzOf(a)), other = standardRgb(xyzOf(b));
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(one[i], other[i], 1e-13);
  EXPECT_GT(std::abs(a[2] - b[2]), 1e-3);
}

}  // namespace
}  // namespace rsphere
