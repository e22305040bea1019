#pragma once
#include <span>

#include "answer/messages.h"
#include "companions/trade/trade_options.h"
#include "process/stop_signals.h"

namespace rsphere {

// Measures the settings of ladder() at the points in a file, prints the result on standard output, and writes
// the files of -Tc, -Tp and -Th. The last word of options.scene is the file of points. After a signal,
// reports the finished measurements and throws rad::Error with Status::signal. Throws rad::Error for all
// errors. REQUIRES: options are from parseCompanion(), and `used` is its result.
void runTrade(const TradeOptions& options, std::span<const UsedOption> used, const Messages& messages,
              StopSignals& signals);

}  // namespace rsphere
