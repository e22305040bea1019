#include <gtest/gtest.h>

#include <cstdio>

#include "companions/trade/trade_report.h"
#include "tests/unit/support/markup_of.h"

namespace rsphere {
namespace {

struct Case {
  std::vector<Figures> all;
  Reference reference{{2, {1, 3, 1.001, 3.001}}};
  TradeSubject subject;
};

Case threeSettings() {
  Case c;
  c.all.resize(3);
  for (size_t i = 0; i < 3; ++i) {
    Figures& f = c.all[i];
    const auto n = static_cast<double>(i + 1);
    f.words = {"-Sw", i == 0 ? "h" : "c", "-Sn", std::to_string(100 * (i + 1))};
    f.seconds = .00123 * n;
    f.rms = .0123 / n;
    f.rmsAtMost = .0145 / n;
    f.largest = .0333 / n;
    f.bias = -.0011 * n;
    f.biasError = .0022 * n;
    f.estimated = i == 1 ? 0 : .011;
    f.directions = 111 * n;
  }
  markBest(c.all);
  c.subject.scene = "a<b&\"c\".rad";
  c.subject.pointsFile = "p & q";
  c.subject.pointsInFile = 7;
  c.subject.points = {1, 2, 3.5, 4, 5, 6.25};
  c.subject.accuracy = .01;
  c.subject.recommended = recommend(c.all, c.subject.accuracy);
  c.subject.command = "rsphere -Sn 200 'a<b&\"c\".rad' < 'p & q'";
  c.subject.repeats = 4;
  c.subject.bounces = 3;
  return c;
}

// A curve needs two settings: with one, the legend named a dashed line that was not drawn.
TEST(TradePlot, NamesTheDashedLineOnlyWhereItIsDrawn) {
  const std::string dashes = "stroke-dasharray=\"4 3\"", name = "nothing is as fast and as accurate";
  Case c = threeSettings();
  const std::string three = tradePlot(c.all, c.subject);
  EXPECT_NE(three.find(dashes), std::string::npos);
  EXPECT_NE(three.find(name), std::string::npos);
  for (Figures& f : c.all) f.best = &f == &c.all[1];
  const std::string one = tradePlot(c.all, c.subject);
  EXPECT_EQ(one.find(dashes), std::string::npos);
  EXPECT_EQ(one.find(name), std::string::npos);
}

// An accuracy that every setting exceeds was a line in the legend, and none in the plot.
TEST(TradePlot, HasTheAccuracyAskedForOnItsAxis) {
  Case c = threeSettings();
  for (const double accuracy : {1e-4, .5}) {
    c.subject.accuracy = accuracy;
    const std::string plot = tradePlot(c.all, c.subject);
    // The box that clips lines, and the first of them: the dotted one.
    double left = 0, top = 0, width = 0, height = 0, x = 0, y = 0;
    const size_t box = plot.find("viewBox=", plot.find("<svg") + 4), line = plot.find("<path d=\"M", box);
    ASSERT_NE(line, std::string::npos);
    ASSERT_EQ(std::sscanf(plot.c_str() + box, "viewBox=\"%lf %lf %lf %lf", &left, &top, &width, &height), 4);
    ASSERT_EQ(std::sscanf(plot.c_str() + line, "<path d=\"M%lf %lf", &x, &y), 2);
    EXPECT_GT(y, top);
    EXPECT_LT(y, top + height);
  }
}

// Interpolation (-aa) of what points see is no setting of rays.
TEST(TradePlot, NamesRaysOnlyWhereRaysAreMeasured) {
  Case c = threeSettings();
  c.all[0].words = {"-aa", ".1"};
  EXPECT_EQ(tradePlot(c.all, c.subject).find("rays, as"), std::string::npos);
  c.subject.perPoint = 6;
  EXPECT_NE(tradePlot(c.all, c.subject).find("rays, as"), std::string::npos);
}

TEST(TradePage, HasEveryFigureOfTheTable) {
  const Case c = threeSettings();
  const auto page = parsed(tradePage(c.all, c.reference, c.subject, 0));
  EXPECT_EQ(texts(page, "//body/div[@class='wide']//tbody/tr/td"),
            (std::vector<std::string>{"on the curve", "-Sw h -Sn 100",         "1.23",  "1.23%",  "1.45%",
                                      "3.33%",        "-0.110% \u00b1 0.220%", "1.10%", "111",    "",
                                      "recommended",  "-Sw c -Sn 200",         "2.46",  "0.615%", "0.725%",
                                      "1.67%",        "-0.220% \u00b1 0.440%", "-",     "222",    "",
                                      "on the curve", "-Sw c -Sn 300",         "3.69",  "0.410%", "0.483%",
                                      "1.11%",        "-0.330% \u00b1 0.660%", "1.10%", "333",    ""}));
  EXPECT_EQ(texts(page, "//tr[@class='chosen']/td")[1], "-Sw c -Sn 200");
  EXPECT_EQ(texts(page, "//details//tbody/tr/td"),
            (std::vector<std::string>{"1", "1", "2", "3.5", "1", "2", "4", "5", "6.25", "3"}));
  EXPECT_EQ(texts(page, "//pre[@class='command']"), std::vector<std::string>{c.subject.command});
  EXPECT_EQ(texts(page, "//h1"), std::vector<std::string>{"Speed and accuracy: " + c.subject.scene});
  EXPECT_EQ(page.select_nodes("//svg//circle/title").size(), 3u);
  EXPECT_EQ(texts(page, "//p[@class='note']").at(0), bouncesText(3));
  expectSelfContained(page);
}

TEST(TradeTable, ExplainsTheRecommendation) {
  const Case c = threeSettings();
  const std::string table = tradeTable(c.all);
  EXPECT_NE(table.find("2.46   0.615%    0.725%    1.67%"), std::string::npos) << table;
  EXPECT_EQ(bouncesText(3).find(
                "These errors hold for -ab 3. The light that further bounces would add is not in them"),
            0u);
}

// The ring is around the mark of the recommended setting.
TEST(TradePage, MarksTheRecommendedSetting) {
  Case c = threeSettings();
  for (const size_t chosen : {0, 1, 2}) {
    c.subject.recommended.index = chosen;
    const auto page = parsed(tradePage(c.all, c.reference, c.subject, 0));
    const auto ring = page.select_node("//circle[@class='ring']").node();
    const auto mark = page.select_nodes("//svg//circle[title]")[chosen].node();
    EXPECT_STREQ(ring.attribute("cx").value(), mark.attribute("cx").value());
    EXPECT_STREQ(ring.attribute("cy").value(), mark.attribute("cy").value());
  }
}

TEST(TradePage, SaysIfNoSettingIsAccurateEnough) {
  Case c = threeSettings();
  c.subject.accuracy = .0001;
  c.subject.recommended = recommend(c.all, c.subject.accuracy);
  EXPECT_EQ(c.subject.recommended.index, 2u);
  EXPECT_FALSE(c.subject.recommended.sure);
  c.subject.repeatsOfLast = 2;
  const auto page = parsed(tradePage(c.all, c.reference, c.subject, 0));
  EXPECT_EQ(texts(page, "//p[@class='banner open']").at(0).rfind("No setting is sure", 0), 0u);
  EXPECT_EQ(texts(page, "//tr[@class='chosen']/td").back(), "2 of 4 repeats");
}

// Exact answers have no place on a logarithmic axis, but a row in the table.
TEST(TradePage, ExactSettingsAreInTheTable) {
  Case c = threeSettings();
  for (Figures& f : c.all) f.rms = f.rmsAtMost = 0;
  const auto page = parsed(tradePage(c.all, c.reference, c.subject, 0));
  EXPECT_EQ(page.select_nodes("//body/div//tbody/tr").size(), 3u);
  EXPECT_TRUE(page.select_nodes("//svg//circle").empty());
}

}  // namespace
}  // namespace rsphere
