#pragma once
// Diagrams as SVG. In a separate file, a diagram is black on white. In a page (page.h) it has the page's
// colors, because the style sheet of the page overrides colors of elements by class.
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rsphere {

// The color of lines that accompany text. Pages replace it.
inline constexpr std::string_view kInk = "#333333";

struct PlotPoint {
  double x = 0, y = 0;
};

// Maps values from `low` to `high` (above 0) to pixels from `from` to `to`, logarithmically.
struct LogAxis {
  double low = 1, high = 10, from = 0, to = 1;
  double at(double value) const;
  // 3 to 12 round values; fewer if the ends are too close for 3 values of two digits.
  std::vector<double> ticks() const;
};

// The text beside an axis: a title, and values that are multiplied by `factor` and followed by `unit`.
struct AxisText {
  std::string title;
  double factor = 1;
  std::string unit = "";
};

// A plot with logarithmic axes.
class Plot {
 public:
  // The axes contain all values of `extent`, with a margin. sameScale: both axes have one range. REQUIRES:
  // extent is not empty, and its values are above 0 and finite.
  Plot(std::string title, std::span<const PlotPoint> extent, AxisText x, AxisText y, bool sameScale = false);

  // The ends of the x axis.
  double xLow() const { return x_.low; }
  double xHigh() const { return x_.high; }

  // Lines may extend beyond the plot; they are clipped. style: further attributes, such as
  // "stroke-dasharray".
  void line(std::span<const PlotPoint> points, std::string_view color, std::string_view style = {});
  // A disc. hint: text that a browser shows while the pointer is on it.
  void mark(const PlotPoint& at, double radius, std::string_view color, std::string_view hint = {});
  // A ring around a disc.
  void ring(const PlotPoint& at, std::string_view color);

  enum class Key { disc, ring, line };
  // style: of the line.
  void legend(Key key, std::string_view color, std::string text, std::string_view style = {});

  std::string svg() const;

 private:
  struct Entry {
    Key key;
    std::string color, text, style;
  };
  std::string title_;
  AxisText xText_, yText_;
  LogAxis x_, y_;
  std::string lines_, marks_;
  std::vector<Entry> legend_;
};

// A bar diagram, with bars one below the other: the text and the value of each.
struct Bar {
  std::string text;
  double value = 0;  // 0 or more
  std::string_view color;
};
std::string barsSvg(const std::string& title, std::span<const Bar> bars);

// Throws rad::Error if an option gives a file for a diagram a name with the extension of another format than
// SVG, because programs would open it in that format. what: the diagram, such as "the plot".
void requireSvgName(std::string_view option, const std::string& name, std::string_view what);

}  // namespace rsphere
