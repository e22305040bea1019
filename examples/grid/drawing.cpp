#include "drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "markup.h"

namespace grid {
namespace {

struct Box {
  double left, top, right, bottom;
  bool overlaps(const Box& b) const {
    return left < b.right && b.left < right && top < b.bottom && b.top < bottom;
  }
};

struct Color {
  double red, green, blue;  // 0 to 255
  std::string text() const {
    return fmt::format("#{:02x}{:02x}{:02x}", std::lround(red), std::lround(green), std::lround(blue));
  }
  bool dark() const { return .3 * red + .59 * green + .11 * blue < 120; }
};

// From blue over green to yellow and red; lightness rises up to yellow. share: 0 to 1.
Color falsecolor(double share) {
  static constexpr std::array<Color, 7> kScale{{{49, 54, 149},
                                                {44, 123, 182},
                                                {64, 182, 176},
                                                {140, 206, 110},
                                                {250, 234, 98},
                                                {250, 165, 62},
                                                {222, 72, 45}}};
  const double place = std::clamp(share, 0., 1.) * (kScale.size() - 1);
  const size_t first = std::min(static_cast<size_t>(place), kScale.size() - 2);
  const double t = place - static_cast<double>(first);
  const Color &a = kScale[first], &b = kScale[first + 1];
  return {a.red + t * (b.red - a.red), a.green + t * (b.green - a.green), a.blue + t * (b.blue - a.blue)};
}

// The next of 1, 2, 5, 10, 20, ... (and fractions) from this value on.
double roundUp(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (const double factor : {1., 2., 5.})
    if (power * factor >= value * (1 - 1e-9)) return power * factor;
  return 10 * power;
}

// Collects the elements of the picture. Coordinates are pixels, y down.
class Canvas {
 public:
  void path(const std::string& commands, const std::string& style) {
    body_ += fmt::format("<path d=\"{}\" {}/>\n", commands, style);
  }
  void rectangle(const Box& box, const std::string& style) {
    body_ += fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" {}/>\n",
                         box.left, box.top, box.right - box.left, box.bottom - box.top, style);
  }
  // style: attributes beyond the place.
  void text(double x, double y, std::string_view words, const std::string& style) {
    body_ +=
        fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", x, y, style, rsphere::escaped(words));
  }
  std::string svg(double width, double height) const {
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
        "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"12\">\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n{2}</svg>\n",
        width, height, body_);
  }

 private:
  std::string body_;
};

// From the plane to pixels. The plan has the plane's own directions: right is right, up is up.
class Scale {
 public:
  // context: outlines that are drawn, too.
  Scale(const Area& area, const std::vector<Ring>& context, double left, double top, double widest,
        double highest) {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    low = V2d(kInfinite, kInfinite);
    high = -low;
    const auto include = [this](const V2d& p) {
      low = V2d(std::min(low.x, p.x), std::min(low.y, p.y));
      high = V2d(std::max(high.x, p.x), std::max(high.y, p.y));
    };
    for (const Edge& edge : area.edges()) include(edge.from);
    for (const Ring& ring : context)
      for (const V2d& p : ring) include(p);
    perUnit = std::min(widest / (high.x - low.x), highest / (high.y - low.y));
    frame = {left, top, left + perUnit * (high.x - low.x), top + perUnit * (high.y - low.y)};
  }
  double x(double u) const { return frame.left + perUnit * (u - low.x); }
  double y(double v) const { return frame.bottom - perUnit * (v - low.y); }
  std::string line(std::span<const V2d> points, bool closed) const {
    std::string commands;
    for (const V2d& p : points)
      commands += fmt::format("{}{:.2f} {:.2f}", commands.empty() ? "M" : "L", x(p.x), y(p.y));
    return closed ? commands + "Z" : commands;
  }
  std::string lines(const std::vector<std::vector<V2d>>& lines, bool closed) const {
    std::string commands;
    for (const auto& points : lines) commands += line(points, closed);
    return commands;
  }

  V2d low, high;
  double perUnit;
  Box frame;
};

