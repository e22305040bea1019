#include "companions/report/plot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "rad_parser/error.h"
#include "tests/unit/support/markup_of.h"

namespace rsphere {
namespace {

TEST(LogAxis, SpreadsValuesByTheirLogarithms) {
  const LogAxis axis{.01, 100, 0, 400};
  EXPECT_DOUBLE_EQ(axis.at(.01), 0);
  EXPECT_DOUBLE_EQ(axis.at(.1), 100);
  EXPECT_DOUBLE_EQ(axis.at(100), 400);
}

TEST(LogAxis, TicksAreFewAndRound) {
  const auto expectTicks = [](double low, double high) {
    const auto ticks = LogAxis{low, high, 0, 1}.ticks();
    EXPECT_GE(ticks.size(), 3u) << low << " to " << high;
    EXPECT_LE(ticks.size(), 19u) << low << " to " << high;
    for (size_t i = 0; i < ticks.size(); ++i) {
      EXPECT_GE(ticks[i], low);
      EXPECT_LE(ticks[i], high);
      EXPECT_GT(ticks[i], i > 0 ? ticks[i - 1] : 0);
      const double digits = ticks[i] / std::pow(10, std::floor(std::log10(ticks[i]) + 1e-9) - 1);
      EXPECT_NEAR(digits, std::round(digits), 1e-6) << ticks[i];
    }
  };
  expectTicks(.5, 50);
  expectTicks(.77, 1.3);
  expectTicks(7.7, 13);
  expectTicks(1e-9, 1e9);
  expectTicks(1e-30, 1e30);
  expectTicks(.002, 3);
}

// From .94 to 1.59 they used to be .94, .95, ..., 1, 1.1, ...: 12 pixels apart, with 25 for each label.
TEST(LogAxis, LabelsDoNotOverlap) {
  constexpr double kLabel = 30;  // pixels
  for (double low = .1; low < 10; low *= 1.013)
    for (const double ratio : {1.69, 1.8, 2.5, 4., 9., 30.}) {
      const LogAxis axis{low, low * ratio, 0, 626};
      const auto ticks = axis.ticks();
      EXPECT_GE(ticks.size(), 3u) << low << ' ' << ratio;
      for (size_t i = 1; i < ticks.size(); ++i)
        EXPECT_GE(axis.at(ticks[i]) - axis.at(ticks[i - 1]), kLabel) << low << " times " << ratio;
    }
}

TEST(Plot, PutsMarksWhereTheTicksSay) {
  const std::array extent = {PlotPoint{1, 1}, PlotPoint{100, 10}};
  Plot plot("a < b", extent, {"time & more", 1, " ms"}, {"error", 100, "%"});
  plot.mark({10, 1}, 4, "#123456", "<hint>");
  plot.ring({100, 10}, "#654321");
  plot.legend(Plot::Key::disc, "#123456", "one & two");
  const auto svg = parsed(plot.svg());
  const auto mark = svg.select_node("//circle[@fill='#123456']").node();
  EXPECT_STREQ(mark.child("title").text().get(), "<hint>");
  const auto tick = [&](const char* path, const std::string& text, const char* attribute) {
    for (const pugi::xpath_node& node : svg.select_nodes(path))
      if (node.node().text().get() == text) return node.node().attribute(attribute).as_double();
    ADD_FAILURE() << "no tick " << text;
    return std::numeric_limits<double>::quiet_NaN();
  };
  EXPECT_NEAR(mark.attribute("cx").as_double(), tick("//text[@class='tick-x']", "10 ms", "x"), .11);
  EXPECT_NEAR(mark.attribute("cy").as_double(), tick("//text[@class='tick-y']", "100%", "y") - 4, .11);
  const auto ring = svg.select_node("//circle[@class='ring']").node();
  EXPECT_NEAR(ring.attribute("cx").as_double(), tick("//text[@class='tick-x']", "100 ms", "x"), .11);
  EXPECT_LT(ring.attribute("cy").as_double(), mark.attribute("cy").as_double());
  const auto all = texts(svg, "//text");
  for (const char* text : {"a < b", "time & more", "error", "one & two"})
    EXPECT_NE(std::find(all.begin(), all.end(), text), all.end()) << text;
}

TEST(Plot, EqualValuesHaveAnAxisToo) {
  const std::array extent = {PlotPoint{.25, .25}};
  Plot plot("", extent, {"x"}, {"y"}, true);
  plot.mark(extent[0], 2, "red");
  EXPECT_EQ(plot.svg().find("nan"), std::string::npos);
  EXPECT_EQ(plot.svg().find("inf"), std::string::npos);
  EXPECT_LT(plot.xLow(), .25);
  EXPECT_GT(plot.xHigh(), .25);
}

TEST(Bars, AreAsLongAsTheirValues) {
  const std::array bars = {Bar{"<few", 10, "#111111"}, Bar{"many", 40, "#222222"}, Bar{"none", 0, "#333333"}};
  const auto svg = parsed(barsSvg("t", bars));
  const auto width = [&](const char* path) {
    return svg.select_node(path).node().attribute("width").as_double();
  };
  EXPECT_NEAR(width("//rect[@fill='#222222']"), 4 * width("//rect[@fill='#111111']"), .3);
  EXPECT_EQ(width("//rect[@fill='#333333']"), 0);
  EXPECT_EQ(parsed(barsSvg("nothing", {})).select_nodes("//rect").size(), 1u);
}

TEST(SvgName, HasNoExtensionOfAnotherFormat) {
  EXPECT_NO_THROW(requireSvgName("-o", "", "the plan"));
  EXPECT_NO_THROW(requireSvgName("-o", "plan", "the plan"));
  EXPECT_NO_THROW(requireSvgName("-o", "plan.SVG", "the plan"));
  try {
    requireSvgName("-o", "a.b/plan.PNG", "the plan");
    FAIL();
  } catch (const rad::Error& error) {
    EXPECT_EQ(error.status(), rad::Status::input);
    EXPECT_STREQ(error.what(), "-o \"a.b/plan.PNG\": the plan is an SVG file; use the name a.b/plan.svg");
  }
}

}  // namespace
}  // namespace rsphere
