#pragma once
#include <functional>
#include <span>

#include "answer/messages.h"
#include "cli/option_table.h"
#include "process/stop_signals.h"

namespace rsphere {

// Calls `program` and returns its exit status. If it throws, writes a message and returns the status that
// rtrace(1) gives the error: the status of the rad::Error, or 2 if memory is exhausted. A faultStatus above 0
// replaces the status of all errors except a signal and a closed pipe (3).
int exitStatus(const Messages& messages, const std::function<int()>& program, int faultStatus = 0);

// The main() of a companion. Parses the command line into `options` with parseCompanion(). Then prints the
// requested text (printRequest()), or calls `run`. Returns the exit status.
using CompanionRun =
    std::function<int(std::span<const UsedOption> used, const Messages& messages, StopSignals& signals)>;
int runCompanion(const Companion& companion, int argc, char** argv, Options& options,
                 const CompanionRun& run);

}  // namespace rsphere
