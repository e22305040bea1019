#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <exception>
#include <mutex>
#include <utility>

#include "answer/load_scene.h"
#include "cli/program.h"
#include "companions/measure/records_file.h"
#include "companions/report/markup.h"
#include "companions/report/page.h"
#include "companions/report/plot.h"
#include "companions/trade/ladder.h"
#include "companions/trade/schedule.h"
#include "companions/trade/trade_report.h"
#include "companions/trade/trials.h"
#include "process/threads.h"
#include "records/record_writer.h"

namespace rsphere {
namespace {

using Clock = std::chrono::steady_clock;

// Rotations of the reference start here and those of settings at 1, so that they are always different.
constexpr uint64_t kReferenceRotation = uint64_t{1} << 30;
// Limits on the rotations of the reference: with fewer its error is unknown, and more would take too long.
constexpr size_t kLeastRotations = 8, kMostRotations = 100000;
// Minimum number of answers of each setting for which estimated errors are collected.
constexpr size_t kEstimates = 8;
// If a signal ends the measurement of a setting early, it is reported only if it has this number of repeats,
// which is sufficient to estimate its bias.
constexpr size_t kLeastRepeats = 2;

// size: numbers of a record.
std::vector<double> chosenPoints(const std::vector<double>& all, size_t size, int most) {
  const size_t count = all.size() / size, chosen = std::min(count, static_cast<size_t>(most));
  std::vector<double> points;
  for (size_t k = 0; k < chosen; ++k) {
    const auto from = all.begin() + static_cast<ptrdiff_t>(size * (k * count / chosen));
    points.insert(points.end(), from, from + static_cast<ptrdiff_t>(size));
  }
  return points;
}

// Points share the patches of all repeats, rays have others in each.
void rotate(Setting& setting, uint64_t rotation) {
  setting.options.sphere.rotation = rotation;
  if (!setting.options.sphereMode) setting.options.ray.rotation = rotation;
}

// Whether a setting's answers have errors. Those of rays have them with -Sa; -oe would change the answers.
bool statesErrors(const AnswerOptions& options) { return options.sphereMode || options.sphere.accuracy > 0; }

// All measurements, which are reported if a signal arrives.
struct Measured {
  std::optional<Reference> reference;  // empty before its first rotation
  bool referenceIsDone = false;
  std::vector<Figures> settings;  // measured settings
  Trial last;                     // repeats of the setting in progress
};

class Trade {
 public:
  Trade(const TradeOptions& options, std::span<const UsedOption> used, const Messages& messages,
        StopSignals& signals)
      : options_(options), used_(used), messages_(messages), signals_(signals) {}

  void run() {
    const double accuracy =
        options_.sphere.accuracy > 0 ? options_.sphere.accuracy : SphereOptions::kUsualAccuracy;
    std::vector<std::vector<std::string>> settings = ladder(options_);
    std::vector<Setting> parsed;
    for (const auto& words : settings) {
      try {
        parsed.push_back(settingOf(words));
      } catch (const rad::Error& error) {
        if (options_.ladder.empty()) throw;
        throw rad::Error(fmt::format("{}: {}: {}", options_.ladder, fmt::join(words, " "), error.what()),
                         error.status());
      }
    }
    const std::vector<double> allPoints = readRecords(options_.scene.back(), options_);
    const auto size = static_cast<size_t>(options_.numbersPerRecord());
    pointsInFile_ = allPoints.size() / size;
    points_ = chosenPoints(allPoints, size, options_.mostPoints);

    const rad::Warn warn = [&](std::string_view text) { messages_.warning(text); };
    AnswerOptions withoutPoints = options_;
    withoutPoints.scene.pop_back();  // with -Sc-, the scene may not name files in the folder of the points
    const Scene scene = loadScene(withoutPoints, warn);
    signals_.defer(true);
    Measured measured;
    Trials trials(scene, points_, size, signals_, [&] {
      _exit(exitStatus(messages_, [&] {
        conclude(measured, accuracy);
        return 0;
      }));
    });
    const double target = options_.referenceError > 0 ? options_.referenceError : accuracy / 10;
    measured.referenceIsDone = makeReference(trials, target, measured);
    if (measured.referenceIsDone) measureAll(settings, parsed, trials, measured);
    conclude(std::move(measured), accuracy);
  }

