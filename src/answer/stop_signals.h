#pragma once
#include <string>

#include "rad_parser/error.h"

namespace rsphere {

// Makes the signals that ask a program to end (INT HUP TERM ALRM XCPU XFSZ) end it as rtrace does: a message
// "rsphere: signal - Terminate" and exit status 3; a second one ends it at once. Signals that were ignored
// stay so. SIGPIPE is ignored: a closed pipe is an error of write(2) instead. Before defer(), the signal ends
// the program where it stands; after it, raised() says so and descriptor() becomes readable, and the program
// has 15 seconds to flush what it has finished. The same signal within 50 ms
// is the same request: timeout(1) sends it to the process and to its group. Keeps the numbers 0 to 2 for
// standard input, output and error, should one of them be closed. At most one at a time in a process: signal
// handlers can reach nothing but process-wide state, all of which is in stop_signals.cpp. The handlers before
// it come back with its end.
class StopSignals {
 public:
  // `program` begins the message. Throws rad::Error (Status::system) if there is no descriptor to be had.
  explicit StopSignals(const std::string& program);
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  // Where the message goes that a signal before defer() gives: standard error unless said otherwise.
  void reportTo(int fd);
  void defer(bool on);

  bool raised() const;
  // Throws rad::Error (Status::signal, the signal's name) if one came.
  void check() const {
    if (raised()) throw rad::Error(name(), rad::Status::signal);
  }
  int descriptor() const;

  // "Terminate" and so on, as rtrace words them; the message is then the caller's to give. Empty if no signal
  // came.
  std::string name() const;
};

}  // namespace rsphere
