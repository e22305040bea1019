#include "rad_parser/rayinit/prism_panel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "rad_parser/error.h"
#include "rad_parser/rayinit/interface.h"

namespace rad {
namespace {

using Imath::V3d;

double total(const PanelRays& rays) {
  double sum = 0;
  for (const PanelRay& ray : rays.all()) sum += ray.share;
  return sum;
}

PrismPanel panelOf(double a, double b, double height, double index) {
  PrismPanel panel;
  panel.a = a;
  panel.b = b;
  panel.height = height;
  panel.index = index;
  panel.threshold = 1e-5;
  panel.tolerance = 1e-6;
  return panel;
}

TEST(PrismPanel, WhatIsNotDenseLetsEverythingPass) {
  for (const V3d& along : {V3d(1, 0, 0), V3d(-1, .3, .2), V3d(.2, -1, .5)}) {
    const V3d direction = along.normalized();
    const PanelRays rays = raysThrough(panelOf(1, 2, 1.5, 1), direction);
    ASSERT_EQ(rays.count, 1u);
    EXPECT_NEAR(rays.rays[0].share, 1, 1e-4);  // the rest is below the threshold
    EXPECT_LT((rays.rays[0].direction - direction).length(), 1e-12);
  }
}

// Nothing is absorbed. Only light below the threshold, and the losses of a coating, are missing.
TEST(PrismPanel, KeepsTheLight) {
  for (int i = 0; i < 40; ++i) {
    // Light along the prisms meets more sides than a threshold of 1e-5 allows.
    const V3d direction = V3d(std::cos(i * 1.7), std::sin(i * 1.7), .5 * std::sin(i * 1.)).normalized();
    PrismPanel panel = panelOf(1, .3 + .1 * i, .5 + .03 * i, 1.5);
    EXPECT_NEAR(total(raysThrough(panel, direction)), 1, .01) << i;
    panel.coated = PrismPanel::Coated::lower;
    panel.coating = 1;
    EXPECT_NEAR(total(raysThrough(panel, direction)), 1, .01) << i;
    panel.coating = .5;
    EXPECT_LT(total(raysThrough(panel, direction)), 1.0001) << i;
  }
}

// Prisms with a right angle return light that arrives along the normal: by total reflection at both sides. 4%
// are reflected on the way out and make another round.
TEST(PrismPanel, ARightAngleReflects) {
  const PanelRays rays = raysThrough(panelOf(1, 1, 1, 1.5), V3d(1, 0, 0));
  ASSERT_EQ(rays.count, 1u);
  EXPECT_NEAR(rays.rays[0].direction.x, -1, 1e-12);
  EXPECT_NEAR(rays.rays[0].share, 1, 1e-4);
}

// One thin prism with light along the normal: by Snell's law at its long side, and by Fresnel's formulas at a
// right angle to the first.
TEST(PrismPanel, TurnsByTheLawOfRefraction) {
  const PanelRays rays = raysThrough(panelOf(3, 0, .3, 1.5), V3d(1, 0, 0));
  const double slope = std::atan2(.3, 3.), turned = std::asin(1.5 * std::sin(slope)) - slope;
  const PanelRay& most = *std::max_element(rays.all().begin(), rays.all().end(),
                                           [](const auto& r, const auto& s) { return r.share < s.share; });
  EXPECT_NEAR(std::abs(std::atan2(most.direction.y, most.direction.x)), turned, 1e-12);
  EXPECT_LT(most.direction.y, 0);  // towards the thick end, which is at the bottom
  EXPECT_NEAR(most.share, .96 * .96, 1e-3);
}

TEST(PrismPanel, EndsWhereItWouldTakeTooLong) {
  PrismPanel panel = panelOf(1, 1.3, 2, 1.7);
  panel.threshold = 0;
  EXPECT_THROW(raysThrough(panel, V3d(.6, .48, .64)), Error);
  panel.threshold = 1e-7;
  panel.tolerance = 1e-12;
  EXPECT_THROW(raysThrough(panel, V3d(.6, .48, .64)), Error);
}

// RADIANCE 6.1a with fprism.cal: rtrace -h -w -ov with prism1 surfaces of direction (dx1, dy1, dz1) or (tau1,
// tau2, ..) in front of a sky that encodes its direction.
struct Given {
  std::vector<double> reals;
  V3d along;
  V3d first, second;  // directions
  double share1, share2;
};
const Given kGiven[] = {
    {{1, 2, .5, 1.2, 1.5, .01, 4, 0, .01, .01},
     {.6, .48, .64},
     {.756440, -.134901, .640000},
     {.561997, .523984, .640000},
     .388073,
     .058224},
    {{1, 2, .5, 1.2, 1.5, .01, 4, 0, .01, .01},
     {-.6, .48, .64},
     {-.649290, -.410880, .640000},
     {-.764756, -.074488, .640000},
     .098924,
     .013241},
    {{1, 3, .5, 2, 1.3, .01, 1, .8, .1, .01},
     {.6, .48, .64},
     {.570645, -.514552, .640000},
     {1, 0, 0},
     .059709,
     0},
    {{1, 3, .5, 2, 1.3, .01, 1, .8, .1, .01},
     {-.6, .48, .64},
     {-.354006, .681967, .640000},
     {-.701654, .313180, .640000},
     .767472,
     .086537},
};

double value(const std::string& text, const std::vector<double>& reals, const V3d& along, const V3d& target) {
  calc::Library library(calc::sceneInterface(),
                        [](std::string_view) { return std::optional<calc::SourceText>(); });
  std::vector<double> inputs(calc::kInputs);
  for (uint32_t i = 0; i < 3; ++i) {
    inputs[calc::Dx + i] = along[static_cast<int>(i)];
    inputs[calc::DxA + i] = target[static_cast<int>(i)];
  }
  const std::vector<std::string> texts = {text};
  calc::Request request;
  request.expressions = texts;
  calc::State state;
  return library.compile(request)->evaluate({inputs, reals, {}}, state);
}

TEST(PrismPanel, FunctionFilesSeeWhatRtraceGivesThem) {
  for (const Given& g : kGiven) {
    const auto at = [&](const char* text) { return value(text, g.reals, g.along, V3d(0, 0, 0)); };
    const V3d first(at("fprism_val(0,1,1)"), at("fprism_val(1,1,1)"), at("fprism_val(2,1,1)"));
    const V3d second(at("fprism_val(0,1,2)"), at("fprism_val(1,1,2)"), at("fprism_val(2,1,2)"));
    EXPECT_LT((first - g.first).length(), 2e-6) << first;
    EXPECT_LT((second - g.second).length(), 2e-6) << second;
    EXPECT_NEAR(at("fprism_val(3,1,1)"), g.share1, 2e-6);
    EXPECT_NEAR(at("fprism_val(3,1,2)"), g.share2, 2e-6);
  }
}

TEST(PrismPanel, OnlyWhatGoesToALightSourceCounts) {
  const Given& g = kGiven[0];
  const auto at = [&](const char* text, const V3d& target) { return value(text, g.reals, g.along, target); };
  EXPECT_NEAR(at("fprism_val(3,1,1)", g.second), g.share2, 2e-6);
  EXPECT_NEAR(at("fprism_val(3,1,2)", g.second), g.share2, 2e-6);
  EXPECT_EQ(at("fprism_val(3,1,1)", V3d(0, 1, 0)), 0);
}

TEST(PrismPanel, WhatIsNoPanelIsRefused) {
  for (size_t i = 0; i < 10; ++i) {
    std::vector<double> reals = kGiven[2].reals;
    reals[i] = -1;
    if (i == 2) {  // the thickness has no effect
      EXPECT_NO_THROW(value("fprism_val(3,1,1)", reals, V3d(.6, .48, .64), V3d(0, 0, 0)));
    } else {
      EXPECT_THROW(value("fprism_val(3,1,1)", reals, V3d(.6, .48, .64), V3d(0, 0, 0)), Error) << i;
    }
    reals.resize(i);
    EXPECT_THROW(value("fprism_val(3,1,1)", reals, V3d(.6, .48, .64), V3d(0, 0, 0)), Error) << i;
  }
  EXPECT_THROW(value("fprism_val(4,1,1)", kGiven[0].reals, V3d(.6, .48, .64), V3d(0, 0, 0)), Error);
  EXPECT_EQ(value("fprism_val(0,1,1)", kGiven[0].reals, V3d(0, .6, .8), V3d(0, 0, 0)), 0);
}

}  // namespace
}  // namespace rad