 private:
  // The options of the command line, overridden by those of the setting.
  Setting settingOf(std::span<const std::string> words) const {
    std::vector<std::string> line{options_.program};
    // -Sa is the accuracy asked for, but not of each setting.
    for (const UsedOption& option : used_)
      if (option.entry->name != "-Sa") line.insert(line.end(), option.words.begin(), option.words.end());
    line.insert(line.end(), words.begin(), words.end());
    line.insert(line.end(), options_.scene.begin(), options_.scene.end());
    TradeOptions options;
    Setting setting;
    for (const UsedOption& option : parseCompanion(line, tradeCompanion(), options)) {
      const OptionEntry& entry = *option.entry;
      if (entry.group == Group::sphere && entry.name != "-Ss" && entry.name != "-Sb" && entry.name != "-Sr")
        continue;
      for (const std::string& word : option.words) setting.rays += word + ' ';
    }
    // The scene is read once for all settings.
    if (options.scene != options_.scene)
      throw rad::Error(fmt::format("\"{}\" is not an option", options.scene.front()));
    if (options.goals != options_.goals)
      throw rad::Error("-Sg applies to all settings: give it on the command line");
    setting.options = options;
    setting.options.sphere.everyDirection = false;  // the directions are not used
    return setting;
  }

  // Returns false after a signal; `trial` then contains the finished repeats.
  bool measure(std::span<const std::string> words, const Setting& given, Trials& trials, Trial& trial) const {
    trial.words.assign(words.begin(), words.end());
    Setting setting = given;
    const uint64_t first = setting.options.sphere.rotation;
    const bool estimates = setting.options.sphere.accuracy > 0;
    const auto repeats = static_cast<uint64_t>(options_.repeats);
    bool whole = true;
    for (uint64_t r = 1; whole && r <= repeats; ++r) {
      rotate(setting, first + r);
      whole = trials.run(setting, estimates, true, trial);
    }
    const size_t wanted = statesErrors(setting.options) ? kEstimates : 0;
    for (uint64_t r = repeats + 1; whole && trial.estimates.size() < wanted; ++r) {
      rotate(setting, first + r);
      whole = trials.run(setting, true, false, trial);
    }
    return whole;
  }

  // Returns false after a signal.
  bool makeReference(Trials& trials, double target, Measured& measured) const {
    Setting setting = settingOf(referenceWords(options_.sphereMode));
    Trial trial;
    ReferenceProgress at;
    at.leastRotations = kLeastRotations;
    at.points = trials.points();
    at.target = target;
    const unsigned threads = threadCount(options_.threads);
    at.moreThreads = threads < threadCount(0);
    const auto start = Clock::now();
    const auto elapsed = [&start] { return std::chrono::duration<double>(Clock::now() - start).count(); };
    double said = 0;  // total time predicted by the last warning
    const auto saySlow = [&] {
      const double whole = at.seconds + secondsLeft(at);
      const std::string slow = slowReference(at);
      if (slow.empty() || whole < 2 * said) return;
      messages_.warning(slow);
      said = whole;
    };
    std::mutex mutex;
    size_t answered = 0;  // answered points of the first rotation
    const auto firstPoints = [&] {
      const std::lock_guard lock(mutex);
      ++answered;
      if (answered < threads || answered >= at.points) return;
      at.rotations = static_cast<double>(answered) / static_cast<double>(at.points);
      at.seconds = elapsed();
      saySlow();
    };
    for (uint64_t r = 0; r < kMostRotations; ++r) {
      rotate(setting, kReferenceRotation + r);
      if (!trials.run(setting, false, false, trial, r == 0 ? firstPoints : std::function<void()>()))
        return false;
      measured.reference.emplace(trial.answers);
      at.rotations = static_cast<double>(r + 1);
      at.seconds = elapsed();
      at.error = measured.reference->error();
      progress(fmt::format(
          "reference: rotation {}{}, about {} left", r + 1,
          canPredict(at) ? fmt::format(", error {:.3f}%, {:.3f}% wanted", 100 * at.error, 100 * target) : "",
          durationText(secondsLeft(at))));
      saySlow();
      if (r + 1 >= kLeastRotations && at.error <= target) break;
    }
    return true;
  }

