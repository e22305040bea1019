#include "rad_parser/tables/font_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rad_parser/tables/number_list.h"

namespace rad {

bool Glyph::covers(double x, double y) const {
  // Which edges count is decided at the middle of the point's grid cell, because no vertex lies there.
  const double column = std::floor(x) + .5, row = std::floor(y) + .5;
  if (!(column > left && column < right && row > bottom && row < top)) return false;
  bool inside = false;
  for (size_t i = 0, before = vertices.size() - 1; i < vertices.size(); before = i++) {
    const Vertex a = vertices[before], b = vertices[i];
    if ((a.y > row) == (b.y > row)) continue;
    const bool aRight = a.x > column, bRight = b.x > column;
    if (aRight && bRight) {
      inside = !inside;
    } else if (aRight || bRight) {
      // Whether the edge passes on the right of the exact point.
      const bool leftOf = (a.y - y) * (b.x - x) > (a.x - x) * (b.y - y);
      if (leftOf != (b.y > a.y)) inside = !inside;
    }
  }
  return inside;
}

FontFile FontFile::parse(std::string_view text, std::string_view name) {
  NumberList numbers(text, name);
  FontFile font;
  int widths = 0, count = 0;
  while (!numbers.atEnd()) {
    const auto code = static_cast<size_t>(numbers.integer("a character's code from 1 to 255", 1, 255));
    if (font.glyphs_[code]) numbers.fail(fmt::format("character {} occurs twice", code));
    Glyph& glyph = font.glyphs_[code].emplace();
    const auto vertices = static_cast<size_t>(numbers.integer("a number of vertices up to 32000", 0, 32000));
    for (size_t i = 0; i < vertices; ++i) {
      const auto x = static_cast<int>(numbers.integer("a coordinate from 0 to 255", 0, 255));
      const auto y = static_cast<int>(numbers.integer("a coordinate from 0 to 255", 0, 255));
      glyph.vertices.push_back({static_cast<uint8_t>(x), static_cast<uint8_t>(y)});
      glyph.left = std::min(glyph.left, x);
      glyph.right = std::max(glyph.right, x);
      glyph.bottom = std::min(glyph.bottom, y);
      glyph.top = std::max(glyph.top, y);
    }
    if (glyph.right > glyph.left && glyph.top > glyph.bottom) {
      widths += glyph.right - glyph.left;
      ++count;
    }
  }
  if (count > 0) font.meanWidth_ = widths / count;
  return font;
}

TextLayout::TextLayout(const FontFile& font, std::span<const std::string> lines,
                       std::optional<double> spacing)
    : font_(font), stepsPerWidth_(spacing ? font.meanWidth() + 255 * std::abs(*spacing) : 255) {
  const int steps = static_cast<int>(std::clamp(spacing.value_or(0) * 255, -1e6, 1e6));
  for (const std::string& text : lines) {
    Line line;
    line.text = text;
    if (steps > 0) {
      spaceProportionally(line, steps);
    } else if (steps < 0) {
      squeeze(line, -steps);
    } else {
      spaceEvenly(line);
    }
    for (int advance : line.advance) line.width += advance;
    lines_.push_back(std::move(line));
  }
}

const Glyph* TextLayout::glyph(const Line& line, size_t i) const {
  return i < line.text.size() ? font_.glyph(static_cast<unsigned char>(line.text[i])) : nullptr;
}

void TextLayout::spaceEvenly(Line& line) const {
  line.advance.push_back(0);
  for (size_t i = 0; i < line.text.size(); ++i) line.advance.push_back(glyph(line, i) != nullptr ? 255 : 0);
}

// Each character is as wide as its glyph, with half the spacing on either side.
void TextLayout::squeeze(Line& line, int spacing) const {
  const int half = spacing / 2;
  line.advance.assign(line.text.size() + 1, 0);
  size_t last = 0;  // index of the advance after the last character that exists in the font
  while (last < line.text.size() && glyph(line, last) == nullptr) ++last;
  line.advance[last] = half;
  for (size_t i = last; i < line.text.size(); ++i) {
    const Glyph* g = glyph(line, i);
    if (g == nullptr) continue;  // it takes no space, so that its neighbours are adjacent
    if (g->vertices.empty()) {
      line.advance[i + 1] = font_.meanWidth();
    } else {
      line.advance[i] += half - g->left;
      line.advance[i + 1] = g->right + half;
    }
  }
  line.advance.back() += half;
}

// Squeezes the line, then stretches each word, together with the blanks after it, to as many mean widths as
// it has characters. Columns of words are therefore aligned if more than three blanks separate them.
void TextLayout::spaceProportionally(Line& line, int spacing) const {
  constexpr size_t column = 3;
  squeeze(line, spacing);
  size_t begin = 0;
  while (begin < line.text.size()) {
    size_t end = begin, characters = 0;
    int room = 0;
    while (end < line.text.size()) {
      const size_t from = end++;
      room += line.advance[end];
      if (glyph(line, from) != nullptr) {
        for (const Glyph* g = glyph(line, end); g != nullptr && g->vertices.empty(); g = glyph(line, end))
          room += line.advance[++end];
        characters += end - from;
      }
      if (end - from > column) break;
    }
    int missing = static_cast<int>(characters) * (font_.meanWidth() + spacing) - room;
    for (size_t i = begin; i < end; ++i) {
      const int share = missing / static_cast<int>(end - i);
      line.advance[i + 1] += share;
      missing -= share;
    }
    begin = end;
  }
}

bool TextLayout::covers(double right, double down) const {
  if (!(right >= 0 && down >= 0 && down < static_cast<double>(lines_.size()))) return false;
  const Line& line = lines_[static_cast<size_t>(down)];
  const double x = right * stepsPerWidth_;
  if (!(x < line.width)) return false;
  const double y = (std::floor(down) + 1 - down) * 255;
  const double fraction = x - std::floor(x);
  int offset = static_cast<int>(x);
  for (size_t i = 0; i < line.text.size(); ++i) {
    offset -= line.advance[i];
    if (offset < 0) return false;
    const Glyph* g = glyph(line, i);
    if (offset < 255 && g != nullptr && g->covers(offset + fraction, y)) return true;
  }
  return false;
}

}  // namespace rad
