#include "companions/trade/trade_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "base/version.h"
#include "companions/report/page.h"
#include "companions/report/plot.h"
#include "points/sphere_options.h"

namespace rsphere {
namespace {

std::string percent(double x) {
  const double size = std::abs(100 * x);
  return fmt::format("{:.{}f}%", 100 * x, size >= 10 ? 1 : size >= 1 || size == 0 ? 2 : 3);
}

std::string milliseconds(double seconds) {
  return fmt::format("{:.{}f}", 1e3 * seconds, seconds < .01 ? 2 : 1);
}

// The ratio of the measured error to the error estimated by the setting; 0 without an estimate.
double dishonesty(const Figures& f) { return f.estimated > 0 ? f.rms / f.estimated : 0; }
constexpr double kDishonest = 1.5;  // ratio from which the estimate is regarded as too small

struct Series {
  std::string_view name, color;
};
// Settings with each letter of -Sw, and two others.
constexpr Series kSeries[] = {{"equal weights (-Sw h)", "#888888"},
                              {"the paper's cells (-Sw v)", "#d95f02"},
                              {"cells within silhouettes (-Sw c)", "#1b6fb3"},
                              {"until an accuracy (-Sa)", "#1a9850"},
                              {"rays, as -ad and -as say", "#7570b3"}};

constexpr size_t kWeightings = kWeightsLetters.size();
static_assert(std::size(kSeries) == kWeightings + 2, "each letter of -Sw needs a name and a color");

size_t seriesOf(const Figures& f, bool rays) {
  if (std::ranges::find(f.words, "-Sa") != f.words.end()) return kWeightings;
  if (rays) return kWeightings + 1;
  const auto weights = std::ranges::find(f.words, "-Sw");
  return kWeightsLetters.find(weights == f.words.end() ? 'c' : weights[1][0]);
}

constexpr std::string_view kRing = "#c2185b", kDashes = "stroke-width=\"2\" stroke-dasharray=\"4 3\"",
                           kDots = "stroke-dasharray=\"1 4\"";

std::string recommendedText(const TradeSubject& subject) {
  return subject.recommended.sure ? "recommended" : "nearest to the accuracy asked for";
}

}  // namespace

std::string tradeTable(std::span<const Figures> all) {
  std::string text =
      fmt::format("  {:>9}{:>9}{:>10}{:>9}{:>9}{:>10}{:>9}{:>10}{:>6}  {}\n", "ms/point", "rms", "95% sure",
                  "largest", "bias", "+-", "says", "true/says", "", "setting");
  for (const Figures& f : all) {
    const bool honest = dishonesty(f) < kDishonest;
    text += fmt::format("{} {:>9}{:>9}{:>10}{:>9}{:>9}{:>10}{:>9}{:>10}{:>6}  {}\n", f.best ? '*' : ' ',
                        milliseconds(f.seconds), percent(f.rms), percent(f.rmsAtMost), percent(f.largest),
                        percent(f.bias), percent(f.biasError), f.estimated > 0 ? percent(f.estimated) : "-",
                        f.estimated > 0 ? fmt::format("{:.2f}", dishonesty(f)) : "-",
                        fmt::format("{}{}{}", f.limited ? "~" : "", f.biased ? "b" : "", honest ? "" : "!"),
                        fmt::join(f.words, " "));
  }
  text +=
      "* nothing is as fast and as accurate   95% sure: the rms error is below this   says: the error that "
      "the setting estimates itself\n";
  if (std::ranges::any_of(all, [](const Figures& f) { return f.limited; }))
    text += "~ the reference is not good enough to tell (-Te)\n";
  if (std::ranges::any_of(all, [](const Figures& f) { return f.biased; }))
    text += "b a bias that is certain (99%)\n";
  if (std::ranges::any_of(all, [](const Figures& f) { return dishonesty(f) >= kDishonest; }))
    text += "! the error is more than half again as large as the setting says\n";
  return text;
}

std::string tradeCsv(std::span<const Figures> all, const Reference& reference) {
  std::string text =
      "setting,seconds,setup_seconds,directions,rms,rms_at_most,largest,bias,bias_error,estimated,best,"
      "reference_error\n";
  for (const Figures& f : all)
    text += fmt::format("{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{},{:.6g}\n",
                        fmt::join(f.words, " "), f.seconds, f.setupSeconds, f.directions, f.rms, f.rmsAtMost,
                        f.largest, f.bias, f.biasError, f.estimated, f.best ? 1 : 0, reference.error());
  return text;
}

std::string bouncesText(int bounces) {
  return fmt::format(
      "These errors hold for -ab {}. The light that further bounces would add is not in them; -Tb with a "
      "larger -ab measures it.",
      bounces);
}

std::string tradePlot(std::span<const Figures> all, const TradeSubject& subject) {
  const auto pointOf = [](const Figures& f) { return PlotPoint{1e3 * f.seconds, 100 * f.rms}; };
  const auto isDrawn = [](const Figures& f) { return f.rms > 0 && f.seconds > 0; };
  std::vector<Figures> drawn;
  std::ranges::copy_if(all, std::back_inserter(drawn), isDrawn);
  const std::string title =
      fmt::format("{}: {} points", subject.scene, subject.points.size() / subject.perPoint);
  if (drawn.empty()) return barsSvg(title + ": no setting has both an error and a time", {});
  const bool rays = subject.perPoint == 6;
  const double wanted = 100 * subject.accuracy;
  std::vector<PlotPoint> curve, extent{{pointOf(drawn.front()).x, wanted}};  // the legend names this line
  for (const Figures& f : drawn) {
    extent.push_back(pointOf(f));
    if (f.best) curve.push_back(pointOf(f));
  }
  std::ranges::sort(curve, {}, &PlotPoint::x);
  Plot plot(title, extent, {"CPU time a point, ms"}, {"rms error, relative to the reference", 1, "%"});
  const std::array goal = {PlotPoint{plot.xLow(), wanted}, PlotPoint{plot.xHigh(), wanted}};
  plot.line(goal, kInk, kDots);
  if (curve.size() > 1) plot.line(curve, kInk, kDashes);
  for (const Figures& f : drawn)
    plot.mark(pointOf(f), f.best ? 5 : 3.5, kSeries[seriesOf(f, rays)].color,
              fmt::format("{}: {} ms, {}", fmt::join(f.words, " "), milliseconds(f.seconds), percent(f.rms)));
  for (size_t k = 0; k < std::size(kSeries); ++k)
    if (std::ranges::any_of(drawn, [&](const Figures& f) { return seriesOf(f, rays) == k; }))
      plot.legend(Plot::Key::disc, kSeries[k].color, std::string(kSeries[k].name));
  if (const Figures& f = all[subject.recommended.index]; isDrawn(f)) {
    plot.ring(pointOf(f), kRing);
    plot.legend(Plot::Key::ring, kRing, recommendedText(subject));
  }
  if (curve.size() > 1) plot.legend(Plot::Key::line, kInk, "nothing is as fast and as accurate", kDashes);
  plot.legend(Plot::Key::line, kInk, fmt::format("the accuracy asked for: {:g}%", wanted), kDots);
  return plot.svg();
}

namespace {

PageTable settingsTable(std::span<const Figures> all, const TradeSubject& subject) {
  PageTable table;
  table.textColumns = 2;
  table.lastIsText = true;
  table.head = {"",     "Setting",      "Time a point, ms", "rms error", "95% sure below", "Largest error",
                "Bias", "Own estimate", "Directions",       "Remarks"};
  for (size_t i = 0; i < all.size(); ++i) {
    const Figures& f = all[i];
    const bool chosen = i == subject.recommended.index;
    std::vector<std::string> remarks;
    if (f.limited) remarks.emplace_back("the reference limits the accuracy");
    if (f.biased) remarks.emplace_back("biased (99% sure)");
    if (dishonesty(f) >= kDishonest) remarks.emplace_back("own estimate too small");
    if (subject.repeatsOfLast > 0 && i + 1 == all.size())
      remarks.push_back(fmt::format("{} of {} repeats", subject.repeatsOfLast, subject.repeats));
    table.rows.push_back({{chosen   ? recommendedText(subject)
                           : f.best ? "on the curve"
                                    : "",
                           fmt::format("{}", fmt::join(f.words, " ")), milliseconds(f.seconds),
                           percent(f.rms), percent(f.rmsAtMost), percent(f.largest),
                           fmt::format("{} \u00b1 {}", percent(f.bias), percent(f.biasError)),
                           f.estimated > 0 ? percent(f.estimated) : "-", fmt::format("{:.0f}", f.directions),
                           fmt::format("{}", fmt::join(remarks, "; "))},
                          chosen});
  }
  return table;
}

PageTable pointsTable(const Reference& reference, const TradeSubject& subject) {
  PageTable table;
  table.head = {"Point", "x", "y", "z", "Mean radiance, W/sr/m2"};
  for (size_t i = 0; i < reference.points(); ++i) {
    const double* p = &subject.points[subject.perPoint * i];
    table.rows.push_back({{std::to_string(i + 1), fmt::format("{:g}", p[0]), fmt::format("{:g}", p[1]),
                           fmt::format("{:g}", p[2]), fmt::format("{:.4g}", reference.mean(i))}});
  }
  return table;
}

}  // namespace

std::string tradePage(std::span<const Figures> all, const Reference& reference, const TradeSubject& subject,
                      std::time_t when) {
  const Figures& chosen = all[subject.recommended.index];
  Page page(fmt::format("Speed and accuracy: {}", subject.scene),
            fmt::format("rsphere-trade {}, {}", kVersion, dateAndTime(when)));
  if (subject.recommended.sure)
    page.banner(Tone::good,
                fmt::format("The fastest setting for an rms error of {:g}% takes {} ms of CPU time a point. "
                            "Its error is {} (95% sure: below {}).",
                            100 * subject.accuracy, milliseconds(chosen.seconds), percent(chosen.rms),
                            percent(chosen.rmsAtMost)));
  else
    page.banner(Tone::open, fmt::format("No setting is sure to have an rms error of {:g}%. The nearest has "
                                        "{} (95% sure: below {}) and takes {} ms of CPU time a point.",
                                        100 * subject.accuracy, percent(chosen.rms),
                                        percent(chosen.rmsAtMost), milliseconds(chosen.seconds)));
  page.command(subject.command);
  page.note(bouncesText(subject.bounces));
  page.heading("Error against time");
  page.figure(
      tradePlot(all, subject),
      "Each mark is a setting. Settings further down are more accurate, and settings further left are "
      "faster. A browser shows the options of a mark when the pointer rests on it.");
  page.heading("Settings");
  page.table(settingsTable(all, subject));
  page.note(
      "Time: CPU time of one thread, without reading the scene and other work before the first point. "
      "Errors are relative to the reference: those of single answers, as root mean square (rms) over points "
      "and repeats, and the largest. Bias: the mean error \u00b1 its standard error. Own estimate: the "
      "standard error that the setting states itself (-oe).");
  page.heading("Measurement");
  page.facts(
      {{"Scene", subject.scene},
       {"Points",
        fmt::format("{}: {} of {} points", subject.pointsFile, reference.points(), subject.pointsInFile)},
       {"Reference", fmt::format("{} rotations of {}; relative standard error {}, of the mean over the "
                                 "points {}",
                                 reference.repeats(), subject.referenceWords, percent(reference.error()),
                                 percent(reference.meanError()))},
       {"Repeats", fmt::format("{} of each setting", subject.repeats)},
       {"Command", subject.given},
       {"Date", dateAndTime(when)},
       {"Version", fmt::format("rsphere {}", kVersion)}});
  page.foldedTable("The points, with their mean radiance (brightness) in the reference",
                   pointsTable(reference, subject));
  return page.html();
}

}  // namespace rsphere
