#include "trade/trade_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rsphere {
namespace {

std::string joined(std::span<const std::string> words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::string percent(double x) {
  const double size = std::abs(100 * x);
  return fmt::format("{:.{}f}%", 100 * x, size >= 10 ? 1 : size >= 1 || size == 0 ? 2 : 3);
}

std::string milliseconds(double seconds) {
  return fmt::format("{:.{}f}", 1e3 * seconds, seconds < .01 ? 2 : 1);
}

// The ratio of the measured error to the one that the setting estimates; 0 if it estimates none.
double dishonesty(const Figures& f) { return f.estimated > 0 ? f.rms / f.estimated : 0; }

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '&')
      out += "&amp;";
    else
      out += c;
  }
  return out;
}

struct Series {
  std::string_view name, color;
};
constexpr Series kSeries[] = {{"equal weights (-Sw h)", "#888888"},
                              {"the paper's cells (-Sw v)", "#d95f02"},
                              {"cells within silhouettes (-Sw c)", "#1b6fb3"},
                              {"until an accuracy (-Sa)", "#1a9850"}};

size_t seriesOf(const Figures& f) {
  if (std::find(f.words.begin(), f.words.end(), "-Sa") != f.words.end()) return 3;
  const auto weights = std::find(f.words.begin(), f.words.end(), "-Sw");
  if (weights == f.words.end() || weights + 1 == f.words.end()) return 2;
  return weights[1] == "h" ? 0 : weights[1] == "v" ? 1 : 2;
}

// A logarithmic axis for values from `low` to `high`, drawn from pixel `from` to pixel `to`.
struct Axis {
  double low, high, from, to;
  double at(double x) const { return from + (to - from) * std::log(x / low) / std::log(high / low); }
};

Axis axisOf(std::span<const Figures> all, double Figures::*value, double from, double to) {
  double low = 1e300, high = 0;
  for (const Figures& f : all) {
    low = std::min(low, f.*value);
    high = std::max(high, f.*value);
  }
  return {low / 1.3, high * 1.3, from, to};
}

// The values of an axis that are 1, 2 or 5 times a power of ten.
std::vector<double> ticksOf(const Axis& axis) {
  std::vector<double> ticks;
  for (int power = -12; power < 12; ++power)
    for (const double digit : {1., 2., 5.}) {
      const double x = digit * std::pow(10., power);
      if (x >= axis.low && x <= axis.high) ticks.push_back(x);
    }
  return ticks;
}

}  // namespace

std::string tradeTable(std::span<const Figures> all) {
  std::string text = fmt::format("  {:>9}{:>9}{:>9}{:>9}{:>10}{:>9}{:>10}{:>6}  {}\n", "ms/point", "rms",
                                 "largest", "bias", "+-", "says", "true/says", "", "setting");
  for (const Figures& f : all) {
    const bool honest = dishonesty(f) < 1.5;
    text += fmt::format("{} {:>9}{:>9}{:>9}{:>9}{:>10}{:>9}{:>10}{:>6}  {}\n", f.best ? '*' : ' ',
                        milliseconds(f.seconds), percent(f.rms), percent(f.largest), percent(f.bias),
                        percent(f.biasError), f.estimated > 0 ? percent(f.estimated) : "-",
                        f.estimated > 0 ? fmt::format("{:.2f}", dishonesty(f)) : "-",
                        fmt::format("{}{}{}", f.limited ? "~" : "", f.biased ? "b" : "", honest ? "" : "!"),
                        joined(f.words));
  }
  text += "* nothing is as fast and as accurate   says: the error that the setting estimates itself\n";
  if (std::any_of(all.begin(), all.end(), [](const Figures& f) { return f.limited; }))
    text += "~ the reference is not good enough to tell (-Te)\n";
  if (std::any_of(all.begin(), all.end(), [](const Figures& f) { return f.biased; }))
    text += "b a bias that is certain (99%)\n";
  if (std::any_of(all.begin(), all.end(), [](const Figures& f) { return dishonesty(f) >= 1.5; }))
    text += "! the error is more than half again as large as the setting says\n";
  return text;
}

