#include "markup.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>
#include <utility>

#include "rad_parser/error.h"
#include "tests/unit/support/markup_of.h"

namespace rsphere {
namespace {

TEST(Escaped, TextSurvivesTheParser) {
  const std::string odd = "a < b && \"c\" > 'd' ]]> <!-- --> </title>\n\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80";
  const auto document = parsed("<p t=\"" + escaped(odd) + "\">" + escaped(odd) + "</p>");
  EXPECT_EQ(document.first_child().text().get(), odd);
  std::string line = odd;
  line[line.find('\n')] = ' ';  // XML's rule for values of attributes
  EXPECT_EQ(document.first_child().attribute("t").value(), line);
}

TEST(Escaped, WhatIsNoTextIsReplaced) {
  const std::string mark = "\xef\xbf\xbd";
  EXPECT_EQ(escaped("\x01 \x7f\r"), mark + " " + mark + mark);
  EXPECT_EQ(escaped(std::string_view("\0", 1)), mark);
  EXPECT_EQ(escaped("\xe9t\xe9"), mark + "t" + mark);                 // Latin-1
  EXPECT_EQ(escaped("\xc0\xaf"), mark + mark);                        // overlong
  EXPECT_EQ(escaped("\xed\xa0\x80"), mark + mark + mark);             // a surrogate
  EXPECT_EQ(escaped("\xf4\x90\x80\x80"), mark + mark + mark + mark);  // above U+10FFFF
  EXPECT_EQ(escaped("\xe2\x82<"), mark + mark + "&lt;");              // cut off
  EXPECT_EQ(escaped("\xef\xbf\xbf"), mark + mark + mark);             // U+FFFF
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
