#include "companions/report/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "companions/report/markup.h"
#include "rad_parser/error.h"

namespace rsphere {
namespace {

// In units of the viewBox.
constexpr double kWidth = 720, kPlotHeight = 385, kLeft = 74, kRight = 20, kTitleHeight = 36, kBelow = 56;
constexpr double kRow = 18;  // of a legend
constexpr double kTop = kTitleHeight, kBottom = kTop + kPlotHeight;
// Factor by which the axes extend beyond the values.
constexpr double kMargin = 1.3;

std::string start(double height, const std::string& title) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" role=\"img\" "
      "aria-label=\"{2}\" font-family=\"sans-serif\" font-size=\"12\">\n"
      "<rect class=\"paper\" width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n"
      "<text x=\"12\" y=\"22\" font-size=\"14\" font-weight=\"bold\">{2}</text>\n",
      kWidth, height, escaped(title));
}

std::string_view lineClass(std::string_view color) { return color == kInk ? "line ink" : "line"; }

LogAxis axisOf(std::span<const PlotPoint> extent, double PlotPoint::*value, double from, double to) {
  double low = extent.front().*value, high = low;
  for (const PlotPoint& p : extent) {
    low = std::min(low, p.*value);
    high = std::max(high, p.*value);
  }
  return {low / kMargin, high * kMargin, from, to};
}

std::vector<double> multiples(double step, double low, double high) {
  std::vector<double> found;
  for (double k = std::ceil(low / step); k * step <= high; ++k) found.push_back(k * step);
  return found;
}

}  // namespace

double LogAxis::at(double value) const {
  return from + (to - from) * std::log(value / low) / std::log(high / low);
}

std::vector<double> LogAxis::ticks() const {
  constexpr size_t kFewest = 3, kMost = 12;
  const int first = static_cast<int>(std::floor(std::log10(low))),
            last = static_cast<int>(std::ceil(std::log10(high)));
  // Every power of ten; if there are many, every second, third and so on.
  const int step = 1 + (last - first) / static_cast<int>(kMost);
  const auto ticksWith = [&](std::span<const double> digits) {
    std::vector<double> found;
    for (int power = first; power <= last; ++power) {
      if (step > 1 && power % step != 0) continue;
      for (const double digit : digits)
        if (const double x = digit * std::pow(10., power); x >= low && x <= high) found.push_back(x);
    }
    return found;
  };
  constexpr std::array kCoarse = {1.};
  constexpr std::array kUsual = {1., 2., 5.};
  constexpr std::array kFine = {1., 2., 3., 4., 5., 6., 7., 8., 9.};
  if (step > 1) return ticksWith(kCoarse);
  std::vector<double> best = ticksWith(kUsual);
  if (best.size() > kMost) return ticksWith(kCoarse);
  if (best.size() < kFewest) best = ticksWith(kFine);
  // For ranges below a factor of about 2: even steps, which are nearly even on the logarithmic axis.
  for (int power = last; best.size() < kFewest; --power)
    for (const double digit : {5., 2., 1.})
      if (best.size() < kFewest) best = multiples(digit * std::pow(10., power), low, high);
  return best;
}

Plot::Plot(std::string title, std::span<const PlotPoint> extent, AxisText x, AxisText y, bool sameScale)
    : title_(std::move(title)),
      xText_(std::move(x)),
      yText_(std::move(y)),
      x_(axisOf(extent, &PlotPoint::x, kLeft, kWidth - kRight)),
      y_(axisOf(extent, &PlotPoint::y, kBottom, kTop)) {
  if (!sameScale) return;
  x_.low = y_.low = std::min(x_.low, y_.low);
  x_.high = y_.high = std::max(x_.high, y_.high);
}

void Plot::line(std::span<const PlotPoint> points, std::string_view color, std::string_view style) {
  if (points.empty()) return;
  lines_ += "<path d=\"";
  for (size_t i = 0; i < points.size(); ++i)
    lines_ += fmt::format("{}{:.1f} {:.1f}", i == 0 ? "M" : "L", x_.at(points[i].x), y_.at(points[i].y));
  lines_ += fmt::format("\" fill=\"none\" class=\"{}\" stroke=\"{}\"{}{}/>\n", lineClass(color), color,
                        style.empty() ? "" : " ", style);
}

void Plot::mark(const PlotPoint& at, double radius, std::string_view color, std::string_view hint) {
  marks_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"", x_.at(at.x), y_.at(at.y),
                        radius, color);
  marks_ += hint.empty() ? "/>\n" : fmt::format("><title>{}</title></circle>\n", escaped(hint));
}

void Plot::ring(const PlotPoint& at, std::string_view color) {
  marks_ += fmt::format(
      "<circle class=\"ring\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"10\" fill=\"none\" stroke=\"{}\" "
      "stroke-width=\"3\"/>\n",
      x_.at(at.x), y_.at(at.y), color);
}

