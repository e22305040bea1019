#include "records/number_text.h"

#include <gtest/gtest.h>

#include <bit>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace rsphere {
namespace {

// The text must be that of printf.
std::string printed(double x) {
  char text[64];
  std::snprintf(text, sizeof text, "%e", x);
  return text;
}

void expectAsPrinted(double x) {
  std::string text;
  appendScientific(text, x);
  ASSERT_EQ(text, printed(x)) << std::bit_cast<uint64_t>(x);
}

TEST(NumberText, SpecialNumbersAreThoseOfPrintf) {
  using Limits = std::numeric_limits<double>;
  for (const double x :
       {0.0, -0.0, Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN(), -Limits::quiet_NaN(),
        Limits::denorm_min(), -Limits::denorm_min(), Limits::min(), Limits::max(), 1e10, 1.0, -1.0})
    expectAsPrinted(x);
}

TEST(NumberText, EveryPowerOfTenAndItsNeighbours) {
  for (int exponent = -330; exponent <= 308; ++exponent) {
    const double x = std::stod("1e" + std::to_string(std::max(exponent, -307)));
    for (const double y :
         {x, std::nextafter(x, 0), std::nextafter(x, 1e308), 9.9999995 * x, 9.9999994999 * x, 3 * x})
      expectAsPrinted(y);
  }
}

// For values exactly between two 7-digit numbers, printf rounds to even.
TEST(NumberText, MiddlesBetweenTwoNumbers) {
  for (int i = 1000000; i < 1002000; ++i) {
    expectAsPrinted(i + 0.5);
    expectAsPrinted((i + 0.5) * 1024);
    expectAsPrinted((i + 0.5) / 1024);
    expectAsPrinted(std::nextafter(i + 0.5, 0));
    expectAsPrinted(std::nextafter(i + 0.5, 1e9));
  }
}

TEST(NumberText, AMillionRandomBitPatternsAndAMillionUsualNumbers) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-24, 24);
  for (int i = 0; i < 1000000; ++i) {
    expectAsPrinted(std::bit_cast<double>(random()));
    expectAsPrinted(std::pow(10, exponent(random)) * (random() % 2 == 0 ? 1 : -1));
    // Numbers with few binary digits, as floats have, are more often such values.
    expectAsPrinted(static_cast<double>(static_cast<float>(std::pow(10, exponent(random) / 4))));
  }
}

}  // namespace
}  // namespace rsphere
