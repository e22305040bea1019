#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rad {

// A character of a font: a polygon on the grid of 0..255, x to the right, y up. Holes are cut by seams.
struct Glyph {
  struct Vertex {
    uint8_t x, y;
  };
  std::vector<Vertex> vertices;  // none: a space
  // The box around the vertices and the middle of the grid (128,128), as the original measures it.
  int left = 128, right = 128, bottom = 128, top = 128;

  // Whether (x,y) is inside, by the even-odd rule; edges are within half a grid step as the original decides
  // them. Requires x and y >= 0.
  bool covers(double x, double y) const;
};

// A polygon font (.fnt): for each character its code (1..255), the number of vertices and the vertices; '#'
// begins a comment. Source: RADIANCE file formats, "Font File Format".
class FontFile {
 public:
  // Throws Error "NAME:LINE: ..": no integer, a code that is out of range or occurs twice, too many vertices
  // (32000), a coordinate out of range.
  static FontFile parse(std::string_view text, std::string_view name);

  // Null for a character that the font does not have.
  const Glyph* glyph(unsigned char code) const { return glyphs_[code] ? &*glyphs_[code] : nullptr; }

  int meanWidth() const { return meanWidth_; }  // of the characters that have an area, in grid steps

 private:
  std::array<std::optional<Glyph>, 256> glyphs_;
  int meanWidth_ = 0;
};

// Lines of text set in a font: what brighttext, colortext and mixtext ask. Immutable.
class TextLayout {
 public:
  // spacing: the primitive's argument, in widths of a full character: positive spaces proportionally,
  // negative squeezes, zero or none gives every character the same width. font must outlive this. Source:
  // RADIANCE reference manual, "Brighttext", "Mixtext".
  TextLayout(const FontFile& font, std::span<const std::string> lines, std::optional<double> spacing);

  // Whether the text covers the point `right` widths of a character to the right of the text's origin and
  // `down` lines below it: the components of (P - A) along the primitive's motion vectors.
  bool covers(double right, double down) const;

 private:
  struct Line {
    std::string text;
    std::vector<int> advance;  // before the first character, and after each
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