// The edges of an area in a row, as far as they follow each other.
std::vector<Ring> ringsOf(std::vector<Edge> edges) {
  std::vector<Ring> rings;
  while (!edges.empty()) {
    Ring& ring = rings.emplace_back();
    for (size_t next = edges.size() - 1; next < edges.size();) {
      const V2d end = edges[next].to;
      ring.push_back(edges[next].from);
      edges.erase(edges.begin() + static_cast<std::ptrdiff_t>(next));
      next = 0;
      while (next < edges.size() && edges[next].from != end) ++next;
    }
  }
  return rings;
}

// The distance of ticks along an axis of this length: some 60 pixels, or as few as labels need if there would
// be only one or two.
double stepOf(double length, double pixelsOfLabel, double perUnit) {
  const double usual = roundUp(60 / perUnit);
  return length >= 2 * usual ? usual : std::min(usual, roundUp(pixelsOfLabel / perUnit));
}

void drawAxes(Canvas& canvas, const Scale& scale) {
  const Box& frame = scale.frame;
  double step = stepOf(scale.high.x - scale.low.x, 30, scale.perUnit);
  std::string ticks;
  for (double u = std::ceil(scale.low.x / step - 1e-6) * step; u <= scale.high.x + 1e-6 * step; u += step) {
    ticks += fmt::format("M{:.2f} {:.2f}v5", scale.x(u), frame.bottom + 4);
    canvas.text(scale.x(u), frame.bottom + 21, fmt::format("{:.6g}", std::abs(u) < 1e-6 * step ? 0. : u),
                "text-anchor=\"middle\" font-size=\"11\" fill=\"#555\"");
  }
  step = stepOf(scale.high.y - scale.low.y, 15, scale.perUnit);
  for (double v = std::ceil(scale.low.y / step - 1e-6) * step; v <= scale.high.y + 1e-6 * step; v += step) {
    ticks += fmt::format("M{:.2f} {:.2f}h-5", frame.left - 4, scale.y(v));
    canvas.text(frame.left - 12, scale.y(v) + 4, fmt::format("{:.6g}", std::abs(v) < 1e-6 * step ? 0. : v),
                "text-anchor=\"end\" font-size=\"11\" fill=\"#555\"");
  }
  canvas.path(ticks, "stroke=\"#555\" fill=\"none\"");
}

using Lines = std::vector<std::vector<V2d>>;

// How many of the lines of all levels pass through a box.
size_t linesThrough(const Box& box, const Scale& scale, const std::vector<Lines>& all) {
  const auto passes = [&](const std::vector<V2d>& line) {
    for (size_t i = 1; i < line.size(); ++i) {
      const V2d a(scale.x(line[i - 1].x), scale.y(line[i - 1].y)), b(scale.x(line[i].x), scale.y(line[i].y));
      if (!Box{std::min(a.x, b.x) - 1, std::min(a.y, b.y) - 1, std::max(a.x, b.x) + 1, std::max(a.y, b.y) + 1}
               .overlaps(box))
        continue;
      const int steps = 1 + static_cast<int>((b - a).length());  // of a pixel
      for (int k = 0; k <= steps; ++k) {
        const V2d p = a + (b - a) * (static_cast<double>(k) / steps);
        if (p.x > box.left && p.x < box.right && p.y > box.top && p.y < box.bottom) return true;
      }
    }
    return false;
  };
  ptrdiff_t count = 0;
  for (const Lines& lines : all) count += std::count_if(lines.begin(), lines.end(), passes);
  return static_cast<size_t>(count);
}

