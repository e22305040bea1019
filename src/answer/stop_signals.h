#pragma once
#include <string>

#include "rad_parser/error.h"

namespace rsphere {

// Makes the signals that ask a program to end (INT HUP TERM ALRM XCPU XFSZ) end it as in rtrace, with a
// message "rsphere: signal - Terminate" and exit status 3.
// - Before defer(true), a signal ends the program at once. After it, raised() becomes true and
//   descriptor() becomes readable, and the program has 15 seconds to write the answers that it has
//   finished, which it needs only if the output is blocked. A second signal ends it at once.
// - A second signal within 50 ms belongs to the same request: timeout(1) sends its signal to the process and
//   to its group, and systemd sends HUP after TERM.
// - Signals that were ignored remain ignored. SIGPIPE is ignored: a closed pipe is an error of write(2).
// - The descriptors 0 to 2 are reserved for standard input, output and error, even if these are closed.
// At most one object at a time may exist in a process: signal handlers can only reach process-wide state, all
// of which is in stop_signals.cpp. The destructor restores the previous handlers.
class StopSignals {
 public:
  // `program` begins the message. Throws rad::Error (Status::system) if no descriptor is available.
  explicit StopSignals(const std::string& program);
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  // Sets the file for the message of a signal that ends the program at once; by default it is standard error.
  void reportTo(int fd);
  void defer(bool on);

  bool raised() const;
  // Throws rad::Error (Status::signal, with the signal's name) if a signal was raised.
  void check() const {
    if (raised()) throw rad::Error(name(), rad::Status::signal);
  }
  int descriptor() const;

  // The signal in rtrace's words, such as "Terminate"; empty if no signal was raised. The caller
  // must then write the message.
  std::string name() const;
};

}  // namespace rsphere