void Plot::legend(Key key, std::string_view color, std::string text, std::string_view style) {
  legend_.push_back({key, std::string(color), std::move(text), std::string(style)});
}

std::string Plot::svg() const {
  const double legendTop = kBottom + kBelow,
               height = legendTop + kRow * static_cast<double>((legend_.size() + 1) / 2) + 6;
  std::string svg = start(height, title_);
  for (const double tick : x_.ticks())
    svg += fmt::format(
        "<path class=\"grid\" d=\"M{0:.1f} {1}V{2}\" stroke=\"#ddd\"/><text class=\"tick-x\" x=\"{0:.1f}\" "
        "y=\"{3}\" text-anchor=\"middle\">{4:g}{5}</text>\n",
        x_.at(tick), kTop, kBottom, kBottom + 18, xText_.factor * tick, escaped(xText_.unit));
  for (const double tick : y_.ticks())
    svg += fmt::format(
        "<path class=\"grid\" d=\"M{0} {1:.1f}H{2}\" stroke=\"#ddd\"/><text class=\"tick-y\" x=\"{3}\" "
        "y=\"{4:.1f}\" text-anchor=\"end\">{5:g}{6}</text>\n",
        kLeft, y_.at(tick), kWidth - kRight, kLeft - 6, y_.at(tick) + 4, yText_.factor * tick,
        escaped(yText_.unit));
  svg += fmt::format("<path class=\"frame\" d=\"M{0} {1}V{2}H{3}\" fill=\"none\" stroke=\"#777\"/>\n", kLeft,
                     kTop, kBottom, kWidth - kRight);
  svg += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n",
                     (kLeft + kWidth - kRight) / 2, kBottom + 38, escaped(xText_.title));
  svg += fmt::format("<text transform=\"translate(16 {}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                     (kTop + kBottom) / 2, escaped(yText_.title));
  // An inner svg element clips everything outside its box.
  svg += fmt::format(
      "<svg x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{3}\" viewBox=\"{0} {1} {2} {3}\">\n{4}"
      "</svg>\n{5}",
      kLeft, kTop, kWidth - kRight - kLeft, kPlotHeight, lines_, marks_);
  for (size_t k = 0; k < legend_.size(); ++k) {
    const Entry& entry = legend_[k];
    const double x = k % 2 == 0 ? kLeft : (kLeft + kWidth) / 2,
                 y = legendTop + kRow * static_cast<double>(k / 2);
    switch (entry.key) {
      case Key::disc:
        svg += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"4.5\" fill=\"{}\"/>", x + 9, y, entry.color);
        break;
      case Key::ring:
        svg += fmt::format(
            "<circle cx=\"{}\" cy=\"{}\" r=\"6\" fill=\"none\" stroke=\"{}\" stroke-width=\"3\"/>", x + 9, y,
            entry.color);
        break;
      case Key::line:
        svg += fmt::format("<path class=\"{}\" d=\"M{} {}h18\" stroke=\"{}\"{}{}/>", lineClass(entry.color),
                           x, y, entry.color, entry.style.empty() ? "" : " ", entry.style);
        break;
    }
    svg += fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", x + 24, y + 4, escaped(entry.text));
  }
  return svg + "</svg>\n";
}

std::string barsSvg(const std::string& title, std::span<const Bar> bars) {
  constexpr double kText = 170, kCount = 70, kBarRow = 22;
  double most = 0;
  for (const Bar& bar : bars) most = std::max(most, bar.value);
  std::string svg = start(kTitleHeight + kBarRow * static_cast<double>(bars.size()) + 10, title);
  double y = kTitleHeight;
  for (const Bar& bar : bars) {
    const double length = most > 0 ? (kWidth - kText - kCount) * bar.value / most : 0;
    svg += fmt::format(
        "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text><rect x=\"{}\" y=\"{}\" width=\"{:.1f}\" "
        "height=\"{}\" fill=\"{}\"/><text x=\"{:.1f}\" y=\"{}\">{:g}</text>\n",
        kText - 8, y + 15, escaped(bar.text), kText, y + 3, length, kBarRow - 6, bar.color,
        kText + length + 6, y + 15, bar.value);
    y += kBarRow;
  }
  return svg + "</svg>\n";
}

void requireSvgName(std::string_view option, const std::string& name, std::string_view what) {
  constexpr std::array<std::string_view, 12> kOthers = {".png", ".jpg", ".jpeg", ".tif", ".tiff", ".gif",
                                                        ".bmp", ".hdr", ".exr",  ".pdf", ".eps",  ".ps"};
  const size_t dot = std::min(name.rfind('.'), name.size());
  std::string ending = name.substr(dot);
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (std::ranges::find(kOthers, ending) != kOthers.end())
    throw rad::Error(fmt::format("{} \"{}\": {} is an SVG file; use the name {}.svg", option, name, what,
                                 name.substr(0, dot)));
}

}  // namespace rsphere
