#include <gtest/gtest-spi.h>

#include "tests/unit/support/command_line.h"
#include "tests/unit/support/manual_of.h"

namespace rsphere {
namespace {

TEST(Manual, IsTheGeneratedOne) {
  manual::expectPage("rsphere",
                     {{"OPTIONS", manual::optionsOfRsphere()}, {"QUANTITIES", manual::quantities()}});
}

// The text must contain nothing that man(7) takes for a macro.
TEST(Manual, OptionsAreCleanText) {
  const std::string text = manual::optionsOfRsphere();
  EXPECT_EQ(text.find("\n'"), std::string::npos);
  for (size_t at = text.find("\n."); at != std::string::npos; at = text.find("\n.", at + 1)) {
    const std::string macro = text.substr(at + 2, 2);
    EXPECT_TRUE(macro == "TP" || macro == "BI" || macro == "SS" || macro == "IP") << macro;
  }
  for (const OptionEntry& entry : optionTable())
    EXPECT_NE(text.find(".BI \\" + std::string(entry.name)), std::string::npos) << entry.name;
}

TEST(Manual, OptionsAndParagraphsBelongTogether) {
  static const std::map<std::string, std::string> kNone, kOne{{"-zz", "Text."}};
  EXPECT_NONFATAL_FAILURE(manual::OptionTexts(kNone).of(optionTable().front(), ""), "-w needs a paragraph");
  EXPECT_NONFATAL_FAILURE(manual::OptionTexts{kOne}, "there is no option -zz");
}

}  // namespace
}  // namespace rsphere
