#include "rad_parser/number.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <clocale>
#include <cmath>
#include <random>
#include <string>

namespace {

using rad::parseInteger;
using rad::parseReal;

TEST(Number, RealsAsTheLanguageSpellsThem) {
  EXPECT_EQ(parseReal("1."), 1);
  EXPECT_EQ(parseReal("+.5"), .5);
  EXPECT_EQ(parseReal("-.5"), -.5);
  EXPECT_EQ(parseReal("1e3"), 1000);
  EXPECT_EQ(parseReal("1.E+03"), 1000);
  EXPECT_EQ(parseReal("-0.1"), -0.1);
  EXPECT_EQ(parseReal("00012"), 12);
  EXPECT_EQ(parseReal("3.14159265358979323846264338327950288419716939937510"), 3.141592653589793);
  EXPECT_EQ(parseReal("4.9e-324"), 4.9e-324);
}

TEST(Number, TooSmallIsZeroAndTooLargeIsNoNumber) {
  EXPECT_EQ(parseReal("1e-400"), 0);
  EXPECT_TRUE(std::signbit(*parseReal("-1e-400")));
  EXPECT_EQ(parseReal("0." + std::string(400, '0') + "1"), 0);
  EXPECT_EQ(parseReal("1e-99999999999999999999"), 0);
  EXPECT_EQ(parseReal("0e999999999999"), 0);
  EXPECT_FALSE(parseReal("1e400"));
  EXPECT_FALSE(parseReal("1" + std::string(400, '0')));
  EXPECT_FALSE(parseReal("1e99999999999999999999"));
}

TEST(Number, OtherWordsAreNoReals) {
  for (const char* word : {"",    ".",   "-",    "+",   "+-5",  "-+5",   "1,5", "1e", "1e+", "e5",
                           ".e5", "inf", "-inf", "nan", "0x10", "1.2.3", "12a", " 1", "1 ",  "1f"})
    EXPECT_FALSE(parseReal(word)) << word;
}

TEST(Number, ReadAtTheBeginningOfATextAsByTheLibrary) {
  const auto compare = [](const std::string& text) {
    double ours = 7, theirs = 7;
    const char* const first = text.data();
    const auto [end, error] = rad::readReal(first, first + text.size(), ours);
    const auto [libraryEnd, libraryError] = std::from_chars(first, first + text.size(), theirs);
    EXPECT_EQ(end - first, libraryEnd - first) << text;
    EXPECT_EQ(error, libraryError) << text;
    EXPECT_EQ(std::bit_cast<uint64_t>(ours), std::bit_cast<uint64_t>(theirs)) << text;
  };
  for (const char* text : {"",
                           ".",
                           "-",
                           "-.",
                           "1",
                           "-0",
                           "-0.0e5",
                           "1.",
                           ".5",
                           "1e",
                           "1e+",
                           "1e-x",
                           "1.5e3 ",
                           "1e22",
                           "1e23",
                           "1e-22",
                           "1e-23",
                           "1e0022",
                           "1.e5.3",
                           "1..2",
                           "1e999",
                           "1e-99",
                           "inf",
                           "nan",
                           "+1",
                           "0x1",
                           "e5",
                           "1E5,",
                           "--1",
                           "1-1",
                           "999999999999999e22",
                           "9007199254740993",
                           "123456789012345.6e-3",
                           "00000000000000000001"})
    compare(text);
  std::mt19937_64 random(3);
  for (int i = 0; i < 20000; ++i) {
    const auto any = std::bit_cast<double>(random());
    compare(i % 2 ? fmt::format("{:.{}g} 2", any, 1 + i % 17) : fmt::format("{:.{}e}", any, i % 17));
    compare(fmt::format("{:.{}f}", 1e-5 * static_cast<double>(static_cast<int32_t>(random())), i % 12));
  }
  // Digits are read together with the characters behind them: those next to the digits in
  // ASCII, and those beyond ASCII.
  for (const char* behind :
       {" 12345678", ":::::::::", "/////////", "\xff\xff\xff\xff\xff\xff\xff\xff", "@@@@@@@@"})
    for (int i = 0; i < 40; ++i)
      compare(fmt::format("-{:.{}f}{}", 3.14159265358979, i % 20, behind).substr(0, 8 + i / 2));
}

TEST(Number, Integers) {
  EXPECT_EQ(parseInteger("+3"), 3);
  EXPECT_EQ(parseInteger("-12"), -12);
  EXPECT_EQ(parseInteger("99999999999"), 99999999999);
  for (const char* word : {"", "+", "-", "+-3", "1.", "1e3", "3x", "99999999999999999999"})
    EXPECT_FALSE(parseInteger(word)) << word;
}

TEST(Number, TheLocaleDoesNotMatter) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* comma : {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE", "fr_FR"})
    if (std::setlocale(LC_ALL, comma)) break;
  EXPECT_EQ(parseReal("1.5"), 1.5);
  EXPECT_FALSE(parseReal("1,5"));
  std::setlocale(LC_ALL, before.c_str());
}

}  // namespace
