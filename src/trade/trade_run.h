#pragma once
#include <span>

#include "answer/messages.h"
#include "answer/stop_signals.h"
#include "trade/trade_options.h"

namespace rsphere {

// Measures the settings of the ladder at the points of the last word of options.scene, and prints what came
// of it on standard output. REQUIRES options from parseCompanion(), and `used` what it answered. After a
// signal, what was measured so far is printed (and written: -Tc -Tp), and rad::Error with Status::signal is
// thrown. Throws rad::Error.
void runTrade(const TradeOptions& options, std::span<const UsedOption> used, const Messages& messages,
              StopSignals& signals);

}  // namespace rsphere
