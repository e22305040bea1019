#include "shade/bsdf.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "../support/bsdf_xml.h"
#include "../support/statistics.h"
#include "base/constants.h"

namespace rsphere {
namespace {

BsdfData dataOf(const std::string& xml, std::vector<std::string>* warnings = nullptr) {
  const rad::Warn warn = [warnings](std::string_view line) {
    if (warnings) warnings->emplace_back(line);
  };
  return BsdfData(rad::BsdfFile::parse(xml, "a.xml", warn), "a.xml", warn);
}

// All of the scattering between two directions, as the original's library has it.
Color value(const BsdfData& data, const V3d& view, const V3d& other) {
  const bool front = view.z > 0;
  Color c = front == (other.z > 0) ? data.diffuseReflectance(front) : data.diffuseTransmittance(front);
  c /= kPi;
  if (const DirectedScattering* part = data.between(view, other)) c += rgbOf(part->cell(view, other).value);
  return c;
}

struct Named {
  const char* name;
  std::string xml;
};
const std::vector<Named>& files() {
  static const std::vector<Named> all{{"half", halfXml()},
                                      {"quarter", quarterXml()},
                                      {"tree4", tree4Xml()},
                                      {"tree3", tree3Xml()},
                                      {"colored tree", coloredTreeXml()}};
  return all;
}

V3d unit(double x, double y, double z) { return V3d(x, y, z).normalized(); }

// bsdfquery -c FILE.xml of RADIANCE 6.1a, with the view as the exiting and the other direction as the
// incident one; X Y Z. It varies values by up to 3e-4 from cell to cell, keeps chromaticities in
// 16 bits, and mixes them for the diffuse part; ours are those of the file.
TEST(Bsdf, ValuesAsTheOriginal) {
  struct Row {
    const char* name;
    V3d view, other, xyz;
  };
  const Row rows[] = {
      {"half", {0.31, 0.6, 0.74}, {-0.32, -0.61, -0.74}, {0.509909, 0.509909, 0.509909}},
      {"half", {-0.49, -0.34, -0.81}, {0.42, 0.34, -0.81}, {0.350023, 0.350023, 0.350022}},
      {"half", {-0.04, 0.42, -0.91}, {0.9, -0.32, -0.3}, {0.0502001, 0.0502001, 0.0502}},
      {"half", {0.05, 0.57, -0.82}, {-0.15, -0.42, 0.82}, {0.385398, 0.385398, 0.385398}},
      {"half", {0.17, -0.7, -0.69}, {-0.13, 0.63, -0.69}, {0.301439, 0.301439, 0.301439}},
      {"half", {-0.13, -0.71, 0.69}, {-0.05, 0.99, -0.09}, {0.324611, 0.324611, 0.324611}},
      {"quarter", {0.31, 0.6, 0.74}, {-0.32, -0.61, -0.74}, {0.728927, 0.609902, 0.296886}},
      {"quarter", {0.05, 0.57, -0.82}, {-0.15, -0.42, 0.82}, {0.41601, 0.346435, 0.177515}},
      {"quarter", {-0.13, -0.71, 0.69}, {-0.05, 0.99, -0.09}, {0.618805, 0.517752, 0.25203}},
      {"quarter", {-0.5, -0.23, -0.84}, {0.55, 0.26, 0.84}, {0.735396, 0.609911, 0.294737}},
      {"quarter", {0.82, -0.42, 0.4}, {-0.73, 0.28, 0.4}, {0.315727, 0.272173, 0.183258}},
      {"quarter", {0.05, 0.09, -0.99}, {0.52, 0.59, 0.62}, {0.0238707, 0.0200003, 0.00977538}},
      {"tree4", {0.31, 0.6, 0.74}, {-0.32, -0.61, -0.74}, {12.1204, 12.1204, 12.1204}},
      {"tree4", {0.05, 0.57, -0.82}, {-0.15, -0.42, 0.82}, {0.110673, 0.110673, 0.110673}},
      {"tree4", {-0.13, -0.71, 0.69}, {-0.05, 0.99, -0.09}, {0.0747221, 0.0747221, 0.0747221}},
      {"tree4", {-0.5, -0.23, -0.84}, {0.55, 0.26, 0.84}, {12.1202, 12.1202, 12.1202}},
      {"tree4", {-0.41, 0.62, -0.67}, {-0.04, 0.82, 0.58}, {0.02183, 0.02183, 0.02183}},
      {"tree4", {0.82, -0.42, 0.4}, {-0.73, 0.28, 0.4}, {0.423326, 0.423326, 0.423326}},
      {"tree3", {0.31, 0.6, 0.74}, {-0.32, -0.61, -0.74}, {10.2713, 10.2713, 10.2713}},
      {"tree3", {0.05, 0.57, -0.82}, {-0.15, -0.42, 0.82}, {0.329252, 0.329252, 0.329252}},
      {"tree3", {-0.13, -0.71, 0.69}, {-0.05, 0.99, -0.09}, {0.0809272, 0.0809272, 0.0809272}},
      {"tree3", {-0.5, -0.23, -0.84}, {0.55, 0.26, 0.84}, {0.469288, 0.469288, 0.469288}},
      {"tree3", {-0.41, 0.62, -0.67}, {-0.04, 0.82, 0.58}, {0.02, 0.02, 0.02}},
      {"tree3", {0.82, -0.42, 0.4}, {-0.73, 0.28, 0.4}, {0.42347, 0.42347, 0.42347}},
      {"colored tree", {0.31, 0.6, 0.74}, {-0.32, -0.61, -0.74}, {0.554727, 0.549971, 0.687342}},
      {"colored tree", {0.05, 0.57, -0.82}, {-0.15, -0.42, 0.82}, {0.386041, 0.382926, 0.31979}},
      {"colored tree", {-0.13, -0.71, 0.69}, {-0.05, 0.99, -0.09}, {0.297652, 0.314446, 0.273414}},
      {"colored tree", {-0.5, -0.23, -0.84}, {0.55, 0.26, 0.84}, {0.499901, 0.550006, 0.62322}},
      {"colored tree", {-0.41, 0.62, -0.67}, {-0.04, 0.82, 0.58}, {0.0463154, 0.0509696, 0.0478669}},
      {"colored tree", {-0.26, -0.94, 0.23}, {-0.92, 0.1, -0.37}, {0.0450904, 0.0504397, 0.0520907}},
  };
  for (const auto& [name, xml] : files()) {
    const BsdfData data = dataOf(xml);
    for (const Row& row : rows) {
      if (std::string(row.name) != name) continue;
      const Color ours = value(data, row.view.normalized(), row.other.normalized());
      const Color theirs = rgbOf({row.xyz.x, row.xyz.y, row.xyz.z});
      EXPECT_NEAR(brightness(ours), row.xyz.y, 4e-4 * row.xyz.y) << name << " " << row.view << row.other;
      for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(ours[i], theirs[i], .03 * row.xyz.y + .005) << name << " " << row.view << row.other;
    }
  }
}

// Equal values of X, Y and Z are white; a colour beyond what RADIANCE's primaries can mix keeps its
// luminance.
TEST(Bsdf, Colours) {
  const Color white = rgbOf({.3, .3, .3});
  EXPECT_EQ(white, Color(.3, .3, .3));
  // RADIANCE's green, x = .29, y = .6; its part in white's luminance is its weight in brightness.
  const Color green = rgbOf({.29 / .6 * kGreenWeight, kGreenWeight, .11 / .6 * kGreenWeight});
  EXPECT_NEAR(green.x, 0, 1e-4);
  EXPECT_NEAR(green.y, 1, 1e-4);
  EXPECT_NEAR(green.z, 0, 1e-4);
  const Color deep = rgbOf({.1, .7, .1});
  EXPECT_GE(std::min({deep.x, deep.y, deep.z}), 0);
  EXPECT_NEAR(brightness(deep), .7, 1e-4);
}

// The smallest value is the diffuse part where it is worth more than 1%; the rest is directed.
TEST(Bsdf, TheDiffusePartIsTheSmallestValue) {
  const BsdfData data = dataOf(halfXml());
  EXPECT_EQ(data.diffuseReflectance(true), Color(0, 0, 0));
  EXPECT_NEAR(data.diffuseReflectance(false).x, .05 * kPi, 1e-5);
  EXPECT_NEAR(data.diffuseTransmittance(true).x, .01 * kPi, 1e-5);
  EXPECT_NEAR(data.diffuseTransmittance(false).y, .02 * kPi, 1e-5);
  const BsdfData even =
      dataOf(bsdfXml("TensorTree4", treeBlock("Visible", "Reflection Back", 4, 2, .5, lobe(.2, 0, 1))));
  EXPECT_NEAR(even.diffuseReflectance(true).x, .2 * kPi, 1e-5);
  EXPECT_EQ(even.reflection(true), nullptr);
  EXPECT_EQ(even.reflection(false), nullptr);
  EXPECT_EQ(even.transmission(true), nullptr);
}

// What is measured for one side serves the other, with the directions exchanged.
TEST(Bsdf, TransmissionIsReciprocal) {
  Random random(1);
  for (const auto& [name, xml] : files()) {
    const BsdfData data = dataOf(xml);
    if (data.transmission(true) != data.transmission(false)) continue;
    for (int i = 0; i < 300; ++i) {
      V3d a = randomDirection(random), b = randomDirection(random);
      if (a.z * b.z > 0) b.z = -b.z;
      EXPECT_EQ(value(data, a, b), value(data, b, a)) << name;
    }
  }
}

// A file whose values are symmetric is: reflection of the tables' functions does not change when its
// directions are exchanged, up to the cells that they fall in.
TEST(Bsdf, ReflectionOfSymmetricDataIsReciprocal) {
  Random random(2);
  for (const std::string& xml : {halfXml(), tree4Xml()}) {
    const BsdfData data = dataOf(xml);
    for (int i = 0; i < 300; ++i) {
      V3d a = randomDirection(random), b = randomDirection(random);
      a.z = std::abs(a.z);
      b.z = std::abs(b.z);
      const double one = value(data, a, b).x, other = value(data, b, a).x;
      EXPECT_NEAR(one, other, 2e-4 + 1e-4 * one);
    }
  }
}

// The albedo is the integral of the values, whichever way round they are asked.
TEST(Bsdf, AlbedoIsTheIntegralOfTheValues) {
  Random random(3);
  for (const auto& [name, xml] : files()) {
    const BsdfData data = dataOf(xml);
    for (const V3d& view : {unit(.1, .2, .9), unit(-.7, .3, .5), unit(.4, .1, -.3), unit(-.05, 0, -1)})
      for (const DirectedScattering* part : {data.reflection(view.z > 0), data.transmission(view.z > 0)}) {
        if (!part || (part->turned(view) && std::string(name) == "tree3")) continue;
        // Points of a fine grid on the square that the cells are even in, and of rings for matrices.
        constexpr int kSide = 256;
        double sum = 0;
        for (int i = 0; i < kSide; ++i)
          for (int j = 0; j < kSide; ++j) {
            const double radius = std::sqrt((i + .5) / kSide), angle = 2 * kPi * (j + .5) / kSide;
            const double up = std::sqrt(1 - radius * radius);
            const bool below = (view.z > 0) == part->transmits();
            const V3d other(radius * std::cos(angle), radius * std::sin(angle), below ? -up : up);
            sum += part->cell(view, other).value.y;
          }
        const double integral = kPi * sum / (kSide * kSide);
        EXPECT_NEAR(part->albedo(view), integral, .02 * integral + 1e-4) << name << " " << view;
        EXPECT_LE(part->albedo(view), part->largestAlbedo() * 1.0001 + (part->turned(view) ? .3 : 0));
      }
  }
}

// Of 1000 views each, where the file gives away no more than there is.
TEST(Bsdf, NoEnergyIsMade) {
  Random random(5);
  for (const auto& [name, xml] : files()) {
    std::vector<std::string> warnings;
    const BsdfData data = dataOf(xml, &warnings);
    EXPECT_TRUE(warnings.empty()) << name << ": " << warnings[0];
    for (int i = 0; i < 1000; ++i) {
      const V3d view = randomDirection(random);
      const bool front = view.z > 0;
      double all = brightness(data.diffuseReflectance(front) + data.diffuseTransmittance(front));
      for (const DirectedScattering* part : {data.reflection(front), data.transmission(front)})
        if (part) all += part->albedo(view);
      EXPECT_LE(all, 1) << name << " " << view;
      EXPECT_GE(all, 0) << name << " " << view;
    }
  }
}

// Counts of drawn directions in cells of the square against what the values say; and that draws from another
// view would be told from them.
TEST(Bsdf, SamplesFollowTheValues) {
  constexpr int kSide = 12, kFine = 24, kDraws = 60000;
  Random random(4);
  for (const auto& [name, xml] : files()) {
    const BsdfData data = dataOf(xml);
    for (const V3d& view : {unit(.3, .2, .9), unit(-.5, .4, -.7)})
      for (const DirectedScattering* part : {data.reflection(view.z > 0), data.transmission(view.z > 0)}) {
        if (!part || !(part->albedo(view) > 0)) continue;
        const bool below = (view.z > 0) == part->transmits();
        std::vector<double> expected(kSide * kSide), counts(kSide * kSide), spoiled(kSide * kSide);
        double total = 0;
        for (int i = 0; i < kSide * kFine; ++i)
          for (int j = 0; j < kSide * kFine; ++j) {
            const auto [x, y] = diskPoint((i + .5) / (kSide * kFine), (j + .5) / (kSide * kFine));
            const double up = std::sqrt(std::max(0., 1 - x * x - y * y));
            const double f = part->cell(view, V3d(x, y, below ? -up : up)).value.y;
            expected[(i / kFine) * kSide + j / kFine] += f;
            total += f;
          }
        for (double& e : expected) e *= kDraws / total;
        const auto cellOf = [](const V3d& d) {
          // The inverse of diskPoint().
          const double r = std::sqrt(d.x * d.x + d.y * d.y);
          double a = 0, b = 0;
          if (std::abs(d.x) > std::abs(d.y)) {
            a = std::copysign(r, d.x);
            b = a * std::atan(d.y / d.x) * 4 / kPi;
          } else if (d.y != 0) {
            b = std::copysign(r, d.y);
            a = b * std::atan(d.x / d.y) * 4 / kPi;
          }
          const auto place = [](double s) {
            return std::min(static_cast<int>((s + 1) / 2 * kSide), kSide - 1);
          };
          return place(a) * kSide + place(b);
        };
        const V3d wrong = unit(view.x - .35, view.y, view.z);
        for (int i = 0; i < kDraws; ++i) {
          const V3d d = part->sample(view, random.uniform(), random.uniform());
          ASSERT_NEAR(d.length(), 1, 1e-9);
          ASSERT_EQ(d.z < 0, below) << name;
          counts[cellOf(d)] += 1;
          spoiled[cellOf(part->sample(wrong, random.uniform(), random.uniform()))] += 1;
        }
        // The fine grid of the expectation does not follow the rings of matrices exactly.
        EXPECT_LT(chiSquaredSigmas(counts, expected), kMostSigmas) << name << " " << view;
        EXPECT_GT(chiSquaredSigmas(spoiled, expected), kMostSigmas) << name << " " << view;
      }
  }
}

// Draws at the edges of the unit square are directions like any other.
TEST(Bsdf, EdgesOfTheUnitSquare) {
  for (const auto& [name, xml] : files()) {
    const BsdfData data = dataOf(xml);
    for (const V3d& view : {V3d(0, 0, 1), V3d(0, 0, -1), unit(1, 0, 1e-9), unit(0, -1, -1e-9)})
      for (const DirectedScattering* part : {data.reflection(view.z > 0), data.transmission(view.z > 0)}) {
        if (!part || !(part->albedo(view) > 0)) continue;
        for (double u1 : {0., .5, 1 - 0x1p-53})
          for (double u2 : {0., .5, 1 - 0x1p-53})
            EXPECT_NEAR(part->sample(view, u1, u2).length(), 1, 1e-6) << name;
      }
  }
}

// Isotropic data tell nothing of how light is scattered that comes from the other side, but its values.
TEST(Bsdf, IsotropicDataGoOneWay) {
  std::vector<std::string> warnings;
  const BsdfData data =
      dataOf(bsdfXml("TensorTree3", treeBlock("Visible", "Transmission Back", 3, 3, .5, lobe(.02, .5, .3))),
             &warnings);
  const V3d front = unit(.2, .1, 1), back = unit(-.2, -.1, -1);
  EXPECT_GT(data.transmission(true)->albedo(front), 0);
  EXPECT_EQ(data.transmission(false)->albedo(back), 0);
  EXPECT_EQ(value(data, front, back), value(data, back, front));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0],
            "a.xml: no back transmission, and isotropic data of the other side do not determine it");
}

TEST(Bsdf, WarnsOfMoreThanAllLight) {
  std::vector<std::string> warnings;
  dataOf(bsdfXml("TensorTree4", treeBlock("Visible", "Reflection Back", 4, 1, .5, lobe(.3, 1, .5))),
         &warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(warnings[0].ends_with("% of the light")) << warnings[0];
}

// A narrow peak is what goes straight on; a wide lobe is none.
TEST(Bsdf, OnlyANarrowPeakGoesThrough) {
  const BsdfData peak = dataOf(tree4Xml()), wide = dataOf(halfXml());
  for (const V3d& view : {unit(.3, .2, .9), unit(-.3, .2, -.9)}) {
    const BsdfData::Through t = peak.through(view);
    const double albedo = peak.transmission(view.z > 0)->albedo(view);
    EXPECT_GT(t.peak.x, .2 * albedo);
    EXPECT_LT(t.peak.x, albedo);
    EXPECT_GT(t.around.x, 0);
    EXPECT_LT(t.around.x, 1);
    EXPECT_EQ(wide.through(view).peak, Color(0, 0, 0));
  }
}

}  // namespace
}  // namespace rsphere
