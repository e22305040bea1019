#include "companions/report/markup.h"

#include <gtest/gtest.h>

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

// RFC 4648, section 10.
TEST(PngUri, IsBase64) {
  const std::string start = "data:image/png;base64,";
  EXPECT_EQ(pngUri(""), start);
  EXPECT_EQ(pngUri("f"), start + "Zg==");
  EXPECT_EQ(pngUri("fo"), start + "Zm8=");
  EXPECT_EQ(pngUri("foo"), start + "Zm9v");
  EXPECT_EQ(pngUri("foobar"), start + "Zm9vYmFy");
  EXPECT_EQ(pngUri("\xfb\xff\xbf"), start + "+/+/");
}

TEST(ShellLine, QuotesEachWord) {
  EXPECT_EQ(shellLine({}), "");
  const std::vector<std::string> words{"rsphere", "-t", "", "a b"};
  EXPECT_EQ(shellLine(words), "rsphere -t '' 'a b'");
}

TEST(ShellWord, IsOneWord) {
  EXPECT_EQ(shellWord("-Sn"), "-Sn");
  EXPECT_EQ(shellWord("../a_b/room.oct"), "../a_b/room.oct");
  EXPECT_EQ(shellWord(""), "''");
  EXPECT_EQ(shellWord("a b"), "'a b'");
  EXPECT_EQ(shellWord("a<b&$c"), "'a<b&$c'");
  EXPECT_EQ(shellWord("it's"), "'it'\\''s'");
}

}  // namespace
}  // namespace rsphere
