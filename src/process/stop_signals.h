#pragma once
#include <string>

#include "rad_parser/error.h"

namespace rsphere {

// Handles the signals that ask a program to end (INT HUP TERM ALRM XCPU XFSZ) as in rtrace: it ends with a
// message "rsphere: signal - Terminate" and exit status 3.
// - Before defer(true), a signal ends the program at once. Afterwards, raised() becomes true and descriptor()
//   becomes readable. The program then has 15 seconds to write its finished answers; that takes time only if
//   the output is blocked. A second signal ends it at once.
// - A second signal within 50 ms is part of one request: timeout(1) sends its signal to the process and to
//   its group, and systemd sends HUP after TERM.
// - Signals that were ignored remain ignored. SIGPIPE is ignored: a closed pipe is an error of write(2).
// - The descriptors 0 to 2 are reserved for standard input, output and error, even if these are closed.
// Only one object may exist in a process at a time, because signal handlers can only access process-wide
// state; all of it is in stop_signals.cpp. The destructor restores the previous handlers.
class StopSignals {
 public:
  // `program` begins the message. Throws rad::Error (Status::system) if no descriptor is available.
  explicit StopSignals(const std::string& program);
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  // Sets the file for the message if a signal ends the program at once; by default it is standard error.
  void reportTo(int fd);
  void defer(bool on);

  bool raised() const;
  // Throws rad::Error (Status::signal, with the signal's name) if a signal was raised.
  void check() const {
    if (raised()) throw rad::Error(name(), rad::Status::signal);
  }
  int descriptor() const;

  // The name of the signal in rtrace's words, such as "Terminate"; empty if no signal was raised. The caller
  // must then write the message.
  std::string name() const;
};

}  // namespace rsphere