  // Ends early after a signal.
  void measureAll(std::span<const std::vector<std::string>> words, std::span<const Setting> settings,
                  Trials& trials, Measured& measured) const {
    if (measured.reference->isDark())
      messages_.warning("no light arrives at the points: relative errors are undefined");
    std::vector<double> costs;
    for (const Setting& setting : settings) costs.push_back(costOf(setting.options));
    const auto start = Clock::now();
    for (size_t i = 0; i < settings.size(); ++i) {
      measured.last = Trial();
      if (!measure(words[i], settings[i], trials, measured.last)) return;
      measured.settings.push_back(figuresOf(std::exchange(measured.last, {}), *measured.reference));
      const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
      progress(fmt::format("setting {} of {}: {:.1f} ms a point, {:.3f}%; {} so far, about {} left", i + 1,
                           settings.size(), 1e3 * measured.settings.back().seconds,
                           100 * measured.settings.back().rms, durationText(seconds),
                           durationText(secondsLeft(costs, i + 1, seconds))));
    }
  }

  // Reports the measurements. Throws rad::Error (Status::signal) if a signal ended them.
  void conclude(Measured measured, double accuracy) const {
    if (!measured.referenceIsDone)
      messages_.warning(fmt::format("no setting has been measured yet; rotations of the reference so far: {}",
                                    measured.reference ? measured.reference->repeats() : 0));
    size_t repeatsOfLast = measured.last.answers.repeats();
    if (repeatsOfLast >= kLeastRepeats)
      measured.settings.push_back(figuresOf(measured.last, *measured.reference));
    else
      repeatsOfLast = 0;
    markBest(measured.settings);
    if (!measured.settings.empty()) report(measured.settings, repeatsOfLast, *measured.reference, accuracy);
    signals_.defer(false);
    signals_.check();
  }

  void progress(const std::string& text) const {
    if (options_.progressSeconds > 0 || isatty(2) == 1) messages_.report(text);
  }

  // repeatsOfLast: number of repeats of the last setting if a signal ended it early; otherwise 0.
  void report(const std::vector<Figures>& all, size_t repeatsOfLast, const Reference& reference,
              double accuracy) const {
    std::string text = fmt::format(
        "{} points; reference: {} rotations of \"{}\", relative standard error {:.3f}% (mean over the points "
        "{:.3f}%)\n",
        reference.points(), reference.repeats(), fmt::join(referenceWords(options_.sphereMode), " "),
        100 * reference.error(), 100 * reference.meanError());
    text += tradeTable(all);
    if (repeatsOfLast > 0)
      text += fmt::format("The last setting has {} of {} repeats.\n", repeatsOfLast, options_.repeats);
    text += bouncesText(options_.ray.ambientBounces) + '\n';
    TradeSubject subject;
    subject.bounces = options_.ray.ambientBounces;
    subject.scene =
        fmt::format("{}", fmt::join(std::span(options_.scene).first(options_.scene.size() - 1), " "));
    subject.pointsFile = options_.scene.back();
    subject.pointsInFile = pointsInFile_;
    subject.points = points_;
    subject.perPoint = static_cast<size_t>(options_.numbersPerRecord());
    subject.accuracy = accuracy;
    subject.recommended = recommend(all, accuracy);
    const Figures& chosen = all[subject.recommended.index];
    subject.command = pasteLine(chosen.words);
    subject.given = givenLine();
    subject.referenceWords = fmt::format("{}", fmt::join(referenceWords(options_.sphereMode), " "));
    subject.repeats = options_.repeats;
    subject.repeatsOfLast = repeatsOfLast;
    text +=
        subject.recommended.sure
            ? fmt::format("\nThe fastest for an rms error of {:g}% (95% sure: below {:.3f}%):\n  {}\n",
                          100 * accuracy, 100 * chosen.rmsAtMost, subject.command)
            : fmt::format("\nNone is sure to have an rms error of {:g}%; the nearest, with {:.3f}%:\n  {}\n",
                          100 * accuracy, 100 * chosen.rms, subject.command);
    // If one of the outputs fails, the others are still written, because measuring again would take long.
    std::exception_ptr fault;
    const auto attempt = [&fault](const auto& write) {
      try {
        write();
      } catch (const rad::Error&) {
        if (!fault) fault = std::current_exception();
      }
    };
    if (!options_.table.empty()) attempt([&] { writeTextFile(options_.table, tradeCsv(all, reference)); });
    if (!options_.plot.empty()) attempt([&] { writeTextFile(options_.plot, tradePlot(all, subject)); });
    if (!options_.page.empty())
      attempt([&] { writeTextFile(options_.page, tradePage(all, reference, subject, std::time(nullptr))); });
    attempt([&] {
      RecordWriter out(1);
      out.write(text);
      out.flush();
    });
    if (fault) std::rethrow_exception(fault);
  }

