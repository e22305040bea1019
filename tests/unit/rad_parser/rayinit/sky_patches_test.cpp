#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "rad_parser/rayinit/interface.h"

namespace rad::calc {
namespace {

constexpr std::array<int, 8> kRows = {30, 30, 24, 24, 18, 12, 6, 1};  // Tregenza 1987: 145 patches

class Bins {
 public:
  explicit Bins(std::string_view file, std::string_view settings = "")
      : library_(sceneInterface(), [](std::string_view name) -> std::optional<SourceText> {
          const auto text = builtInFile(name);
          if (!text) return std::nullopt;
          return SourceText{std::string(name), std::string(*text)};
        }) {
    if (file == "reinhart.cal") library_.define(settings, "-e");
    library_.include(file);
    if (file != "reinhart.cal") library_.define(settings, "-p");
  }

  double value(const std::string& expression, const std::array<double, 3>& direction = {0, 0, 1}) {
    const std::vector<std::string> texts = {expression};
    Request request;
    request.expressions = texts;
    std::vector<double> in(kInputs);
    for (uint32_t i = 0; i < 3; ++i) in[Dx + i] = direction[i];
    State state;
    const double value = library_.compile(request)->evaluate({in, {}, {}}, state);
    EXPECT_EQ(state.faults, 0U) << expression;
    return value;
  }

 private:
  Library library_;
};

// The direction of an altitude and of an azimuth from y by x, in degrees.
std::array<double, 3> towards(double altitude, double azimuth) {
  const double a = altitude * std::numbers::pi / 180, b = azimuth * std::numbers::pi / 180;
  return {std::cos(a) * std::sin(b), std::cos(a) * std::cos(b), std::sin(a)};
}

// Calls check(number, altitude, azimuth) for the middle of each patch and for points near its corners; the
// patches have numbers from 0.
template <class Check>
int forEachPatch(int factor, const Check& check) {
  const double height = 90 / (7 * factor + .5);
  int number = 0;
  for (int row = 0; row <= 7 * factor; ++row) {
    const int count = row == 7 * factor ? 1 : factor * kRows[static_cast<size_t>(row / factor)];
    for (int place = 0; place < count; ++place, ++number)
      for (const double up : {.01, .25, .49})  // of a row; the zenith has half a row
        for (const double beside : {-.49, 0., .49})
          check(number, height * (row + (row == 7 * factor ? up : 2 * up)), 360. / count * (place + beside));
  }
  return number;
}

TEST(SkyPatches, OfTregenza) {
  Bins bins("tregenza.cal");
  const int patches = forEachPatch(1, [&](int number, double altitude, double azimuth) {
    ASSERT_EQ(bins.value("tbin", towards(altitude, azimuth)), number + 1) << altitude << ' ' << azimuth;
    ASSERT_EQ(bins.value("tbin", towards(-altitude, azimuth)), 0);
  });
  EXPECT_EQ(patches, 145);
  EXPECT_EQ(bins.value("Ntbins"), 146);
}

TEST(SkyPatches, OfReinhart) {
  for (const int factor : {1, 2, 4}) {
    Bins bins("reinhart.cal", fmt::format("MF:{};", factor));
    const int patches = forEachPatch(factor, [&](int number, double altitude, double azimuth) {
      ASSERT_EQ(bins.value("rbin", towards(altitude, azimuth)), number + 1) << altitude << ' ' << azimuth;
      ASSERT_EQ(bins.value("rbin", towards(-altitude, azimuth)), 0);
    });
    EXPECT_EQ(patches, 144 * factor * factor + 1);
    EXPECT_EQ(bins.value("Nrbins"), patches + 1);
  }
  EXPECT_EQ(Bins("reinhart.cal", "MF:4;").value("rbin", {0, 1, 0}), 1);  // the horizon belongs to the sky
}

// Azimuths are counted from U, around the opposite of rN, here the direction of x.
TEST(SkyPatches, OfReinhartAroundAnyDirection) {
  for (const int hand : {1, -1}) {
    Bins bins("reinhartb.cal", fmt::format("MF=2; rNx=-1; rNz=0; Ux=.3; Uy=0; Uz=.7; RHS={};", hand));
    const int patches = forEachPatch(2, [&](int number, double altitude, double azimuth) {
      const std::array<double, 3> d = towards(altitude, azimuth);
      ASSERT_EQ(bins.value("rbin", {d[2], hand * d[0], d[1]}), number) << altitude << ' ' << azimuth;
      ASSERT_EQ(bins.value("rbin", {-d[2], d[0], d[1]}), -1);
    });
    EXPECT_EQ(bins.value("Nrbins"), patches);
  }
  EXPECT_EQ(Bins("reinhartb.cal").value("Nrbins"), 145);
}

struct Klems {
  std::string kind, letter;
  std::vector<double> edges;  // in degrees from the normal
  std::vector<int> counts;
};

// The middle of each patch and points near its corners, for rays that leave by a window to the north.
TEST(SkyPatches, OfKlems) {
  for (const Klems& k :
       {Klems{"full", "", {0, 5, 15, 25, 35, 45, 55, 65, 75, 90}, {1, 8, 16, 20, 24, 24, 24, 16, 12}},
        Klems{"half", "h", {0, 6.5, 19.5, 32.5, 45.5, 58.5, 71.5, 90}, {1, 8, 12, 16, 20, 12, 8}},
        Klems{"quarter", "q", {0, 9, 27, 45, 63, 90}, {1, 8, 12, 12, 8}}}) {
    for (const int hand : {1, -1}) {
      Bins bins(fmt::format("klems_{}.cal", k.kind), fmt::format("RHS={};", hand));
      const std::string bin = fmt::format("k{}bin(0,-1,0, 0,0,1)", k.letter);
      int number = 0;
      for (size_t row = 0; row < k.counts.size(); ++row)
        for (int place = 0; place < k.counts[row]; ++place, ++number)
          for (const double out : {.01, .5, .99})
            for (const double beside : {-.49, 0., .49}) {
              const double polar = k.edges[row] + out * (k.edges[row + 1] - k.edges[row]);
              const std::array<double, 3> d =
                  towards(90 - polar, 90 - 360. / k.counts[row] * (place + beside));
              ASSERT_EQ(bins.value(bin, {-hand * d[0], d[2], -d[1]}), number) << k.kind << ' ' << polar;
              ASSERT_EQ(bins.value(bin, {-hand * d[0], -d[2], -d[1]}), -1);
            }
      EXPECT_EQ(bins.value(fmt::format("Nk{}bins", k.letter)), number);
    }
  }
  Bins full("klems_full.cal");
  const double north = full.value("kbinN", {.6, .64, .48});
  EXPECT_EQ(full.value("kbinE", {.64, -.6, .48}), north);
  EXPECT_EQ(full.value("kbinS", {-.6, -.64, .48}), north);
  EXPECT_EQ(full.value("kbinW", {-.64, .6, .48}), north);
  EXPECT_EQ(full.value("kbinD", {-.6, .48, .64}), north);
}

}  // namespace
}  // namespace rad::calc