// Each line has a label where it is free of those before: where the fewest other lines pass, best in its
// middle. A short line has none among several others: it would hide them, and the colors tell its level.
void drawLabels(Canvas& canvas, const Scale& scale, const std::vector<Lines>& all, size_t number,
                double level, std::vector<Box>& taken) {
  constexpr double kShort = 150;  // pixels
  const std::string words = luxText(level);
  const double halfWidth = 3.4 * static_cast<double>(words.size()) + 3;
  for (const auto& line : all[number]) {
    double length = 0;
    for (size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).length();
    if (length * scale.perUnit < 60) continue;
    size_t fewest = length * scale.perUnit < kShort ? 3 : std::numeric_limits<size_t>::max();
    std::optional<V2d> best;
    for (int trial = 0; trial < 36 && !(best && fewest <= 1); ++trial) {
      const double share = .5 + (trial % 2 ? -.0125 : .0125) * trial;
      double left = share * length;
      size_t i = 1;
      while (i + 1 < line.size() && left > (line[i] - line[i - 1]).length()) {
        left -= (line[i] - line[i - 1]).length();
        ++i;
      }
      const double piece = (line[i] - line[i - 1]).length();
      const V2d p = line[i - 1] + (line[i] - line[i - 1]) * (piece > 0 ? std::min(1., left / piece) : 0);
      const double x = scale.x(p.x), y = scale.y(p.y);
      const Box box{x - halfWidth, y - 7, x + halfWidth, y + 7};
      const Box& frame = scale.frame;
      if (box.left < frame.left || box.right > frame.right || box.top < frame.top ||
          box.bottom > frame.bottom)
        continue;
      if (std::any_of(taken.begin(), taken.end(), [&](const Box& b) { return b.overlaps(box); })) continue;
      const size_t through = linesThrough(box, scale, all);
      if (through >= fewest) continue;
      fewest = through;
      best = V2d(x, y);
    }
    if (!best) continue;
    const auto [x, y] = std::pair(best->x, best->y);
    taken.push_back({x - halfWidth - 14, y - 16, x + halfWidth + 14, y + 16});
    const std::string place = "text-anchor=\"middle\" font-size=\"11\" font-weight=\"bold\" ";
    canvas.text(x, y + 4, words,
                place + "stroke=\"white\" stroke-width=\"3\" stroke-linejoin=\"round\" opacity=\".85\"");
    canvas.text(x, y + 4, words, place + "fill=\"#111\"");
  }
}

size_t bandOf(double value, const std::vector<double>& levels) {
  return static_cast<size_t>(std::upper_bound(levels.begin(), levels.end(), value) - levels.begin());
}

// The bands that the plan has. Below and above them, the smallest and the largest value: bands at the ends
// may reach far.
void drawLegend(Canvas& canvas, const std::vector<double>& levels, const std::vector<Color>& colors,
                const Summary& summary, const std::string& unit, double left, double top, double height) {
  const double step = std::min(26., height / static_cast<double>(colors.size()));
  const size_t lowest = bandOf(summary.smallest, levels), highest = bandOf(summary.largest, levels);
  canvas.text(left, top - 8, unit, "font-weight=\"bold\"");
  for (size_t i = lowest; i <= highest; ++i) {
    const double bottom = top + step * static_cast<double>(highest + 1 - i);
    canvas.rectangle({left, bottom - step, left + 22, bottom},
                     fmt::format("fill=\"{}\" stroke=\"#444\" stroke-width=\".5\"", colors[i].text()));
    if (i < highest) canvas.text(left + 28, bottom - step + 4, luxText(levels[i]), "font-size=\"11\"");
  }
  const std::string style = "font-size=\"11\" fill=\"#777\"";
  canvas.text(left + 28, top + 4, "max " + luxText(summary.largest), style);
  canvas.text(left + 28, top + step * static_cast<double>(highest + 1 - lowest) + 4,
              "min " + luxText(summary.smallest), style);
}

}  // namespace

Summary::Summary(std::span<const double> values) : smallest(values[0]), largest(values[0]) {
  for (const double value : values) {
    average += value / static_cast<double>(values.size());
    smallest = std::min(smallest, value);
    largest = std::max(largest, value);
  }
}

std::string luxText(double lux) {
  if (lux <= 0) return "0";
  const int decimals = std::clamp(2 - static_cast<int>(std::floor(std::log10(lux))), 0, 6);
  std::string text = fmt::format("{:.{}f}", lux, decimals);
  if (decimals > 0) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text;
}

