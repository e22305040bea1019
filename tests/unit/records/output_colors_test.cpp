#include "records/output_colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "answer/answer_writer.h"
#include "answer/column_names.h"
#include "tests/unit/support/command_line.h"

namespace rsphere {
namespace {

// The numbers written for a ray of this color.
std::vector<double> written(std::vector<const char*> words, const Color& color, const char* letters = "-ov") {
  std::vector<std::string> all{"rtrace"};
  all.insert(all.end(), words.begin(), words.end());
  all.insert(all.end(), {letters, "s.oct"});
  const Options options = parseOptions(all);
  RayAnswer answer;
  answer.value = Radiance(color);
  std::string bytes;
  AnswerWriter(options).write(bytes, answer);
  std::istringstream in(bytes);
  std::vector<double> numbers{std::istream_iterator<double>(in), {}};
  EXPECT_EQ(numbers.size(), static_cast<size_t>(componentCount(options)));
  return numbers;
}

void expectNear(const std::vector<double>& numbers, const std::vector<double>& expected) {
  ASSERT_EQ(numbers.size(), expected.size());
  for (size_t i = 0; i < numbers.size(); ++i)
    EXPECT_NEAR(numbers[i], expected[i], 1.5e-6 * std::fabs(expected[i]) + 1e-8) << i;
}

const Color kLamp(10, 8, 5), kFloor(.8 / 30, .64 / 90, .2 / 90);

// The output of rtrace -h with the option (RADIANCE 6.1a) for rays that see these two colors.
TEST(OutputColors, AreThoseOfTheOriginal) {
  expectNear(written({"-pXYZ"}, kLamp), {1.529085e+03, 1.492117e+03, 9.825419e+02});
  expectNear(written({"-pXYZ"}, kFloor), {2.930881e+00, 2.144180e+00, 6.107408e-01});
  expectNear(written({"-pY"}, kLamp), {1.492117e+03});
  expectNear(written({"-pS"}, kLamp), {2.959485e+03});
  expectNear(written({"-pS"}, kFloor), {2.457195e+00});
  expectNear(written({"-pM"}, kLamp), {1.218995e+03});
  expectNear(written({"-pA"}, kLamp), {7.666667e+00});
  const std::vector<const char*> wide = {"-pc", ".68", ".32", ".265", ".69", ".15", ".06", ".3127", ".329"};
  expectNear(written(wide, kLamp), {9.929738e+00, 8.088112e+00, 5.381193e+00});
  expectNear(written(wide, kFloor), {2.561085e-02, 7.970176e-03, 3.241121e-03});
  // Pure colors. Those outside the smaller gamut are mixed with grey.
  expectNear(written(wide, Color(1, 0, 0)), {0.9422708749771118, 0.043866150081157684, 0.024370217695832253});
  expectNear(written(wide, Color(0, 0, 1)), {0, 0.011732321232557297, 0.7355017066001892});
  const std::vector<const char*> small = {"-pc", ".64", ".33", ".3", ".6", ".15", ".06", ".3333", ".3333"};
  expectNear(written(small, kLamp), {1.007057e+01, 7.999896e+00, 5.035167e+00});
  expectNear(written({"-pc", "1", "0", "0", "1", "0", "0", ".3333", ".3333"}, kLamp),
             {8.542377e+00, 8.335847e+00, 5.487414e+00});
}

TEST(OutputColors, StandardPrimariesAreRgb) {
  EXPECT_EQ(parse({"rtrace", "-pXYZ", "-pc", ".64", ".33", ".29", ".6", ".15", ".06", ".3333", ".3333", "s"})
                .color.space,
            ColorSpace::rgb);
  EXPECT_EQ(parse({"rtrace", "-pY", "-pRGB", "s"}).color.space, ColorSpace::rgb);
}

// The output of rtrace -co -cs .. -cw .. for pure red and green.
TEST(OutputColors, ColorsWithoutBandsHaveTheValueOfTheirChannelInEach) {
  const Color abc(1, 2, 3);
  expectNear(written({"-cs", "6", "-co+"}, abc), {1, 1, 1, 2, 2, 3});
  expectNear(written({"-co", "-cs", "7"}, abc), {1, 1, 1, 2, 2, 3, 3});
  expectNear(written({"-co", "-cs", "4", "-cw", "600", "500"}, abc), {1, 2, 2, 3});
  expectNear(written({"-co", "-cs", "5", "-cw", "300", "1000"}, abc), {1, 1, 1, 2, 3});
  EXPECT_EQ(written({"-co", "-cs", "40"}, abc).size(), 24u);
  expectNear(written({"-co", "-cs", "3"}, abc), {1, 2, 3});
  EXPECT_EQ(written({"-co", "-co", "-cs", "9"}, abc).size(), 3u);
}

// A color of 20 bands from 780 to 380 nm, each 20 nm wide, that this function of the middle of the band (nm)
// gives.
template <class F>
Color spectrumOf20(const F& value) {
  Bands bands(spectralSampling(20, 380, 780));
  for (size_t i = 0; i < 20; ++i) bands.values()[i] = value(770 - 20. * static_cast<double>(i));
  return Color(bands);
}

std::vector<double> writtenOf20(std::vector<const char*> words, const Color& color,
                                const char* letters = "-ov") {
  words.insert(words.end(), {"-cs", "20"});
  return written(words, color, letters);
}

TEST(OutputColors, BandsAreWrittenFromTheLongestWavelength) {
  const Color ramp = spectrumOf20([](double wavelength) { return wavelength; });
  const std::vector<double> bands = writtenOf20({"-co"}, ramp);
  ASSERT_EQ(bands.size(), 20u);
  for (size_t i = 0; i < 20; ++i) EXPECT_EQ(bands[i], 770 - 20. * static_cast<double>(i));
  expectNear(writtenOf20({"-pA"}, ramp), {580});
}

// Equal energy at all wavelengths: X = Y = Z, and the factors by which watts become lumens.
TEST(OutputColors, EqualEnergyIsWhite) {
  const Color white = spectrumOf20([](double) { return 2.; });
  const auto expectWithin = [](const std::vector<double>& numbers, const std::vector<double>& expected) {
    ASSERT_EQ(numbers.size(), expected.size());
    for (size_t i = 0; i < numbers.size(); ++i) EXPECT_NEAR(numbers[i], expected[i], 2e-3 * expected[i]) << i;
  };
  for (const Color& color : {white, Color(2, 2, 2)}) {
    expectWithin(writtenOf20({}, color), {2, 2, 2});
    expectWithin(writtenOf20({"-pXYZ"}, color), {358, 358, 358});
    expectWithin(writtenOf20({"-pc", ".64", ".33", ".3", ".6", ".15", ".06", ".3333", ".3333"}, color),
                 {2, 2, 2});
    expectWithin(writtenOf20({"-pY"}, color), {358});
    expectWithin(writtenOf20({"-pS"}, color), {824});
    expectWithin(writtenOf20({"-pM"}, color), {358});
    expectWithin(writtenOf20({"-pA"}, color), {2});
    expectWithin(writtenOf20({"-co"}, color), std::vector<double>(20, 2));
  }
}

// The light of one band, beside the CIE's tables: the integral of the curve over the band, from its values 5
// nm apart by Simpson's rule, as a share of the whole (106.857 nm for V, 97.1 nm for V').
TEST(OutputColors, OneBandHasItsShareOfTheCurve) {
  const Color green = spectrumOf20([](double wavelength) { return wavelength == 550 ? 1. : 0.; });
  const double v = (.954 + 4 * .9803 + 2 * .99495 + 4 * 1 + .995) * 5 / 3 / 106.857;
  EXPECT_NEAR(writtenOf20({"-pY"}, green)[0], 179 * v, .005 * 179 * v);
  EXPECT_NEAR(writtenOf20({"-pXYZ"}, green)[1], 179 * v, .005 * 179 * v);
  const Color cyan = spectrumOf20([](double wavelength) { return wavelength == 510 ? 1. : 0.; });
  const double scotopic = (.982 + 4 * .998 + 2 * .997 + 4 * .975 + .935) * 5 / 3 / 97.1;
  EXPECT_NEAR(writtenOf20({"-pS"}, cyan)[0], 412 * scotopic, .005 * 412 * scotopic);
}

// D65, the means of 20 bands from 780 nm down to 380 nm, from CIE 15's table of 5 nm by the trapezoidal rule.
constexpr std::array<double, 20> kD65 = {60.85,  62.17,  69.12,  70.48, 72.33,  80.76,  80.99,
                                         84.49,  89.23,  90.79,  97.11, 103.12, 106.14, 107.44,
                                         110.72, 115.86, 114.17, 92.92, 89.79,  60.51};

constexpr std::array<const char*, 5> kReceptors = {"-pEsc", "-pEmc", "-pElc", "-pErh", "-pEmel"};

// Light of D65 has an EDI equal to its illuminance for each receptor (CIE S 026), and no other light has: the
// ratios of a black body of 2856 K (illuminant A) follow from the CIE's tables of 1 nm. -pY is RADIANCE's,
// whose V(lambda) is displaced (.3% by daylight), and bands of 20 nm make up to .3%.
TEST(OutputColors, DaylightHasTheSameEffectOnAllReceptors) {
  const Color daylight = spectrumOf20([](double w) { return kD65[static_cast<size_t>((780 - w) / 20)]; });
  const double lux = writtenOf20({"-pY"}, daylight)[0];
  for (const char* receptor : kReceptors) EXPECT_NEAR(writtenOf20({receptor}, daylight)[0], lux, .008 * lux);
  const Color tungsten =
      spectrumOf20([](double w) { return std::pow(560. / w, 5) / std::expm1(1.435e7 / (2848. * w)); });
  const std::array<double, 5> expected = {.311, .807, 1.017, .573, .496};
  for (size_t i = 0; i < kReceptors.size(); ++i)
    EXPECT_NEAR(writtenOf20({kReceptors[i]}, tungsten)[0] / writtenOf20({"-pY"}, tungsten)[0], expected[i],
                .015)
        << kReceptors[i];
}

// Any number of bands, three channels and other limits have the same integrals for light without color;
// melanopic EDI is .906 times -pM.
TEST(OutputColors, ReceptorsInBandsAndChannels) {
  const Color gray(1, 1, 1);
  for (const char* receptor : kReceptors) {
    const double white = written({receptor}, gray)[0];
    for (const char* bands : {"4", "11", "24"})
      EXPECT_NEAR(written({receptor, "-cs", bands}, gray)[0], white, 1e-4 * white);
    EXPECT_NEAR(written({receptor, "-cs", "22", "-cw", "360", "800"}, gray)[0], white, 1e-4 * white);
    EXPECT_LT(written({receptor, "-cs", "10", "-cw", "480", "680"}, gray)[0], .999 * white);
    double channels = 0;
    for (const Color& one : {Color(1, 0, 0), Color(0, 1, 0), Color(0, 0, 1)})
      channels += written({receptor}, one)[0];
    EXPECT_NEAR(channels, white, 1e-5 * white);
  }
  for (const char* bands : {"3", "20"})
    for (const Color& color : {gray, kLamp, kFloor}) {
      const double melanopic = written({"-pM", "-cs", bands}, color)[0];
      EXPECT_NEAR(written({"-pEmel", "-cs", bands}, color)[0], .906 * melanopic, .005 * melanopic);
    }
  EXPECT_EQ(parse({"rtrace", "-pElc", "s"}).color.receptor, Receptor::lCone);
}

// A single band is outside the gamut. It is mixed with gray of the same luminance until the smallest channel
// is 0.
TEST(OutputColors, ColorsOutsideTheGamutKeepTheirLuminance) {
  for (double wavelength = 390; wavelength < 700; wavelength += 20) {
    const Color band = spectrumOf20([&](double w) { return w == wavelength ? 1. : 0.; });
    const std::vector<double> rgb = writtenOf20({}, band);
    EXPECT_NEAR(*std::min_element(rgb.begin(), rgb.end()), 0, 1e-9) << wavelength;
    EXPECT_NEAR(brightness(Color(rgb[0], rgb[1], rgb[2])), writtenOf20({"-pY"}, band)[0] / 179, 1e-6)
        << wavelength;
  }
}

// Two spectra of the same X, Y and Z, and so of the same color, but for scotopic and melanopic light. The
// second differs from the first by four bands whose X, Y and Z cancel: the determinants of Cramer's rule.
TEST(OutputColors, MetamersHaveTheSameColor) {
  const std::array<double, 4> changed = {450, 530, 570, 630};
  std::array<V3d, 4> xyz;
  for (size_t i = 0; i < 4; ++i) {
    const auto numbers =
        writtenOf20({"-pXYZ"}, spectrumOf20([&](double w) { return w == changed[i] ? 1000. : 0.; }));
    xyz[i] = V3d(numbers[0], numbers[1], numbers[2]) / 1000;
  }
  const auto determinant = [&](size_t a, size_t b, size_t c) { return xyz[a].dot(xyz[b].cross(xyz[c])); };
  const std::array<double, 4> change = {determinant(1, 2, 3), -determinant(0, 2, 3), determinant(0, 1, 3),
                                        -determinant(0, 1, 2)};
  const double largest = std::abs(*std::max_element(
      change.begin(), change.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
  const Color gray(1, 1, 1),
      other = spectrumOf20([&](double w) {
        const auto at = std::find(changed.begin(), changed.end(), w);
        return at == changed.end() ? 1 : 1 + .9 * change[static_cast<size_t>(at - changed.begin())] / largest;
      });
  for (const char* space : {"-pRGB", "-pXYZ", "-pY"}) {
    const auto a = writtenOf20({space}, gray), b = writtenOf20({space}, other);
    for (size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(b[i], a[i], 1e-4 * a[i]) << space << i;
  }
  for (const char* space : {"-pS", "-pM"})
    EXPECT_GT(std::abs(writtenOf20({space}, other)[0] / writtenOf20({space}, gray)[0] - 1), .01) << space;
}

// Bands end at the limits: there is no light beyond them.
TEST(OutputColors, LimitsOfTheSpectrum) {
  const Color gray(1, 1, 1);
  for (const char* space : {"-pY", "-pS", "-pM"}) {
    const double whole = written({space, "-cs", "10"}, gray)[0];
    const double part = written({space, "-cs", "10", "-cw", "480", "680"}, gray)[0];
    EXPECT_LT(part, .98 * whole) << space;
    EXPECT_GT(part, .5 * whole) << space;
    EXPECT_NEAR(written({space, "-cs", "10", "-cw", "300", "900"}, gray)[0], whole, 1e-4 * whole) << space;
  }
}

// Coefficients are not converted to lumens.
TEST(OutputColors, CoefficientsAreNotScaled) {
  expectNear(written({"-pY", "-w"}, kLamp, "-oW"), {1});
  expectNear(written({"-pXYZ", "-w"}, kLamp, "-oW"), {1, 1, 1});
  for (const double number : writtenOf20({"-pXYZ", "-w"}, kLamp, "-oW")) EXPECT_NEAR(number, 1, 1e-3);
  expectNear(writtenOf20({"-co", "-w"}, kLamp, "-oW"), std::vector<double>(20, 1));
}

TEST(OutputColors, PixelsOfBandsShareAnExponent) {
  const Options options = parse({"rtrace", "-cs", "6", "-co", "-fac", "s.oct"});
  RayAnswer answer;
  answer.value = Radiance(Color(0, 0, 1));
  std::string bytes;
  AnswerWriter(options).write(bytes, answer);
  EXPECT_EQ(bytes, std::string("\0\0\0\0\0\x80\x81", 7));  // as rtrace writes it
  Bands bands(*options.ray.sampling);
  for (size_t i = 0; i < 6; ++i) bands.values()[i] = .5 + .25 * static_cast<double>(i);
  answer.value = Radiance(Color(bands));
  bytes.clear();
  AnswerWriter(options).write(bytes, answer);
  EXPECT_EQ(bytes, std::string("\x40\x60\x80\xa0\xc0\xe0\x81", 7));
}

TEST(OutputColors, ARunIsSpectralAboveThreeBands) {
  EXPECT_EQ(parse({"rtrace", "s"}).ray.sampling, nullptr);
  EXPECT_EQ(parse({"rtrace", "-cs", "3", "-co", "s"}).ray.sampling, nullptr);
  EXPECT_EQ(parse({"rtrace", "-cs", "9", "-cw", "700", "400", "s"}).ray.sampling,
            &spectralSampling(9, 400, 700));
  EXPECT_EQ(parse({"rsphere", "-cs", "99", "s"}).ray.sampling, &spectralSampling(kMostBands, 380, 780));
  EXPECT_EQ(parse({"rsphere", "-cs", "99", "s"}).messages.remarks,
            std::vector<std::string>{"-cs 99: the range is 3 to 24; 24 bands are used"});
  EXPECT_TRUE(parse({"rsphere", "-cs", "24", "s"}).messages.remarks.empty());
}

TEST(OutputColors, WhatCannotBeIsSaidAsInRtrace) {
  EXPECT_EQ(faultOfOptions({"rtrace", "-cs", "2", "s"}), "-cs 2: expected 3 to 24 bands");
  EXPECT_EQ(faultOfOptions({"rtrace", "-cs", "-7", "s"}), "-cs -7: expected 3 to 24 bands");
  EXPECT_EQ(faultOfOptions({"rtrace", "-cw", "530", "500", "s"}),
            "-cw 500 530: expected wavelengths at least 50 nm apart");
  EXPECT_EQ(faultOfOptions({"rtrace", "-cw", "-100", "500", "s"}),
            "-cw -100 500: expected wavelengths (nm) of 0 or more");
  EXPECT_EQ(faultOfOptions({"rtrace", "-pc", "1", "0", "0", "1", "0", "0", "0", ".3333", "s"}),
            "illegal primary chromaticities");
  EXPECT_EQ(faultOfOptions({"rtrace", "-pc", ".1", ".1", ".2", ".2", ".3", ".3", ".3", ".4", "s"}),
            "illegal primary chromaticities");  // they lie on a line, where rtrace divides by zero
  EXPECT_EQ(faultOfOptions({"rtrace", "-pY", "-ffc", "s"}), "color format incompatible with -pY, -pS, -pM");
  EXPECT_EQ(parse({"rtrace", "-cw", "500", "600", "s"}).messages.remarks,
            (std::vector<std::string>{"spectral range incompatible with color output"}));
  EXPECT_TRUE(parse({"rtrace", "-cw", "500", "600", "-pY", "s"}).messages.remarks.empty());
  EXPECT_EQ(faultOfOptions({"rtrace", "-pS", "-cw", "400", "700", "s"}),
            "-pS, -pM and -pE of three channels need the whole spectrum (-cw 380 780, or -cs above 3)");
  EXPECT_EQ(faultOfOptions({"rtrace", "-pEx", "s"}),
            "command line error at '-pEx': it is -pEsc, -pEmc, -pElc, -pErh or -pEmel; see -help");
  EXPECT_NO_THROW(parse({"rtrace", "-pS", "-cs", "4", "-cw", "400", "700", "s"}));
  EXPECT_EQ(faultOfOptions({"rsphere", "-pXYZ", "-ove", "s"}),
            "-oe needs -pRGB or -pY: standard errors exist for red, green and blue, or for luminance");
  EXPECT_EQ(faultOfOptions({"rsphere", "-cs", "6", "-ove", "s"}),
            "-oe needs -co or -pY with -cs above 3: standard errors exist for bands, or for luminance");
  EXPECT_NO_THROW(parse({"rsphere", "-pY", "-ove", "s"}));
  EXPECT_NO_THROW(parse({"rsphere", "-pY", "-cs", "6", "-ove", "s"}));
  EXPECT_NO_THROW(parse({"rsphere", "-co", "-cs", "6", "-ove", "s"}));
  EXPECT_NO_THROW(parse({"rtrace", "-cs", "2", "-defaults"}));
}

}  // namespace
}  // namespace rsphere
