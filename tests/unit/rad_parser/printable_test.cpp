#include "rad_parser/printable.h"

#include <gtest/gtest.h>

#include <string>

#include "rad_parser/error.h"

namespace rad {
namespace {

TEST(Printable, TextRemains) {
  for (const std::string text :
       {"", "room.rad:3", "Straße", "\xe6\x9c\xba", "\xf0\x9f\x92\xa1", "a\\b \"c\""})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, ControlCharactersAreEscaped) {
  EXPECT_EQ(printable("a\x1b[31m\a\n\r\t\x7f"), "a\\x1b[31m\\x07\\x0a\\x0d\\x09\\x7f");
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\xc2\\x9b31m")
      << "C1 in UTF-8 begins a command, too";
  EXPECT_EQ(printable("\xe2\x80\xae\xe2\x80\xa8"), "\\xe2\\x80\\xae\\xe2\\x80\\xa8") << "direction, line";
}

TEST(Printable, WhatIsNotUtf8IsEscaped) {
  EXPECT_EQ(printable("\x9b\xff\xc3"), "\\x9b\\xff\\xc3");
  EXPECT_EQ(printable("\xc0\x9b\xe0\x82\x9b"), "\\xc0\\x9b\\xe0\\x82\\x9b") << "longer than necessary";
  EXPECT_EQ(printable("\xed\xa0\x80\xf4\x90\x80\x80"), "\\xed\\xa0\\x80\\xf4\\x90\\x80\\x80")
      << "no characters";
  EXPECT_EQ(printable("\xe6\x9c"), "\\xe6\\x9c") << "cut";
}

TEST(Printable, LongTextEndsWithDots) {
  EXPECT_EQ(printable("12345", 5), "12345");
  EXPECT_EQ(printable("123456", 5), "12345...");
  EXPECT_EQ(printable("123\xc3\x9f", 4), "123...") << "no half characters";
  EXPECT_EQ(printable("123\x1b", 5), "123...") << "no half escapes";
}

TEST(Printable, ANameOfAMissingFileKeepsBothEnds) {
  EXPECT_EQ(printableName("scenes/room\n.rad"), "scenes/room\\x0a.rad");
  const std::string name = printableName("/home/" + std::string(200, 'x') + "/room.rad");
  EXPECT_LE(name.size(), 80u);
  EXPECT_EQ(name.substr(0, 7), "/home/x");
  EXPECT_EQ(name.substr(name.size() - 10), "x/room.rad");
  EXPECT_NE(name.find("x...x"), std::string::npos);
  EXPECT_EQ(messageLine(name), name) << "the same when it passes again";
}

TEST(Printable, AMessageKeepsBothEndsOfALongWord) {
  const std::string word = "begin" + std::string(600, 'x') + "end:3:";
  const std::string line = messageLine(word + " no such modifier");
  EXPECT_EQ(line.substr(0, 6), "beginx");
  EXPECT_NE(line.find("x...x"), std::string::npos);
  EXPECT_EQ(line.substr(line.size() - 23), "end:3: no such modifier");
  EXPECT_LE(line.find(' '), 500u);
  EXPECT_EQ(messageLine(line), line) << "the same when it passes twice";
  const std::string half = "a" + std::string(600, '\xff');
  EXPECT_EQ(messageLine(messageLine(half)), messageLine(half));
  std::string many;
  for (int i = 0; i < 1000; ++i) many += "Straße ";
  EXPECT_LE(messageLine(many).size(), 4003u);
}

TEST(Printable, EveryErrorIs) {
  EXPECT_STREQ(Error("a\x1b[0m.rad:1: \xff").what(), "a\\x1b[0m.rad:1: \\xff");
}

}  // namespace
}  // namespace rad