std::string planAsSvg(const Area& area, const Grid& grid, std::span<const double> values,
                      const Drawing& drawing) {
  constexpr double kLeft = 54, kTop = 40;
  const Scale scale(area, drawing.context, kLeft, kTop, 640, 560);
  const Box& frame = scale.frame;
  const Field field(grid, values);
  const std::vector<double>& levels = drawing.levels;
  std::vector<Color> colors;
  for (size_t i = 0; i <= levels.size(); ++i)
    colors.push_back(
        falsecolor(levels.empty() ? .5 : static_cast<double>(i) / static_cast<double>(levels.size())));

  Canvas canvas;
  canvas.text(kLeft - 40, 20, drawing.title, "font-size=\"14\" font-weight=\"bold\"");
  const std::string outline = scale.lines(ringsOf(area.edges()), true);
  canvas.path(outline, "fill=\"#e9e9e9\" fill-rule=\"evenodd\"");
  // From the lowest band to the highest, each on top of those below.
  for (size_t i = 0; i < colors.size(); ++i) {
    const auto region = field.region(i ? levels[i - 1] : -std::numeric_limits<double>::infinity());
    if (!region.empty()) canvas.path(scale.lines(region, true), fmt::format("fill=\"{}\"", colors[i].text()));
  }
  if (!drawing.context.empty())
    canvas.path(scale.lines(drawing.context, true), "fill=\"none\" stroke=\"#000\" stroke-width=\"1.4\"");
  std::vector<Lines> isolines;
  for (const double level : levels) {
    isolines.push_back(field.isolines(level));
    if (!isolines.back().empty())
      canvas.path(
          scale.lines(isolines.back(), false),
          "class=\"isoline\" fill=\"none\" stroke=\"#111\" stroke-width=\".7\" stroke-linejoin=\"round\"");
  }
  canvas.path(outline, "fill=\"none\" stroke=\"#111\" stroke-width=\"2\" stroke-linejoin=\"round\"");

  std::vector<Box> taken;
  if (drawing.values) {
    // In a dense grid, only those of every second, third ... column and row, which can then be read.
    constexpr double kReadable = 7;  // pixels
    const double cell = std::min(grid.across.length(), grid.upwards.length()) * scale.perUnit;
    const int stride = std::max(1, static_cast<int>(std::ceil(kReadable / (.32 * cell) - 1e-9)));
    const double size = std::min(stride * cell * .32, 11.);
    for (int at = 0; at < grid.columns * grid.rows; ++at) {
      if (grid.pointOf[at] == Grid::kNone || at % grid.columns % stride != stride / 2 ||
          at / grid.columns % stride != stride / 2)
        continue;
      const auto i = static_cast<size_t>(grid.pointOf[at]);
      const size_t band = bandOf(values[i], levels);
      const double x = scale.x(grid.points[i].x), y = scale.y(grid.points[i].y);
      const std::string words = luxText(values[i]);
      const double halfWidth = .32 * size * static_cast<double>(words.size());
      taken.push_back({x - halfWidth, y - size * .5, x + halfWidth, y + size * .5});
      canvas.text(x, y + size * .35, words,
                  fmt::format("text-anchor=\"middle\" font-size=\"{:.1f}\" fill=\"{}\" stroke=\"{}\" "
                              "stroke-width=\"{:.1f}\" stroke-linejoin=\"round\" paint-order=\"stroke\"",
                              size, colors[band].dark() ? "white" : "black", colors[band].text(), .3 * size));
    }
  }
  for (size_t i = levels.size(); i-- > 0;) drawLabels(canvas, scale, isolines, i, levels[i], taken);

  drawAxes(canvas, scale);
  const double legendHeight = std::max(frame.bottom - frame.top, 18. * static_cast<double>(colors.size()));
  drawLegend(canvas, levels, colors, Summary(values), drawing.unit, frame.right + 24, kTop + 8,
             legendHeight - 8);
  // The remarks are below the plan. Beside a long and narrow one, the legend reaches further down.
  double widest = 0;
  for (const std::string& remark : drawing.remarks)
    widest = std::max(widest, 30 + 6.8 * static_cast<double>(remark.size()));
  double bottom = (widest < frame.right ? frame.bottom : kTop + legendHeight) + 30;
  for (const std::string& remark : drawing.remarks) canvas.text(kLeft - 40, bottom += 17, remark, "");
  const double width =
      std::max({frame.right + 24 + 104, widest, 30 + 8.8 * static_cast<double>(drawing.title.size())});
  return canvas.svg(width, std::max(bottom, kTop + legendHeight) + 16);
}

}  // namespace grid
