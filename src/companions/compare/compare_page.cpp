#include "companions/compare/compare_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "base/colorimetry.h"
#include "base/version.h"
#include "companions/compare/report.h"
#include "companions/report/page.h"
#include "companions/report/plot.h"
#include "image/picture_formats.h"
#include "rad_parser/error.h"

namespace rsphere {
namespace {

constexpr std::string_view kWithin = "#1b6fb3", kBeyond = "#d95f02", kDashes = "stroke-dasharray=\"4 3\"";

std::string_view unitOf(const CompareSubject& subject) { return subject.irradiance ? "W/m2" : "W/sr/m2"; }

// The mean over the repeats as a picture.
std::string pngOf(const Answers& answers, const CompareSubject& subject, double exposure) {
  Raster raster{static_cast<int>(subject.width), static_cast<int>(subject.height), {}};
  for (size_t i = 0; i < answers.records; ++i) {
    const V3d mean = shownRgb(meanOf(answers, i), answers.sampling);
    for (int c = 0; c < 3; ++c)
      raster.pixels.push_back(static_cast<float>(sRgb(std::max(0., exposure * mean[c]))));
  }
  return pngPicture(raster);
}

// The exposure at which the median of the original's pixels that are not black becomes middle gray.
double exposureOf(const Answers& original) {
  std::vector<double> bright;
  for (size_t i = 0; i < original.records; ++i)
    if (const double b = brightnessOf(original, i); b > 0) bright.push_back(b);
  if (bright.empty()) return 1;
  const auto middle = bright.begin() + static_cast<ptrdiff_t>(bright.size() / 2);
  std::nth_element(bright.begin(), middle, bright.end());
  return kMidBright / *middle;
}

std::set<size_t> recordsDrawn(const Comparison& comparison) {
  const size_t records = comparison.records.size(), even = std::min(records, kMostMarks * 9 / 10);
  std::set<size_t> drawn;
  for (size_t k = 0; k < even; ++k) drawn.insert(k * records / even);
  for (const size_t i : comparison.worst)
    if (drawn.size() < kMostMarks) drawn.insert(i);
  return drawn;
}

// The table with rows and columns exchanged.
PageTable transposed(const PageTable& table) {
  PageTable result;
  result.head = {table.head.front()};
  for (const PageTable::Row& row : table.rows) result.head.push_back(row.cells.front());
  for (size_t column = 1; column < table.head.size(); ++column) {
    PageTable::Row cells{{table.head[column]}};
    for (const PageTable::Row& row : table.rows) cells.cells.push_back(row.cells[column]);
    result.rows.push_back(std::move(cells));
  }
  return result;
}

PageTable figuresTable(const Comparison& comparison, const CompareSubject& subject) {
  PageTable table;
  table.head = {""};
  for (const ChannelComparison& c : comparison.channels) table.head.push_back(c.name);
  const auto row = [&](const std::string& name, const auto& textOf) {
    PageTable::Row cells{{name}};
    for (const ChannelComparison& c : comparison.channels) cells.cells.push_back(textOf(c));
    table.rows.push_back(std::move(cells));
  };
  using Channel = ChannelComparison;
  row(fmt::format("Mean of rsphere, {}", unitOf(subject)),
      [](const Channel& c) { return fmt::format("{:.4e}", c.ourMean); });
  row(fmt::format("Mean of the original, {}", unitOf(subject)),
      [](const Channel& c) { return fmt::format("{:.4e}", c.originalMean); });
  row("Difference of the means \u00b1 its standard error", [](const Channel& c) {
    return fmt::format("{} \u00b1 {}", signedPercent(c.bias), percent(c.biasError));
  });
  row("Differences of records, rms", [](const Channel& c) { return percent(c.rms); });
  row("of these, noise explains", [](const Channel& c) { return percent(c.noiseRms); });
  constexpr std::array kShares = {"Half of the records differ by less than",
                                  "90% of the records differ by less than",
                                  "99% of the records differ by less than", "Largest difference of a record"};
  static_assert(kShares.size() == kPercentiles.size());
  for (size_t k = 0; k < kShares.size(); ++k)
    row(kShares[k], [k](const Channel& c) { return percent(c.percentiles[k]); });
  row(fmt::format("Records that differ by less than {}", percent(subject.tolerance)),
      [](const Channel& c) { return percent(c.shareWithin); });
  row("Noise of one answer of rsphere, rms", [](const Channel& c) { return percent(c.ourNoise); });
  row("Noise of one answer of the original, rms", [](const Channel& c) { return percent(c.originalNoise); });
  // A spectral run has too many bands for the width of a page.
  return comparison.channels.size() > 3 ? transposed(table) : table;
}

std::string histogramSvg(const Comparison& comparison, double tolerance) {
  std::vector<Bar> bars;
  for (const DifferenceClass& c : differenceClasses(comparison.records, tolerance))
    bars.push_back({fmt::format("{} to {}", c.low, c.high), static_cast<double>(c.records),
                    c.within ? kWithin : kBeyond});
  return barsSvg("Number of records by relative difference (brightness)", bars);
}

Tone toneOf(Verdict verdict) {
  switch (verdict) {
    case Verdict::same:
    case Verdict::small: return Tone::good;
    case Verdict::undecided: return Tone::open;
    case Verdict::differs: break;
  }
  return Tone::bad;
}

}  // namespace

std::string comparePlot(const Answers& ours, const Answers& original, const Comparison& comparison,
                        const CompareSubject& subject) {
  struct Mark {
    PlotPoint at;
    size_t record;
    bool within;
  };
  const std::set<size_t> drawn = recordsDrawn(comparison);
  std::vector<Mark> marks;
  std::vector<PlotPoint> extent;
  for (const size_t i : drawn) {
    const PlotPoint at{brightnessOf(original, i), brightnessOf(ours, i)};
    if (!(at.x > 0 && at.y > 0 && std::isfinite(at.x) && std::isfinite(at.y))) continue;
    marks.push_back({at, i, std::abs(comparison.records[i].difference) <= subject.tolerance});
    extent.push_back(at);
  }
  std::string title = drawn.size() == comparison.records.size()
                          ? fmt::format("{} records", drawn.size())
                          : fmt::format("{} of {} records", drawn.size(), comparison.records.size());
  if (marks.size() < drawn.size()) title += fmt::format(", {} of them black", drawn.size() - marks.size());
  if (extent.empty()) return barsSvg(title + ": none to draw", {});
  const std::string unit(unitOf(subject));
  Plot plot(title, extent, {"original, " + unit}, {"rsphere, " + unit}, true);
  const auto diagonal = [&](double factor, std::string_view style) {
    const std::array ends = {PlotPoint{plot.xLow(), factor * plot.xLow()},
                             PlotPoint{plot.xHigh(), factor * plot.xHigh()}};
    plot.line(ends, kInk, style);
  };
  diagonal(1, "");
  // Differences are relative to the mean of both programs.
  const double ratio = (1 + subject.tolerance / 2) / (1 - subject.tolerance / 2);
  diagonal(ratio, kDashes);
  diagonal(1 / ratio, kDashes);
  for (const bool within : {true, false}) {  // marks beyond the tolerance are drawn last, so that none is
                                             // hidden
    bool any = false;
    for (const Mark& mark : marks) {
      if (mark.within != within) continue;
      any = true;
      plot.mark(mark.at, within ? 2.5 : 3, within ? kWithin : kBeyond,
                within ? ""
                       : fmt::format("record {}: {}", mark.record + 1,
                                     signedPercent(comparison.records[mark.record].difference)));
    }
    if (any)
      plot.legend(
          Plot::Key::disc, within ? kWithin : kBeyond,
          fmt::format("differs by {} {}", within ? "at most" : "more than", percent(subject.tolerance)));
  }
  plot.legend(Plot::Key::line, kInk, "equal");
  plot.legend(Plot::Key::line, kInk, fmt::format("{} apart, the tolerance", percent(subject.tolerance)),
              kDashes);
  return plot.svg();
}

std::string comparePage(const Answers& ours, const Answers& original, const Comparison& comparison,
                        const CompareSubject& subject, std::time_t when) {
  Page page(fmt::format("rsphere beside rtrace: {}", subject.scene),
            fmt::format("rsphere-compare {}, {}", kVersion, dateAndTime(when)));
  page.banner(toneOf(comparison.verdict), fmt::format("{}.", conclusion(comparison.verdict)));
  for (const std::string& warning : subject.warnings)
    page.banner(Tone::open, fmt::format("Warning: {}", warning));
  page.table(figuresTable(comparison, subject));
  page.note("Differences are relative to the original's mean, or for a record to the mean of both programs.");
  std::vector<std::pair<std::string, std::string>> verdicts;
  for (const ChannelComparison& c : comparison.channels) verdicts.emplace_back(c.name, verdictText(c));
  page.facts(verdicts);
  if (subject.width > 0) {
    page.heading("Pictures");
    const double exposure = exposureOf(original);
    const std::vector<PagePicture> pictures = {
        {pngOf(ours, subject, exposure), "rsphere"},
        {pngOf(original, subject, exposure), "original"},
        {pngPicture(
             differencesOnScreen(subject.width, subject.height, comparison.records, subject.tolerance)),
         fmt::format("Difference: red where rsphere is brighter, blue where the original is; colors are full "
                     "at {}",
                     percent(10 * subject.tolerance))}};
    page.pictures(pictures);
    page.note("Both pictures are means of the repeats, with the same exposure.");
  }
  page.heading("Records");
  page.figure(comparePlot(ours, original, comparison, subject),
              "Brightness of each record, as the mean of its repeats. Both axes have the same scale.");
  page.figure(histogramSvg(comparison, subject.tolerance),
              "Blue: within the tolerance. Positive where rsphere is brighter.");
  if (!subject.worst.empty()) {
    page.heading("Worst records");
    page.lines(subject.worst);
  }
  page.heading("Measurement");
  page.facts({{"Scene", subject.scene},
              {"Records", fmt::format("{}: {} {}, {} repeats", subject.recordsFile, ours.records,
                                      subject.points ? "points" : "rays", ours.repeats)},
              {"Original", fmt::format("{} ({})", subject.original, subject.originalVersion)},
              {"Tolerance", percent(subject.tolerance)},
              {"Command", subject.given},
              {"Date", dateAndTime(when)},
              {"Version", fmt::format("rsphere {}", kVersion)}});
  page.lines(subject.times);
  return page.html();
}

}  // namespace rsphere
