#pragma once
// How often a run says how far it is.

namespace rsphere {

// Seconds between reports where -t does not say: long enough for short jobs to say nothing.
inline constexpr double kReportSeconds = 5;

// Which of the program's streams are a terminal, where a person reads or types.
struct Terminals {
  bool input = false, output = false, messages = false;
};

// The interval of the reports on records (s); 0: none. asked: -t, if `given`. Otherwise a person who sees the
// messages gets reports, unless records are typed or answers appear on the terminal too. A program that reads
// the messages gets none.
inline double reportSeconds(double asked, bool given, const Terminals& terminal) {
  const bool alone = terminal.messages && !terminal.input && !terminal.output;
  return given || !alone ? asked : kReportSeconds;
}

}  // namespace rsphere
