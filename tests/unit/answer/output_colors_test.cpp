#include "answer/output_colors.h"

#include <sstream>

#include "answer/answer_writer.h"
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
TEST(OutputColors, BandsHaveTheValueOfTheirChannel) {
  const Color abc(1, 2, 3);
  expectNear(written({"-cs", "6", "-co+"}, abc), {1, 1, 1, 2, 2, 3});
  expectNear(written({"-co", "-cs", "7"}, abc), {1, 1, 1, 2, 2, 3, 3});
  expectNear(written({"-co", "-cs", "4", "-cw", "600", "500"}, abc), {1, 2, 2, 3});
  expectNear(written({"-co", "-cs", "5", "-cw", "300", "1000"}, abc), {1, 1, 1, 2, 3});
  EXPECT_EQ(written({"-co", "-cs", "40"}, abc).size(), 24u);
  expectNear(written({"-co", "-cs", "3"}, abc), {1, 2, 3});
  expectNear(written({"-cs", "9"}, abc), {1, 2, 3});
  expectNear(written({"-co", "-co", "-cs", "9"}, abc), {1, 2, 3});
}

// Coefficients are not converted to lumens.
TEST(OutputColors, CoefficientsAreNotScaled) {
  expectNear(written({"-pY", "-w"}, kLamp, "-oW"), {1});
  expectNear(written({"-pXYZ", "-w"}, kLamp, "-oW"), {1, 1, 1});
}

TEST(OutputColors, PixelsOfBandsShareAnExponent) {
  const Options options = parse({"rtrace", "-cs", "6", "-co", "-fac", "s.oct"});
  RayAnswer answer;
  answer.value = Radiance(Color(0, 0, 1));
  std::string bytes;
  AnswerWriter(options).write(bytes, answer);
  EXPECT_EQ(bytes, std::string("\0\0\0\0\0\x80\x81", 7));  // as rtrace writes it
}

TEST(OutputColors, WhatCannotBeIsSaidAsInRtrace) {
  EXPECT_EQ(faultOfOptions({"rtrace", "-cs", "2", "s"}), "unsupported spectral sampling");
  EXPECT_EQ(faultOfOptions({"rtrace", "-cw", "500", "530", "s"}), "unsupported spectral sampling");
  EXPECT_EQ(faultOfOptions({"rtrace", "-pc", "1", "0", "0", "1", "0", "0", "0", ".3333", "s"}),
            "illegal primary chromaticities");
  EXPECT_EQ(faultOfOptions({"rtrace", "-pc", ".1", ".1", ".2", ".2", ".3", ".3", ".3", ".4", "s"}),
            "illegal primary chromaticities");  // they lie on a line, where rtrace divides by zero
  EXPECT_EQ(faultOfOptions({"rtrace", "-pY", "-ffc", "s"}), "color format incompatible with -pY, -pS, -pM");
  EXPECT_EQ(parse({"rtrace", "-cw", "500", "600", "s"}).messages.remarks,
            (std::vector<std::string>{"spectral range incompatible with color output"}));
  EXPECT_TRUE(parse({"rtrace", "-cw", "500", "600", "-pY", "s"}).messages.remarks.empty());
  EXPECT_EQ(faultOfOptions({"rtrace", "-pS", "-cw", "400", "700", "s"}),
            "-pS and -pM need the whole spectrum (-cw 380 780)");
  EXPECT_EQ(faultOfOptions({"rsphere", "-pXYZ", "-ove", "s"}),
            "-oe needs -pRGB or -pY: standard errors are those of red, green and blue, or of luminance");
  EXPECT_NO_THROW(parse({"rsphere", "-pY", "-ove", "s"}));
  EXPECT_NO_THROW(parse({"rtrace", "-cs", "2", "-defaults"}));
}

}  // namespace
}  // namespace rsphere