std::string tradeCsv(std::span<const Figures> all, const Reference& reference) {
  std::string text =
      "setting,seconds,setup_seconds,directions,rms,rms_at_most,largest,bias,bias_error,estimated,best,"
      "reference_error\n";
  for (const Figures& f : all)
    text += fmt::format("{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{},{:.6g}\n",
                        joined(f.words), f.seconds, f.setupSeconds, f.directions, f.rms, f.rmsAtMost,
                        f.largest, f.bias, f.biasError, f.estimated, f.best ? 1 : 0, reference.error());
  return text;
}

std::string tradePlot(std::span<const Figures> given, const std::string& title) {
  constexpr double kWidth = 720, kHeight = 480, kLeft = 70, kRight = 20, kTop = 40, kBottom = 55;
  std::vector<Figures> all;
  for (const Figures& f : given)
    if (f.rms > 0 && f.seconds > 0) all.push_back(f);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" font-family=\"sans-serif\" "
      "font-size=\"12\">\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n"
      "<text x=\"{2}\" y=\"24\" font-size=\"14\">{3}</text>\n",
      kWidth, kHeight, kLeft, escaped(title));
  if (all.empty()) return svg + "</svg>\n";
  const Axis x = axisOf(all, &Figures::seconds, kLeft, kWidth - kRight);
  const Axis y = axisOf(all, &Figures::rms, kHeight - kBottom, kTop);
  for (const double tick : ticksOf(x))
    svg += fmt::format(
        "<path d=\"M{0:.1f} {1}V{2}\" stroke=\"#ddd\"/><text x=\"{0:.1f}\" y=\"{3}\" "
        "text-anchor=\"middle\">{4:g}</text>\n",
        x.at(tick), kTop, kHeight - kBottom, kHeight - kBottom + 18, 1e3 * tick);
  for (const double tick : ticksOf(y))
    svg += fmt::format(
        "<path d=\"M{0} {1:.1f}H{2}\" stroke=\"#ddd\"/><text x=\"{3}\" y=\"{4:.1f}\" "
        "text-anchor=\"end\">{5:g}%</text>\n",
        kLeft, y.at(tick), kWidth - kRight, kLeft - 6, y.at(tick) + 4, 100 * tick);
  svg += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">CPU time a point, ms</text>\n",
                     (kLeft + kWidth - kRight) / 2, kHeight - 12);
  svg += fmt::format(
      "<text transform=\"translate(16 {}) rotate(-90)\" text-anchor=\"middle\">rms error</text>\n",
      (kTop + kHeight - kBottom) / 2);
  std::vector<Figures> best;
  std::copy_if(all.begin(), all.end(), std::back_inserter(best), [](const Figures& f) { return f.best; });
  std::sort(best.begin(), best.end(),
            [](const Figures& a, const Figures& b) { return a.seconds < b.seconds; });
  std::string line;
  for (const Figures& f : best)
    line += fmt::format("{}{:.1f} {:.1f}", line.empty() ? "M" : "L", x.at(f.seconds), y.at(f.rms));
  svg += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"#333\" stroke-dasharray=\"3 3\"/>\n", line);
  for (const Figures& f : all)
    svg += fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"><title>{}: {} ms, {}</title></circle>\n",
        x.at(f.seconds), y.at(f.rms), f.best ? 5 : 3.5, kSeries[seriesOf(f)].color, escaped(joined(f.words)),
        milliseconds(f.seconds), percent(f.rms));
  double row = kTop + 16;
  for (size_t k = 0; k < std::size(kSeries); ++k) {
    if (std::none_of(all.begin(), all.end(), [&](const Figures& f) { return seriesOf(f) == k; })) continue;
    svg += fmt::format(
        "<circle cx=\"{0}\" cy=\"{1}\" r=\"4\" fill=\"{2}\"/><text x=\"{3}\" y=\"{4}\">{5}</text>\n",
        kWidth - kRight - 220, row - 4, kSeries[k].color, kWidth - kRight - 210, row, kSeries[k].name);
    row += 16;
  }
  return svg + "</svg>\n";
}

}  // namespace rsphere
