#include "tests/unit/support/command_line.h"

namespace rsphere {
namespace {

// man/rsphere.1 is the template man/rsphere.1.in, into which the options and the quantities of points are
// inserted. After a change of the template or a table, copy the file that this test writes to the build
// folder.
TEST(Manual, IsTheGeneratedOne) {
  const std::string folder = std::string(RSPHERE_TESTS) + "/../man/";
  std::string text = contents(folder + "rsphere.1.in");
  for (const auto& [mark, generated] :
       {std::pair<std::string, std::string>{".\\\" @OPTIONS@\n", manualText()},
        {".\\\" @QUANTITIES@\n", quantitiesText()}}) {
    const size_t at = text.find(mark);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, mark.size(), generated);
  }
  if (contents(folder + "rsphere.1") == text) return;
  std::ofstream("rsphere.1", std::ios::binary) << text;
  FAIL() << "differs from rsphere.1 in the folder of this test";
}

// The text must contain nothing that man(7) takes for a macro.
TEST(Manual, OptionsAreCleanText) {
  const std::string text = manualText();
  EXPECT_EQ(text.find("\n'"), std::string::npos);
  for (size_t at = text.find("\n."); at != std::string::npos; at = text.find("\n.", at + 1)) {
    const std::string macro = text.substr(at + 2, 2);
    EXPECT_TRUE(macro == "TP" || macro == "BI" || macro == "SS") << macro;
  }
  for (const OptionEntry& entry : optionTable())
    EXPECT_NE(text.find(".BI \\" + std::string(entry.name)), std::string::npos) << entry.name;
}

}  // namespace
}  // namespace rsphere
