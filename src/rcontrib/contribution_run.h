#pragma once
#include "answer/messages.h"
#include "process/stop_signals.h"
#include "rcontrib/contribution_options.h"

namespace rsphere {

// Answers the rays on standard input with contributions. REQUIRES: finish() was called for the options.
// Throws the errors of loadScene(), Transport, Tracked, ContributionOutputs and runRecords().
void runContributions(const ContributionOptions& options, const Messages& messages, StopSignals& signals);

}  // namespace rsphere
