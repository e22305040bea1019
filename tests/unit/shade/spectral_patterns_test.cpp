// spectrum, specfile, specfunc, specdata and specpict, in runs of three channels and of bands.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "base/colorimetry.h"
#include "shade/surface_functions.h"
#include "tests/unit/support/scene_of.h"

namespace rsphere::spectral_patterns_test {
namespace {

// A file that exists as long as the object.
class File {
 public:
  explicit File(const std::string& bytes, const std::string& name = "data")
      : path_(testing::TempDir() + fmt::format("spectral{}.{}", getpid(), name)) {
    std::ofstream(path_, std::ios::binary) << bytes;
  }
  ~File() { std::remove(path_.c_str()); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

// The pattern P of a scene, without and with bands.
class Evaluated {
 public:
  Evaluated(const std::string& pattern, const SpectralSampling* sampling, const WavelengthLimits& limits = {})
      : scene_(sceneOf(pattern + "\nP glow M 0 0 4 1 1 1 0\nM sphere s 0 0 4 0 0 0 1\n")),
        functions_(
            scene_, sampling, [this](std::string_view line) { warnings_.emplace_back(line); }, {}, limits) {}

  Color at(const V3d& point) {
    for (const ModifierId id : scene_.modifiers.ids())
      if (std::holds_alternative<Pattern>(scene_.modifiers[id].content))
        return functions_.pattern(id, {.point = point}, scratch_);
    return Color(-1);
  }
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  Scene scene_;
  std::vector<std::string> warnings_;
  SurfaceFunctions functions_;
  FunctionScratch scratch_;
};

Color inChannels(const std::string& pattern, const V3d& point = V3d(0, 0, 0)) {
  return Evaluated(pattern, nullptr).at(point);
}
Bands inBands(const std::string& pattern, const SpectralSampling& sampling, const V3d& point = V3d(0, 0, 0)) {
  const Color color = Evaluated(pattern, &sampling).at(point);
  EXPECT_TRUE(color.bands());
  return color.bandsIn(sampling);
}

// RADIANCE's conversion to red, green and blue: resampled from 780 to 380 nm into this many bins, and seen as
// bands of a spectral run are.
V3d rgbOf(const Spectrum& spectrum, int bins) {
  const SpectralSampling& sampling = spectralSampling(bins, 380, 780);
  return standardRgb(bandWeights(sampling).tristimulus(bandsOf(spectrum, sampling).values()));
}
V3d rgbOfFalling(const Spectrum& s) {
  const SpectralSampling& sampling = spectralSampling(static_cast<int>(s.values.size()), s.last, s.first);
  return standardRgb(bandWeights(sampling).tristimulus(bandsOf(s, sampling).values()));
}
void expectColor(const Color& got, const V3d& rgb, double tolerance = 1e-12) {
  EXPECT_FALSE(got.bands());
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(got[i], rgb[i], tolerance) << i;
}
void expectBands(const Bands& got, const Bands& expected, double tolerance = 1e-12) {
  for (size_t i = 0; i < expected.values().size(); ++i)
    EXPECT_NEAR(got.values()[i], expected.values()[i], tolerance) << i;
}

std::string errorOf(const std::string& pattern) {
  try {
    Evaluated(pattern, nullptr).at(V3d(0, 0, 0));
  } catch (const rad::Error& e) {
    return e.what();
  }
  return "no error";
}

// The mean of a function of the wavelength in each band, by many steps.
template <class F>
Bands meansOf(const F& f, const SpectralSampling& sampling, double shortest, double longest) {
  Bands means(sampling);
  for (size_t i = 0; i < sampling.count(); ++i) {
    constexpr int kSteps = 2000;
    for (int k = 0; k < kSteps; ++k) {
      const double nm = sampling.longest - (static_cast<double>(i) + (k + .5) / kSteps) * sampling.width();
      if (nm > shortest && nm < longest) means.values()[i] += f(nm) / kSteps;
    }
  }
  return means;
}

const SpectralSampling& twenty() { return spectralSampling(20, 380, 780); }

TEST(SpectralPattern, UnusedOnesAreNotRead) {
  EXPECT_NO_THROW(
      sceneOf("void spectrum A 0 0 0\nvoid specfile B 0 0 0\nvoid specfunc C 0 0 0\n"
              "void specdata D 0 0 0\nvoid specpict E 0 0 0\n"
              "void plastic M 0 0 5 1 1 1 0 0\nM sphere s 0 0 4 0 0 0 1\n"));
}

// ---- spectrum

constexpr std::array<double, 5> kFive{.2, .9, .4, .7, .1};

TEST(SpectrumPattern, BinsLieAroundTheirWavelengths) {
  const std::string rising = "void spectrum P 0 0 7 420 580 .2 .9 .4 .7 .1";
  const Spectrum bins{kFive, 400, 600};
  expectColor(inChannels(rising), rgbOf(bins, 10));
  expectBands(inBands(rising, twenty()), bandsOf(bins, twenty()));
  const std::string falling = "void spectrum P 0 0 7 580 420 .1 .7 .4 .9 .2";
  const std::array<double, 5> reversed{.1, .7, .4, .9, .2};
  expectColor(inChannels(falling), rgbOfFalling({reversed, 600, 400}));
  expectBands(inBands(falling, twenty()), bandsOf(bins, twenty()));
}

TEST(SpectrumPattern, BandsOfTheSameWidthAreTheValues) {
  const Bands bands = inBands("void spectrum P 0 0 7 740 420 .2 .9 .4 .7 .1", spectralSampling(5, 380, 780));
  for (size_t i = 0; i < 5; ++i) EXPECT_NEAR(bands.values()[i], kFive[i], 1e-15);
}

TEST(SpectrumPattern, ThreeValuesAreRedGreenAndBlue) {
  EXPECT_EQ(inChannels("void spectrum P 0 0 5 700 400 .2 .9 .4"), Color(.2, .9, .4));
  // Means from 780 to 380 nm, in thirds, of what is 0 beyond 325 and 775 nm.
  const Color rising = inChannels("void spectrum P 0 0 5 400 700 .2 .9 .4");
  const Bands thirds = bandsOf({std::array{.2, .9, .4}, 325, 775}, spectralSampling(3, 380, 780));
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(rising[i], thirds.values()[static_cast<size_t>(i)], 1e-14);
}

// rtrace -h -ab 0 of RADIANCE 6.1a for a glow of each, the second as the mean of 400 rays.
TEST(SpectrumPattern, HasTheColorsOfTheOriginal) {
  const File file("rb(nm) = .5 + .4*sin(nm/42.7652)*cos(Px);\n", "cal");
  const std::pair<std::string, Color> patterns[] = {
      {"void spectrum P 0 0 10 380 780 .736766 .341199 .860662 .989178 .611875 .699922 .912552 .716956",
       Color(.6862831, .8980649, .5558739)},
      {"void specfunc P 2 rb " + file.path() + " 0 2 400 720", Color(.9098, .6225, .0910)}};
  for (const auto& [pattern, color] : patterns)
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(inChannels(pattern)[i], color[i], .007) << pattern;
}

// rtrace -cs 3 -cw 650 450 of RADIANCE 6.1a.
TEST(SpectrumPattern, LimitsHoldInThreeChannels) {
  std::string forty = "void spectrum P 0 0 42 380 780";
  for (int i = 0; i < 40; ++i) forty += " 1";
  Evaluated limited(forty, nullptr, {450, 650});
  const Color c = limited.at(V3d(0, 0, 0));
  EXPECT_NEAR(c.x, .8633, .005);
  EXPECT_NEAR(c.y, 1.0792, .005);
  EXPECT_NEAR(c.z, .4179, .005);
}

TEST(SpectrumPattern, NeedsValuesAndARange) {
  EXPECT_EQ(errorOf("void spectrum P 0 0 4 380 780 1 1"),
            "room.rad:1: spectrum \"P\": expected at least 5 real arguments, got 4");
  EXPECT_EQ(errorOf("void spectrum P 0 0 5 500 500 1 1 1"),
            "room.rad:1: spectrum \"P\": the wavelengths of the first and the last value must differ");
}

// ---- specfile

TEST(SpecfilePattern, EvenDataAreASpectrum) {
  const File file("1\n420 580 5\n.2 .9 .4 .7 .1\n");
  const std::string pattern = "void specfile P 1 " + file.path() + " 0 0";
  const Spectrum bins{kFive, 400, 600};
  expectColor(inChannels(pattern), rgbOf(bins, 10), 1e-6);
  expectBands(inBands(pattern, twenty()), bandsOf(bins, twenty()), 1e-7);
}

// The means in bands of a curve that is linear between its points, which need not be evenly spaced. rtrace
// evaluates it at evenly spaced wavelengths and misses the line.
TEST(SpecfilePattern, UnevenDataHaveTheirMeans) {
  const std::vector<std::pair<double, double>> curve{{380, .1}, {420, .3}, {500, .8},
                                                     {560, .2}, {650, .9}, {780, .4}};
  const std::vector<std::pair<double, double>> line{{450, .1}, {545, .1}, {546, 20}, {547, .1}, {700, .1}};
  for (auto points : {curve, line}) {
    const auto f = [sorted = points](double nm) {
      size_t i = 1;
      while (i + 1 < sorted.size() && sorted[i].first < nm) ++i;
      const auto [a, va] = sorted[i - 1];
      const auto [b, vb] = sorted[i];
      return va + (vb - va) * (nm - a) / (b - a);
    };
    for (const bool falling : {false, true}) {
      if (falling) std::ranges::reverse(points);
      std::string wavelengths, values;
      for (const auto& [nm, value] : points) {
        wavelengths += fmt::format(" {}", nm);
        values += fmt::format(" {}", value);
      }
      const File file(fmt::format("1\n0 0 {}\n{}\n{}\n", points.size(), wavelengths, values));
      const std::string pattern = "void specfile P 1 " + file.path() + " 0 0";
      const double shortest = std::min(points.front().first, points.back().first),
                   longest = std::max(points.front().first, points.back().first);
      for (const int bands : {8, 20, 24}) {
        const SpectralSampling& sampling = spectralSampling(bands, 380, 780);
        expectBands(inBands(pattern, sampling), meansOf(f, sampling, shortest, longest), 2e-4);
      }
      const SpectralSampling& most = spectralSampling(24, 380, 780);
      const Bands means = meansOf(f, most, shortest, longest);
      expectColor(inChannels(pattern), standardRgb(bandWeights(most).tristimulus(means.values())), 2e-4);
    }
  }
}

TEST(SpecfilePattern, NeedsOneDimension) {
  const File file("2\n0 1 2\n400 700 2\n1 1 1 1\n");
  EXPECT_EQ(errorOf("void specfile P 1 " + file.path() + " 0 0"),
            "room.rad:1: specfile \"P\": expected data of 1 dimension, the wavelength, got 2");
  EXPECT_EQ(errorOf("void specfile P 0 0 0"),
            "room.rad:1: specfile \"P\": expected at least 1 string arguments, got 0");
  EXPECT_EQ(errorOf("void specfile P 2 a b 0 0"),
            "room.rad:1: specfile \"P\": expected at most 1 string arguments, got 2");
  EXPECT_EQ(errorOf("void specfile P 1 none.dat 0 0"),
            "room.rad:1: specfile \"P\": cannot find data file \"none.dat\"" +
                rad::FileAccess().remark("none.dat", true));
  EXPECT_EQ(errorOf("void specfile P 1 /tmp 0 0"),
            "room.rad:1: specfile \"P\": \"/tmp\" is a folder, expected a data file");
}

TEST(SpecfilePattern, SaysWhatIsWrongWithTheData) {
  const File few("1\n400 700 5\n1 2 3\n"), equal("1\n700 700 3\n1 2 3\n", "equal");
  EXPECT_EQ(errorOf("void specfile P 1 " + few.path() + " 0 0"),
            "room.rad:1: specfile \"P\": " + few.path() + ":4: expected a value, got the end of the file");
  EXPECT_EQ(
      errorOf("void specfile P 1 " + equal.path() + " 0 0"),
      "room.rad:1: specfile \"P\": " + equal.path() +
          ":3: fewer values in the file than its grid has points: the limits of an axis are equal, so that "
          "its divisions come first");
}

// ---- specfunc

TEST(SpecfuncPattern, IsAFunctionOfPlaceAndWavelength) {
  const File file("f(nm) = A3*nm/1000 + Px;\n", "cal");
  const std::string pattern = "void specfunc P 2 f " + file.path() + " 0 3 780 380 2";
  const auto f = [](double nm) { return 2 * nm / 1000 + .25; };
  for (const int bands : {4, 6, 8, 12, 24}) {  // whose edges are those of the bins
    const SpectralSampling& sampling = spectralSampling(bands, 380, 780);
    expectBands(inBands(pattern, sampling, V3d(.25, 0, 0)), meansOf(f, sampling, 380, 780), 1e-9);
  }
  std::array<double, 12> steps{};
  for (size_t i = 0; i < steps.size(); ++i) steps[i] = f(780 - (static_cast<double>(i) + .5) * 400 / 12);
  expectColor(inChannels(pattern, V3d(.25, 0, 0)), rgbOfFalling({steps, 780, 380}), 1e-9);
}

TEST(SpecfuncPattern, IsBlackBeyondItsLimits) {
  const File file("f(nm) = 1;\n", "cal");
  const SpectralSampling& sampling = spectralSampling(8, 380, 780);
  for (const char* limits : {"430 580", "580 430"}) {
    const Bands bands = inBands(fmt::format("void specfunc P 2 f {} 0 2 {}", file.path(), limits), sampling);
    const std::array<double, 8> expected{0, 0, 0, 0, 1, 1, 1, 0};
    for (size_t i = 0; i < 8; ++i) EXPECT_NEAR(bands.values()[i], expected[i], 1e-12) << i;
  }
  // The function is not evaluated where it is not needed.
  const File root("f(nm) = sqrt(nm - 500);\n", "cal");
  const SpectralSampling& reds = spectralSampling(4, 500, 700);
  const auto square = [](double nm) { return std::sqrt(nm - 500); };
  expectBands(inBands("void specfunc P 2 f " + root.path() + " 0 2 500 780", reds),
              meansOf(square, reds, 500, 780), .05);
}

TEST(SpecfuncPattern, SmoothFunctionsHaveTheirMeans) {
  const File file("f(nm) = .5 + .4*sin(nm/42.7652)*cos(Px);\n", "cal");
  const std::string pattern = "void specfunc P 2 f " + file.path() + " 0 2 380 780";
  const auto f = [](double nm) { return .5 + .4 * std::sin(nm / 42.7652) * std::cos(.7); };
  const SpectralSampling& sampling = spectralSampling(6, 380, 780);
  expectBands(inBands(pattern, sampling, V3d(.7, 0, 0)), meansOf(f, sampling, 380, 780), 1e-3);
}

TEST(SpecfuncPattern, AWrongRangeIsIgnoredWithAWarning) {
  const File file("f(nm) = 1;\n", "cal");
  Evaluated pattern("void specfunc P 2 f " + file.path() + " 0 2 800 900", &twenty());
  for (int i = 0; i < 2; ++i) EXPECT_EQ(pattern.at(V3d(0, 0, 0)), Color(1, 1, 1));
  ASSERT_EQ(pattern.warnings().size(), 1u);
  EXPECT_EQ(pattern.warnings()[0],
            "room.rad:1: specfunc \"P\": its wavelengths are outside the limits of the spectrum (-cw): it is "
            "ignored");
}

TEST(SpecfuncPattern, WhatHasNoValueIsIgnoredWithAWarning) {
  const File file("f(nm) = 1/(Px*nm);\n", "cal");
  Evaluated pattern("void specfunc P 2 f " + file.path() + " 0 2 400 700", &twenty());
  EXPECT_EQ(pattern.at(V3d(0, 0, 0)), Color(1, 1, 1));
  EXPECT_TRUE(pattern.at(V3d(1, 0, 0)).bands());
  ASSERT_EQ(pattern.warnings().size(), 1u);
  EXPECT_EQ(pattern.warnings()[0],
            "room.rad:1: specfunc \"P\": compute error: division by zero: ignored at such points; the "
            "function can exclude them with if()");
}

TEST(SpecfuncPattern, NeedsItsArguments) {
  EXPECT_EQ(errorOf("void specfunc P 1 f 0 2 400 700"),
            "room.rad:1: specfunc \"P\": expected at least 2 string arguments, got 1");
  EXPECT_EQ(errorOf("void specfunc P 2 f . 0 1 400"),
            "room.rad:1: specfunc \"P\": expected at least 2 real arguments, got 1");
  EXPECT_EQ(errorOf("void specfunc P 2 f . 0 2 400 400"),
            "room.rad:1: specfunc \"P\": the limits of the wavelength must differ");
}

TEST(SpecfuncPattern, SaysWhoLacksARealArgument) {
  const File file("f(nm) = arg(3)*nm;\n", "cal");
  const std::string use = "void specfunc P 2 f " + file.path();
  EXPECT_EQ(errorOf(use + " 0 2 400 700"),
            "room.rad:1: specfunc \"P\": " + file.path() + ":1: missing real argument 3");
  EXPECT_EQ(errorOf(use + " 0 3 400 700 1"), "no error");
}

TEST(SpecfuncPattern, MovesWithItsTransform) {
  const File file("f(nm) = Px;\n", "cal");
  const std::string pattern = "void specfunc P 5 f " + file.path() + " -t 2 0 0 2 380 780";
  EXPECT_EQ(errorOf(pattern), "room.rad:1: specfunc \"P\": bad transform");
  const Bands bands =
      inBands("void specfunc P 6 f " + file.path() + " -t 2 0 0 0 2 380 780", twenty(), V3d(5, 0, 0));
  for (const double value : bands.values()) EXPECT_NEAR(value, 3, 1e-12);
}

// ---- specdata

TEST(SpecdataPattern, IsATableByPlaceAndWavelength) {
  // 1 + x * nm/100, which interpolation reproduces.
  std::string text = "2\n0 2 3\n400 700 4\n";
  for (const double x : {0., 1., 2.})
    for (const double nm : {400., 500., 600., 700.}) text += fmt::format("{} ", 1 + x * nm / 100);
  const File data(text), cal("twice(v, nm) = 2*v + nm/1000;\n", "cal");
  const std::string pattern = "void specdata P 4 twice " + data.path() + " " + cal.path() + " Px-1 0 0";
  std::array<double, 4> values{};
  for (size_t i = 0; i < 4; ++i) {
    const double nm = 400 + 100 * static_cast<double>(i);
    values[i] = 2 * (1 + .5 * nm / 100) + nm / 1000;
  }
  const V3d place(1.5, 0, 0);
  expectColor(inChannels(pattern, place), rgbOf({values, 350, 750}, 4), 1e-5);
  expectBands(inBands(pattern, twenty(), place), bandsOf({values, 350, 750}, twenty()), 1e-5);
}

// Correction functions are evaluated at the wavelengths of the table.
TEST(SpecdataPattern, UnevenWavelengthsHaveTheirMeans) {
  const File data("2\n0 1 2\n0 0 3\n400 430 700\n1 2 3\n3 2 1\n"), cal("f(v, nm) = v*v + nm/100;\n", "cal");
  const SpectralSampling& sampling = spectralSampling(16, 380, 780);
  const Bands bands =
      inBands("void specdata P 4 f " + data.path() + " " + cal.path() + " Px 0 0", sampling, V3d(.25, 0, 0));
  const std::array<double, 3> values{1.5 * 1.5 + 4, 2 * 2 + 4.3, 2.5 * 2.5 + 7};
  const auto f = [&](double nm) {
    return nm < 430 ? values[0] + (values[1] - values[0]) * (nm - 400) / 30
                    : values[1] + (values[2] - values[1]) * (nm - 430) / 270;
  };
  expectBands(bands, meansOf(f, sampling, 400, 700), 1e-2);
}

TEST(SpecdataPattern, NeedsAtLeastTwoDimensions) {
  const File line("1\n400 700 4\n1 1 1 1\n"), plane("3\n0 1 2\n0 1 2\n400 700 2\n1 1 1 1 1 1 1 1\n", "plane");
  EXPECT_EQ(
      errorOf("void specdata P 4 noop " + line.path() + " . Px 0 0"),
      "room.rad:1: specdata \"P\": expected data of at least 2 dimensions, the last of them the wavelength");
  EXPECT_EQ(errorOf("void specdata P 4 noop " + plane.path() + " . Px 0 0"),
            "room.rad:1: specdata \"P\": expected at least 5 string arguments, with a coordinate for each "
            "dimension "
            "but the wavelength, got 4");
  EXPECT_EQ(errorOf("void specdata P 3 noop " + plane.path() + " . 0 0"),
            "room.rad:1: specdata \"P\": expected at least 4 string arguments, got 3");
  EXPECT_EQ(errorOf("void specdata P 5 noop " + plane.path() + " . Px Py 0 0"), "no error");
}

// ---- specpict

// A picture of spectra: mantissas, then the exponent, row by row from above.
std::string pictureOf(const std::vector<std::vector<uint8_t>>& pixels, const std::string& resolution,
                      const std::string& header) {
  std::string bytes = "#?RADIANCE\n" + header + "\n" + resolution + "\n";
  for (const auto& pixel : pixels) bytes.append(pixel.begin(), pixel.end());
  return bytes;
}
constexpr const char* kHeader = "NCOMP=5\nWAVELENGTH_SPLITS= 780 588 480 380\nFORMAT=Radiance_spectra\n";

TEST(SpecpictPattern, HasASpectrumInEachPixel) {
  const std::vector<std::vector<uint8_t>> pixels{
      {10, 20, 30, 40, 50, 129}, {60, 50, 40, 30, 20, 128}, {1, 2, 4, 8, 16, 130}, {0, 0, 0, 0, 255, 128}};
  const File file(pictureOf(pixels, "-Y 2 +X 2", kHeader));
  const std::string pattern = "void specpict P 5 noop " + file.path() + " . Px Py 0 0";
  const auto valuesOf = [&](size_t pixel) {
    std::array<double, 5> values{};
    for (size_t i = 0; i < 5; ++i) values[i] = std::ldexp(pixels[pixel][i] + .5, pixels[pixel][5] - 136);
    return values;
  };
  // Of the lower left, the upper right, and the middle between the upper two.
  const std::pair<V3d, std::array<double, 5>> places[] = {
      {V3d(0, 0, 0), valuesOf(2)}, {V3d(1, 1, 0), valuesOf(1)}, {V3d(.5, 1, 0), [&] {
                                                                   auto mean = valuesOf(0);
                                                                   for (size_t i = 0; i < 5; ++i)
                                                                     mean[i] = (mean[i] + valuesOf(1)[i]) / 2;
                                                                   return mean;
                                                                 }()}};
  for (const auto& [place, values] : places) {
    const Spectrum bins{values, 780, 380};
    expectColor(inChannels(pattern, place), rgbOfFalling(bins));
    expectBands(inBands(pattern, twenty(), place), bandsOf(bins, twenty()));
  }
}

// rtrace -h -ab 0 of RADIANCE 6.1a for a glow of each, with -cs 18 -pRGB as well as without. The limits of
// the bins are no whole numbers of nanometers.
TEST(SpecpictPattern, HasTheColorsOfTheOriginal) {
  const std::pair<size_t, V3d> colors[] = {{6, V3d(.6350930, 0, .05460624)},
                                           {9, V3d(.6091545, .7546815, 0)},
                                           {12, V3d(0, .4093397, .2229202)},
                                           {14, V3d(.06000546, 0, .9257315)}};
  for (const auto& [peak, color] : colors) {
    std::vector<uint8_t> pixel(19, 2);
    pixel[peak] = 200;
    pixel[18] = 130;
    const File file(pictureOf({pixel}, "-Y 1 +X 1",
                              "NCOMP=18\nWAVELENGTH_SPLITS= 780 588 480 380\nFORMAT=Radiance_spectra\n"));
    const std::string pattern = "void specpict P 5 noop " + file.path() + " . Px Py 0 0";
    const SpectralSampling& sampling = spectralSampling(18, 380, 780);
    const V3d ofBands = standardRgb(bandWeights(sampling).tristimulus(inBands(pattern, sampling).values()));
    const Color ofChannels = inChannels(pattern);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(ofChannels[i], color[i], .001) << peak;
      EXPECT_NEAR(ofChannels[i], ofBands[i], 1e-12) << peak;
    }
  }
}

TEST(SpecpictPattern, CorrectionsGetTheMiddlesOfTheBins) {
  const File file(pictureOf({{9, 9, 9, 9, 9, 128}}, "-Y 1 +X 1", kHeader)), cal("f(v, nm) = nm;\n", "cal");
  const SpectralSampling& sampling = spectralSampling(5, 380, 780);
  const Bands bands =
      inBands("void specpict P 5 f " + file.path() + " " + cal.path() + " Px Py 0 0", sampling);
  for (size_t i = 0; i < 5; ++i) EXPECT_NEAR(bands.values()[i], 740 - 80 * static_cast<double>(i), 1e-9) << i;
}

TEST(SpecpictPattern, RefusesWhatHasNoSpectra) {
  const std::vector<std::vector<uint8_t>> one{{1, 2, 3, 4, 5, 128}};
  const auto errorFor = [&](const std::string& header, const char* resolution = "-Y 1 +X 1") {
    const File file(pictureOf(one, resolution, header), "hsr");
    const std::string error = errorOf("void specpict P 5 noop " + file.path() + " . Px Py 0 0");
    const std::string place = "room.rad:1: specpict \"P\": " + file.path();
    return error.starts_with(place) ? error.substr(place.size()) : error;
  };
  EXPECT_EQ(errorFor(kHeader), "no error");
  EXPECT_EQ(errorFor("FORMAT=32-bit_rle_rgbe\n"),
            ": bad picture file: expected spectra (FORMAT=Radiance_spectra)");
  EXPECT_EQ(errorFor("FORMAT=Radiance_spectra\nWAVELENGTH_SPLITS= 780 588 480 380\n"),
            ": bad picture file: expected at least 4 components (NCOMP=)");
  EXPECT_EQ(errorFor("FORMAT=Radiance_spectra\nNCOMP=5\n"),
            ": bad picture file: expected four wavelengths (WAVELENGTH_SPLITS=)");
  EXPECT_EQ(errorFor("FORMAT=Radiance_spectra\nNCOMP=5\nWAVELENGTH_SPLITS= 780 588 480\n"),
            ": bad picture file: expected four wavelengths (WAVELENGTH_SPLITS=)");
  EXPECT_EQ(errorFor(std::string("FORMAT=32-bit_rle_rgbe\n") + kHeader),
            ": bad picture file: expected spectra (FORMAT=Radiance_spectra)");
  EXPECT_EQ(errorFor(kHeader, "-Y 2 +X 1"), ": bad picture file: it ends too early");
  EXPECT_EQ(errorFor(kHeader, "-Y 70000 +X 1"), ": bad picture file: it has more than 65536 rows or columns");
  // rtrace reads no other order either.
  for (const char* resolution : {"+Y 1 +X 1", "-Y 1 -X 1", "+X 1 -Y 1"})
    EXPECT_EQ(errorFor(kHeader, resolution),
              ": bad picture file: expected rows from above, each from left to right (-Y ... +X ...)");
  EXPECT_EQ(errorFor("NCOMP=2000000000\nWAVELENGTH_SPLITS= 780 588 480 380\n"),
            ": bad picture file: it ends too early");
}

TEST(SpecpictPattern, ColorpictRefersToIt) {
  const File file(pictureOf({{1, 2, 3, 4, 5, 128}}, "-Y 1 +X 1", kHeader), "hsr");
  EXPECT_EQ(errorOf("void colorpict P 7 red green blue " + file.path() + " . Px Py 0 0"),
            "room.rad:1: colorpict \"P\": " + file.path() +
                ": bad picture file: it has spectra, which only specpict reads");
}

}  // namespace
}  // namespace rsphere::spectral_patterns_test
