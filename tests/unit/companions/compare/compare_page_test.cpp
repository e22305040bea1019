#include "companions/compare/compare_page.h"

#include <gtest/gtest.h>

#include "companions/compare/report.h"
#include "tests/unit/support/markup_of.h"

namespace rsphere {
namespace {

// Records that answer 1, 2, 3 and so on, with a little noise, and ours times `factor`.
Answers answersOf(size_t records, double factor, double noise) {
  Answers answers{records, 4, {}};
  for (size_t r = 0; r < answers.repeats; ++r)
    for (size_t i = 0; i < records; ++i) {
      const double x = static_cast<double>(i + 1) * factor * (1 + (r % 2 == 0 ? noise : -noise));
      answers.values.emplace_back(x, .5 * x, .25 * x);
    }
  return answers;
}

CompareSubject subjectOf() {
  CompareSubject subject;
  subject.scene = "<scene> & \"more\"";
  subject.recordsFile = "r<s";
  subject.given = "rsphere-compare 'a<b' r";
  subject.original = "/opt/rtrace";
  subject.originalVersion = "RADIANCE <test>";
  subject.tolerance = .01;
  subject.worst = "record 1 & 2\n";
  subject.times = "1 s < 2 s\n";
  return subject;
}

TEST(ComparePage, HasTheFiguresAndTheVerdict) {
  const Answers ours = answersOf(6, 1.05, .0001), original = answersOf(6, 1, .0001);
  const CompareSubject subject = subjectOf();
  const Comparison comparison = compare(ours, original, subject.tolerance, .001, true);
  const auto page = parsed(comparePage(ours, original, comparison, subject, 0));
  EXPECT_EQ(texts(page, "//p[@class='banner bad']"), std::vector<std::string>{"They differ."});
  const ChannelComparison& red = comparison.channels[0];
  EXPECT_EQ(texts(page, "//body/div[@class='wide']//tbody/tr/td[2]"),
            (std::vector<std::string>{"3.6750e+00", "3.5000e+00", "+5.00% \u00b1 " + percent(red.biasError),
                                      "4.88%", percent(red.noiseRms), percent(red.percentiles[0]),
                                      percent(red.percentiles[1]), percent(red.percentiles[2]),
                                      percent(red.percentiles[3]), "0.0%", percent(red.ourNoise),
                                      percent(red.originalNoise)}));
  EXPECT_EQ(texts(page, "//body/table[1]//td"),
            (std::vector<std::string>{"red", verdictText(red), "green", verdictText(comparison.channels[1]),
                                      "blue", verdictText(comparison.channels[2])}));
  EXPECT_EQ(texts(page, "//pre"), (std::vector<std::string>{subject.worst, subject.times}));
  EXPECT_EQ(page.select_nodes("//svg//circle[@r='3']").size(), 6u);
  EXPECT_TRUE(page.select_nodes("//img").empty());
  expectSelfContained(page);
}

TEST(ComparePage, SaysIfThereIsNoDifference) {
  const Answers ours = answersOf(6, 1, .0001);
  const CompareSubject subject = subjectOf();
  const Comparison comparison = compare(ours, ours, subject.tolerance, .001, true);
  const auto page = parsed(comparePage(ours, ours, comparison, subject, 0));
  EXPECT_EQ(page.select_nodes("//p[@class='banner good']").size(), 1u);
  EXPECT_EQ(page.select_nodes("//svg//circle[@r='2.5']").size(), 6u);
  EXPECT_EQ(page.select_nodes("//svg//circle[@r='3']").size(), 0u);
}

// Who is handed the page does not see the standard error of the program.
TEST(ComparePage, HasTheWarnings) {
  const Answers ours = answersOf(6, 1, .0001);
  CompareSubject subject = subjectOf();
  subject.warnings = {"a <cache>", "no light"};
  const Comparison comparison = compare(ours, ours, subject.tolerance, .001, true);
  const auto page = parsed(comparePage(ours, ours, comparison, subject, 0));
  EXPECT_EQ(texts(page, "//p[@class='banner open']"),
            (std::vector<std::string>{"Warning: a <cache>", "Warning: no light"}));
  EXPECT_EQ(warningsText(subject.warnings), "Warning: a <cache>\nWarning: no light\n");
}

TEST(ComparePage, HasPicturesOfRecordsThatFormOne) {
  const Answers ours = answersOf(6, 1.05, 0), original = answersOf(6, 1, 0);
  CompareSubject subject = subjectOf();
  subject.width = 3;
  subject.height = 2;
  const Comparison comparison = compare(ours, original, subject.tolerance, .001, true);
  const auto page = parsed(comparePage(ours, original, comparison, subject, 0));
  const auto pictures = page.select_nodes("//img");
  ASSERT_EQ(pictures.size(), 3u);
  // The first bytes of a PNG file.
  for (const auto& picture : pictures)
    EXPECT_EQ(
        std::string(picture.node().attribute("src").value()).rfind("data:image/png;base64,iVBORw0KGgo", 0),
        0u);
  EXPECT_STRNE(pictures[0].node().attribute("src").value(), pictures[1].node().attribute("src").value());
}

// A plot of many records has few marks, and the worst record among them.
TEST(ComparePlot, IsThinned) {
  Answers ours = answersOf(50000, 1, 0);
  const Answers original = ours;
  for (size_t r = 0; r < ours.repeats; ++r) ours.values[r * ours.records + 12345] *= 2;
  const Comparison comparison = compare(ours, original, .01, .001, true);
  const auto svg = parsed(comparePlot(ours, original, comparison, subjectOf()));
  EXPECT_EQ(svg.select_nodes("//circle[@r='2.5' or @r='3']").size(), kMostMarks);
  EXPECT_EQ(texts(svg, "//circle/title"), std::vector<std::string>{"record 12346: +66.7%"});
}

TEST(ComparePlot, BlackRecordsAreCounted) {
  Answers ours = answersOf(3, 1, 0);
  for (size_t r = 0; r < ours.repeats; ++r) ours.values[r * ours.records] = Color(0, 0, 0);
  const Comparison comparison = compare(ours, ours, .01, .001, true);
  const std::string svg = comparePlot(ours, ours, comparison, subjectOf());
  EXPECT_NE(svg.find("3 records, 1 of them black"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  Answers dark{2, 2, std::vector<Color>(4, Color(0, 0, 0))};
  EXPECT_NE(comparePlot(dark, dark, compare(dark, dark, .01, .001, true), subjectOf()).find("none to draw"),
            std::string::npos);
}

}  // namespace
}  // namespace rsphere
