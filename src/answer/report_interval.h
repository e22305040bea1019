#pragma once
// The interval between progress reports.

namespace rsphere {

// Seconds between reports without -t. Short jobs are finished before the first report.
inline constexpr double kReportSeconds = 5;

// Whether the program's streams are terminals, at which a person reads or types.
struct Terminals {
  bool input = false, output = false, messages = false;
};

// The interval between reports on records (s); 0: no reports. asked: -t, if `given`. Without -t, reports are
// written if a person sees the messages, unless records are typed or answers shown on the terminal as well.
// If a program reads the messages, there are none.
inline double reportSeconds(double asked, bool given, const Terminals& terminal) {
  const bool alone = terminal.messages && !terminal.input && !terminal.output;
  return given || !alone ? asked : kReportSeconds;
}

}  // namespace rsphere