  // A command line of rsphere with the given options, overridden by those of the setting.
  std::string pasteLine(std::span<const std::string> words) const {
    std::vector<std::string> line{"rsphere"};
    for (const UsedOption& option : used_) {
      const std::string_view name = option.entry->name;
      if (option.entry->group == Group::companion || name == "-Sa" || name == "-t" ||
          std::ranges::find(words, name) != words.end())
        continue;
      line.insert(line.end(), option.words.begin(), option.words.end());
    }
    line.insert(line.end(), words.begin(), words.end());
    line.insert(line.end(), options_.scene.begin(), options_.scene.end() - 1);
    return shellLine(line) + " < " + shellWord(options_.scene.back());
  }

  // The command line of this program.
  std::string givenLine() const {
    std::vector<std::string> words{"rsphere-trade"};
    words.insert(words.end(), options_.words.begin(), options_.words.end());
    words.insert(words.end(), options_.scene.begin(), options_.scene.end());
    return shellLine(words);
  }

  const TradeOptions& options_;
  std::span<const UsedOption> used_;
  const Messages& messages_;
  StopSignals& signals_;
  size_t pointsInFile_ = 0;
  std::vector<double> points_;  // measured points
};

// Measures the settings of ladder() at the points in a file, prints the result on standard output, and writes
// the files of -Tc, -Tp and -Th. The last word of options.scene is the file of points. After a signal,
// reports the finished measurements and throws rad::Error with Status::signal. Throws rad::Error for all
// errors. REQUIRES: options are from parseCompanion(), and `used` is its result.
void runTrade(const TradeOptions& options, std::span<const UsedOption> used, const Messages& messages,
              StopSignals& signals) {
  if (options.scene.size() < 2)
    throw rad::Error("missing argument: a scene and a file of points are needed; see -help");
  const bool bounces =
      std::ranges::any_of(used, [](const UsedOption& option) { return option.entry->name == "-ab"; });
  if (!options.sphereMode && !bounces)
    throw rad::Error("-S-: needs -ab, because the settings of rays are compared with equal bounces");
  if (options.sphere.glare.wanted) throw rad::Error("-Su: the errors of glare are stated by -oUVBG");
  if (options.separate)
    throw rad::Error("-Sp: errors are measured for sums, not for the parts of contributors");
  requireSvgName("-Tp", options.plot, "the plot");
  Trade(options, used, messages, signals).run();
}

}  // namespace
}  // namespace rsphere

int main(int argc, char** argv) {
  using namespace rsphere;
  TradeOptions options;
  return runCompanion(tradeCompanion(), argc, argv, options,
                      [&](std::span<const UsedOption> used, const Messages& messages, StopSignals& signals) {
                        runTrade(options, used, messages, signals);
                        return 0;
                      });
}
