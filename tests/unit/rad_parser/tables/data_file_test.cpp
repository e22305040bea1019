#include "rad_parser/tables/data_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "rad_parser/error.h"

namespace rad::data_file_test {
namespace {

std::string errorOf(const std::string& text) {
  try {
    DataFile::parse(text, "grid.dat");
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

// A function that is linear in each coordinate is reproduced exactly, on even and uneven axes, up to one
// division beyond their ends.
TEST(DataFile, MultilinearFunctionsAreExact) {
  const auto f = [](double x, double y, double z) {
    return 2 + 3 * x - y + .5 * z + x * y - 2 * y * z + .25 * x * y * z;
  };
  const double xs[] = {-1, 1, 3}, ys[] = {8, 4, 2, 1}, zs[] = {0, .5, 4};
  std::string text = "3\n-1 3 3 # even\n0 0 4 8 4 2 1 # uneven, falling\n0 0 3 0 .5 4\n";
  for (double x : xs) {
    for (double y : ys) {
      for (double z : zs) text += std::to_string(f(x, y, z)) + " ";
    }
  }
  const DataFile data = DataFile::parse(text, "grid.dat");
  ASSERT_EQ(data.dimensions(), 3u);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> x(-3, 5), y(0, 12), z(-.5, 7.5);
  for (int i = 0; i < 1000; ++i) {
    const double p[] = {x(random), y(random), z(random)};
    EXPECT_NEAR(data.value(p), f(p[0], p[1], p[2]), 2e-5 * (1 + std::abs(f(p[0], p[1], p[2]))))
        << p[0] << " " << p[1];
  }
}

// RADIANCE 6.1a: void brightdata f 4 noop even.dat . Px 0 0, on a glow; rtrace -h -fad.
TEST(DataFile, BeyondTheEndsAsTheOriginal) {
  const DataFile data = DataFile::parse("1 # one\n1 3 5\n1 4 2 8 5\n", "even.dat");
  const std::pair<double, double> table[] = {
      {-3, -0.25}, {-.01, -0.990099}, {.49, -1.960784}, {.51, -1.94},   {.9, .4},
      {1, 1},      {1.2, 2.2},        {2.3, 5.6},       {2.999, 5.006}, {3, 5},
      {3.3, 3.2},  {3.49, 2.06},      {3.51, 0.662252}, {4, .5},        {7, .2}};
  for (const auto& [x, expected] : table) EXPECT_NEAR(data.value({&x, 1}), expected, 1e-6) << x;
  const double nowhere = NAN;
  EXPECT_EQ(data.value({&nowhere, 1}), 0);
}

TEST(DataFile, AnyNumberOfDimensions) {
  std::string text = "10\n";
  for (int i = 0; i < 10; ++i) text += "0 1 2\n";
  for (int i = 0; i < 1024; ++i) text += std::to_string(i) + " ";
  const DataFile data = DataFile::parse(text, "grid.dat");
  std::vector<double> p(10, .5);
  EXPECT_NEAR(data.value(p), 1023 / 2., 1e-6);
  p = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1};
  EXPECT_EQ(data.value(p), 3);
}

TEST(DataFile, ErrorsHaveTheirPlace) {
  EXPECT_EQ(errorOf(""), "grid.dat:1: expected a number of dimensions from 1 to 10, got the end of the file");
  EXPECT_EQ(errorOf("# c\n0"), "grid.dat:2: expected a number of dimensions from 1 to 10, got \"0\"");
  EXPECT_EQ(errorOf("1\n0 x 3"), "grid.dat:2: expected an axis' end, got \"x\"");
  EXPECT_EQ(errorOf("1\n0 1 1\n1"), "grid.dat:2: expected a number of divisions, 2 at least, got \"1\"");
  EXPECT_EQ(errorOf("1\n0 1 3\n1 2"), "grid.dat:3: expected a value, got the end of the file");
  EXPECT_EQ(errorOf("1\n0 1 2000000000\n1 2"),
            "grid.dat:2: fewer values in the file than its grid has points");
  EXPECT_EQ(errorOf("1\n0 0 3\n1 2 2\n1 2 3"),
            "grid.dat:3: expected divisions in ascending or descending order");
  EXPECT_EQ(errorOf("1\n0 1 2\n1e300 2"), "grid.dat:3: a value is too large");
  EXPECT_EQ(errorOf("1\n0 1 2\n1 2 and more"), "no error");
}

}  // namespace
}  // namespace rad::data_file_test
