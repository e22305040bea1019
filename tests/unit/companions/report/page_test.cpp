#include "companions/report/page.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>

#include "rad_parser/error.h"
#include "tests/unit/support/markup_of.h"

namespace rsphere {
namespace {

const std::string kOdd = "a<b>&\"c\"'</pre></td><script>alert(1)</script>";

TEST(Page, ShowsAllTextAsGiven) {
  Page page(kOdd, kOdd);
  page.heading(kOdd);
  page.note(kOdd);
  page.banner(Tone::bad, kOdd);
  page.command(kOdd);
  page.lines(kOdd);
  page.facts({{kOdd, kOdd}});
  PageTable table;
  table.head = {kOdd, "n"};
  table.rows = {{{kOdd, "1"}, false}, {{"chosen", "2"}, true}};
  page.table(table);
  page.foldedTable(kOdd, table);
  page.figure("<svg/>", kOdd);
  const std::array pictures = {PagePicture{"bytes", kOdd}};
  page.pictures(pictures);
  const auto html = parsed(page.html());
  for (const char* path : {"//title", "//h1", "//h2", "//p[@class='note']", "//p[@class='above']",
                           "//p[@class='banner bad']", "//pre[@class='command']", "//pre[not(@class)]",
                           "//table[@class='facts']//td[1]", "//table[@class='facts']//td[2]", "//summary",
                           "//body/div//th[@class='text']", "//body/div//tr[not(@class)]/td[1]",
                           "//body/figure/figcaption", "//div[@class='pictures']//figcaption"}) {
    const auto found = texts(html, path);
    ASSERT_EQ(found.size(), 1u) << path;
    EXPECT_EQ(found[0], kOdd) << path;
  }
  EXPECT_EQ(texts(html, "//body/div//tr[@class='chosen']/td"), (std::vector<std::string>{"chosen", "2"}));
  EXPECT_STREQ(html.select_node("//img").node().attribute("alt").value(), kOdd.c_str());
  expectSelfContained(html);
}

// A line of the table may break between options, not between an option and its value.
TEST(Page, OptionsInATableStayWhole) {
  Page page("title", "above");
  PageTable table;
  table.head = {"", "n", ""};
  table.rows = {{{"-Sw c -Sn 512 <x>", "-1", "not -1"}, false}};
  page.table(table);
  table.lastIsText = true;
  page.table(table);
  const auto html = parsed(page.html());
  EXPECT_EQ(texts(html, "//div[1]//td"), (std::vector<std::string>{"-Sw c -Sn 512 <x>", "-1", "not -1"}));
  EXPECT_EQ(texts(html, "//div[1]//span"), (std::vector<std::string>{"-Sw c", "-Sn 512 <x>"}));
  EXPECT_EQ(texts(html, "//div[1]//td[@class='text']").size(), 1u);
  EXPECT_EQ(texts(html, "//div[2]//td[@class='text']"),
            (std::vector<std::string>{"-Sw c -Sn 512 <x>", "not -1"}));
}

TEST(TextFile, SaysWhatCannotBeWritten) {
  const auto write = [](const std::string& name) { writeTextFile(name, "text"); };
  for (const auto& attempt : {std::function<void(const std::string&)>(write), {requireWritable}})
    for (const auto& [name, why] : {std::pair{"/nowhere/page.html", "No such file or directory"},
                                    {"/dev/null/page.html", "Not a directory"},
                                    {"/", "Is a directory"}})
      try {
        attempt(name);
        ADD_FAILURE() << name;
      } catch (const rad::Error& error) {
        EXPECT_EQ(error.status(), rad::Status::system);
        EXPECT_EQ(error.what(), fmt::format("cannot write \"{}\": {}", name, why));
      }
}

TEST(TextFile, IsNotChangedBeforeItIsWritten) {
  const std::string name = testing::TempDir() + "page_test.txt";
  std::filesystem::remove(name);
  requireWritable(name);
  EXPECT_FALSE(std::filesystem::exists(name));
  writeTextFile(name, "text");
  requireWritable(name);
  EXPECT_EQ(std::filesystem::file_size(name), 4U);
  requireWritable("");
}

}  // namespace
}  // namespace rsphere
