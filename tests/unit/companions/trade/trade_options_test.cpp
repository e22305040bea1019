#include "companions/trade/trade_options.h"

#include <gtest/gtest.h>

#include <fstream>

#include "companions/trade/ladder.h"
#include "companions/trade/trade_report.h"
#include "rad_parser/error.h"
#include "tests/unit/support/manual_of.h"

namespace rsphere {
namespace {

TradeOptions parse(std::vector<std::string> words) {
  words.insert(words.begin(), "rsphere-trade");
  TradeOptions options;
  parseCompanion(words, tradeCompanion(), options);
  return options;
}

TEST(TradeOptions, ManualIsTheGeneratedOne) {
  TradeOptions defaults;
  manual::expectPage("rsphere-trade",
                     {{"OPTIONS", manual::optionsOf(tradeCompanion(), "rsphere-trade", defaults)}});
}

TEST(TradeOptions, AreTheirOwn) {
  for (const OptionEntry& entry : tradeCompanion().own) {
    EXPECT_EQ(entry.name.substr(0, 2), "-T");
    EXPECT_FALSE(entry.remark.empty()) << entry.name;
    for (const OptionEntry& other : optionTable()) EXPECT_NE(entry.name, other.name);
  }
}

// Each of the default settings is a valid command line of rsphere.
TEST(Ladder, IsMadeOfOptions) {
  const TradeOptions options = parse({"-ab", "2", "-Tb", "scene", "points"});
  EXPECT_TRUE(options.bounces);
  auto settings = ladder(options);
  EXPECT_GT(settings.size(), 15u);
  settings.push_back(referenceWords(true));
  for (auto words : settings) {
    words.insert(words.begin(), "rsphere");
    words.push_back("scene");
    EXPECT_NO_THROW(parseOptions(words));
  }
}

TEST(Ladder, LeavesIndirectLightAloneWhereThereIsNone) {
  for (const auto& words : ladder(parse({"-ab", "0", "scene", "points"})))
    for (const std::string& word : words) EXPECT_TRUE(word != "-ad" && word != "-ab");
}

TEST(Ladder, HasFewerBouncesBesidesThoseOfAFile) {
  const std::string file = testing::TempDir() + "ladder";
  std::ofstream(file) << "-Sn 100\n# a comment\n-Sn 200 -ab 1\n";
  using Settings = std::vector<std::vector<std::string>>;
  EXPECT_EQ(ladder(parse({"-Tl", file, "-ab", "2", "scene", "points"})),
            (Settings{{"-Sn", "100"}, {"-Sn", "200", "-ab", "1"}}));
  const Settings with = ladder(parse({"-Tl", file, "-Tb", "-ab", "2", "scene", "points"}));
  ASSERT_EQ(with.size(), 4u);
  for (size_t bounces = 0; bounces < 2; ++bounces) {
    EXPECT_EQ(with[2 + bounces].end()[-2], "-ab");
    EXPECT_EQ(with[2 + bounces].back(), std::to_string(bounces));
  }
}

TEST(Ladder, SaysWhatIsWrongWithAFile) {
  EXPECT_THROW(ladder(parse({"-Tl", "/nowhere/ladder", "scene", "points"})), rad::Error);
  EXPECT_THROW(ladder(parse({"-Tl", "/dev/null", "scene", "points"})), rad::Error);
}

TEST(Plot, HasAMarkForEachSetting) {
  std::vector<Figures> all(3);
  for (size_t i = 0; i < 3; ++i) {
    all[i].words = {"-Sw", i == 0 ? "h" : "c", "<&"};
    all[i].seconds = .001 * static_cast<double>(i + 1);
    all[i].rms = .01 / static_cast<double>(i + 1);
  }
  all[2].rms = 0;  // is omitted from the plot
  markBest(all);
  TradeSubject subject;
  subject.scene = "a & b";
  subject.accuracy = .01;
  const std::string svg = tradePlot(all, subject);
  size_t marks = 0;
  for (size_t at = svg.find("<title>"); at != std::string::npos; at = svg.find("<title>", at + 1)) ++marks;
  EXPECT_EQ(marks, 2u);
  EXPECT_NE(svg.find("a &amp; b"), std::string::npos);
  EXPECT_NE(svg.find("&lt;&amp;"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_NE(tradePlot({}, subject).find("</svg>"), std::string::npos);
}

}  // namespace
}  // namespace rsphere
