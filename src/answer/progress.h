#pragma once
#include <chrono>
#include <functional>
#include <string>
#include <string_view>

namespace rsphere {

// Seconds between reports without -t. Short jobs are finished before the first report.
inline constexpr double kReportSeconds = 5;

// Whether the program's streams are terminals, at which a person reads or types.
struct Terminals {
  bool input = false, output = false, messages = false;
};

// The interval between reports on records (s); 0: no reports. asked: -t, if `given`. Without -t, reports are
// written if messages go to a terminal, unless records are typed or answers are shown on the terminal as
// well.
inline double reportSeconds(double asked, bool given, const Terminals& terminal) {
  const bool alone = terminal.messages && !terminal.input && !terminal.output;
  return given || !alone ? asked : kReportSeconds;
}

// Reports the progress of a picture at intervals:
//   "picture view.png: 34% after 5.0 seconds, about 10 seconds left"
class PictureProgress {
 public:
  // Receives a line; may be called from several threads at once. Null: nothing is reported.
  using Report = std::function<void(std::string_view)>;

  // seconds: time between reports.
  PictureProgress(std::string name, const Report& report, double seconds)
      : name_(std::move(name)), report_(report), seconds_(seconds) {}

  // done: 0 to 1.
  void at(double done);

 private:
  using Clock = std::chrono::steady_clock;

  std::string name_;
  const Report& report_;
  double seconds_;
  Clock::time_point start_ = Clock::now(), last_ = start_;
  Clock::time_point started_ = start_;  // when the initial part of the picture was finished
  double doneThen_ = 0;
};

}  // namespace rsphere
