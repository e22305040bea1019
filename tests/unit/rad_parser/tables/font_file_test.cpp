#include "rad_parser/tables/font_file.h"

#include <gtest/gtest.h>

#include <string>

#include "rad_parser/error.h"

namespace rad::font_file_test {
namespace {

std::string errorOf(const std::string& text) {
  try {
    FontFile::parse(text, "f.fnt");
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

// 'a' is a frame with a seam to its hole, 'b' a triangle, ' ' a space.
const char* const kFont =
    "# test\n32 0\n"
    "97 10  20 20 220 20 220 220 20 220 20 20  60 60 60 180 180 180 180 60 60 60\n"
    "98 3  50 0 250 0 250 200\n";

TEST(FontFile, GlyphsAndTheirBoxes) {
  const FontFile font = FontFile::parse(kFont, "f.fnt");
  ASSERT_NE(font.glyph('a'), nullptr);
  EXPECT_EQ(font.glyph('c'), nullptr);
  EXPECT_TRUE(font.glyph(' ')->vertices.empty());
  EXPECT_EQ(font.glyph('b')->left, 50);
  EXPECT_EQ(font.glyph('b')->top, 200);
  EXPECT_EQ(font.meanWidth(), 200);
}

TEST(FontFile, InsideByTheEvenOddRule) {
  const FontFile font = FontFile::parse(kFont, "f.fnt");
  const Glyph& frame = *font.glyph('a');
  const Glyph& triangle = *font.glyph('b');
  for (double x = .25; x < 255; x += 3) {
    for (double y = .75; y < 255; y += 3) {  // no point is on the seam itself
      const bool outer = x > 20 && x < 220 && y > 20 && y < 220;
      const bool hole = x > 60 && x < 180 && y > 60 && y < 180;
      EXPECT_EQ(frame.covers(x, y), outer && !hole) << x << " " << y;
      EXPECT_EQ(triangle.covers(x, y), x > 50 && x < 250 && y < x - 50) << x << " " << y;
    }
  }
  EXPECT_FALSE(font.glyph(' ')->covers(100, 100));
}

TEST(FontFile, ErrorsHaveTheirPlace) {
  EXPECT_EQ(errorOf("\n0 3"), "f.fnt:2: expected a character's code from 1 to 255, got \"0\"");
  EXPECT_EQ(errorOf("65 1\n1 x"), "f.fnt:2: expected a coordinate from 0 to 255, got \"x\"");
  EXPECT_EQ(errorOf("65 1\n1 256"), "f.fnt:2: expected a coordinate from 0 to 255, got \"256\"");
  EXPECT_EQ(errorOf("65 33000"), "f.fnt:1: expected a number of vertices up to 32000, got \"33000\"");
  EXPECT_EQ(errorOf("65 2 1 1"), "f.fnt:1: expected a coordinate from 0 to 255, got the end of the file");
  EXPECT_EQ(errorOf("65 0\n65 0"), "f.fnt:2: character 65 occurs twice");
  EXPECT_EQ(errorOf(""), "no error");
}

// The points of a grid that the text covers: a row of '#' and '.' for each line of points.
std::string drawing(const TextLayout& layout, double width, int columns, double height, int rows) {
  std::string out;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      out += layout.covers((i + .5) * width / columns, (j + .5) * height / rows) ? '#' : '.';
    }
    out += '\n';
  }
  return out;
}

TEST(TextLayout, CharactersOfOneWidth) {
  const FontFile font =
      FontFile::parse("1 4 0 0 255 0 255 255 0 255\n2 0\n3 4 0 0 255 0 255 128 0 128", "f.fnt");
  const std::string lines[] = {"\1\2\1x\3", "", "\3"};
  const TextLayout layout(font, lines, {});
  EXPECT_EQ(drawing(layout, 6, 12, 4, 8),
            "##..##......\n"
            "##..####....\n"
            "............\n"
            "............\n"
            "............\n"
            "##..........\n"
            "............\n"
            "............\n");
  EXPECT_FALSE(layout.covers(-.1, .5));
  EXPECT_FALSE(layout.covers(.5, -.1));
}

// In the text with narrow spacing, characters are as wide as their glyphs. Sizes are given in
// mean widths and spacings.
TEST(TextLayout, Squeezed) {
  // One glyph is 100 wide and one 200, so the mean is 150. A spacing of 50 is before and between them.
  const FontFile font =
      FontFile::parse("1 4 100 0 200 0 200 255 100 255\n2 4 10 0 210 0 210 255 10 255\n3 0\n", "f.fnt");
  const std::string lines[] = {"\1\2\3\1"};
  const TextLayout layout(font, lines, -50.5 / 255);
  const double unit = 150 + 50.5;
  const auto covers = [&](double steps) { return layout.covers(steps / unit, .5); };
  EXPECT_FALSE(covers(49));
  EXPECT_TRUE(covers(51));
  EXPECT_TRUE(covers(149));
  EXPECT_FALSE(covers(151));
  EXPECT_FALSE(covers(199));
  EXPECT_TRUE(covers(201));
  EXPECT_TRUE(covers(399));
  EXPECT_FALSE(covers(401));
  // A space is as wide as the mean, with half the spacing before and after it.
  EXPECT_FALSE(covers(599));
  EXPECT_TRUE(covers(601));
  EXPECT_TRUE(covers(699));
  EXPECT_FALSE(covers(701));
}

// With proportional spacing, the words of all lines begin at the same places, whatever their glyphs are.
TEST(TextLayout, ProportionalColumnsKeepInLine) {
  const FontFile font =
      FontFile::parse("1 4 0 0 150 0 150 255 0 255\n2 4 0 0 250 0 250 255 0 255\n3 0\n", "f.fnt");
  const std::string lines[] = {"\1\1\3\3\3\3\2", "\2\2\3\3\3\3\2"};
  const TextLayout layout(font, lines, .2);
  const auto end = [&](int line) {
    double last = 0;
    for (double x = 0; x < 12; x += .001) {
      if (layout.covers(x, line + .5)) last = x;
    }
    return last;
  };
  EXPECT_NEAR(end(0), end(1), .01);
  EXPECT_GT(end(0), 6);
}

}  // namespace
}  // namespace rad::font_file_test
