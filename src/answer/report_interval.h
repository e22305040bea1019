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
// written if messages go to a terminal, unless records are typed or answers are shown on the terminal as
// well.
inline double reportSeconds(double asked, bool given, const Terminals& terminal) {
  const bool alone = terminal.messages && !terminal.input && !terminal.output;
  return given || !alone ? asked : kReportSeconds;
}

}  // namespace rsphere
