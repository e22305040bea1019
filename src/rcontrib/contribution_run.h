#pragma once
#include "answer/messages.h"
#include "answer/stop_signals.h"
#include "rcontrib/contribution_options.h"

namespace rsphere {

// Answers the rays of standard input with contributions. The options are those of finish(). Throws what
// loadScene(), Transport, Tracked, ContributionOutputs and runRecords() throw.
void runContributions(const ContributionOptions& options, const Messages& messages, StopSignals& signals);

}  // namespace rsphere
