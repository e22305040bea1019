#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rad {

// A character of a font: a polygon on a grid from 0 to 255, with x to the right and y upwards. Holes are
// connected to the outline by seams.
struct Glyph {
  struct Vertex {
    uint8_t x, y;
  };
  std::vector<Vertex> vertices;  // empty: a space
  // The bounding box of the vertices and of the middle of the grid (128,128), as in RADIANCE.
  int left = 128, right = 128, bottom = 128, top = 128;

  // Whether (x,y) is inside, by the even-odd rule. As in RADIANCE, edges are accurate to half a grid
  // step. Requires x and y >= 0.
  bool covers(double x, double y) const;
};

// A polygon font (.fnt). For each character the file contains its code (1 to 255), the number of its
// vertices, and the vertices; '#' begins a comment. Source: RADIANCE file formats, "Font File Format".
class FontFile {
 public:
  // Throws Error "NAME:LINE: .." for a word that is not an integer, a code that is out of range or repeated,
  // more than 32000 vertices, and a coordinate out of range.
  static FontFile parse(std::string_view text, std::string_view name);

  // Null if the font lacks the character.
  const Glyph* glyph(unsigned char code) const { return glyphs_[code] ? &*glyphs_[code] : nullptr; }

  int meanWidth() const { return meanWidth_; }  // mean over characters with an area, in grid steps

 private:
  std::array<std::optional<Glyph>, 256> glyphs_;
  int meanWidth_ = 0;
};

// Lines of text in a font, for brighttext, colortext and mixtext. Immutable.
class TextLayout {
 public:
  // spacing: the primitive's argument, in widths of a full character. Positive values select proportional
  // spacing, negative values narrow spacing; with 0 or no value, all characters have equal widths. The font
  // must outlive this object. Source: RADIANCE reference manual, "Brighttext", "Mixtext".
  TextLayout(const FontFile& font, std::span<const std::string> lines, std::optional<double> spacing);

  // Whether the text covers the point that is `right` character widths to the right of the text's origin and
  // `down` lines below it. These are the components of (P - A) along the primitive's motion vectors.
  bool covers(double right, double down) const;

 private:
  struct Line {
    std::string text;
    std::vector<int> advance;  // grid steps before the first character and after each
    int width = 0;
  };

  void spaceEvenly(Line& line) const;
  void squeeze(Line& line, int spacing) const;
  void spaceProportionally(Line& line, int spacing) const;
  const Glyph* glyph(const Line& line, size_t i) const;

  const FontFile& font_;
  std::vector<Line> lines_;
  double stepsPerWidth_;
};

}  // namespace rad
