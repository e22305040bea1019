#pragma once
#include <span>

#include "answer/messages.h"
#include "answer/stop_signals.h"
#include "trade/trade_options.h"

namespace rsphere {

// Measures the settings of ladder() at the points in the file that is the last word of options.scene,
// prints the result on standard output, and writes the files of -Tc, -Tp and -Th. After a signal, does so
// with the measurements that are finished, and throws rad::Error with Status::signal. Throws
// rad::Error for all faults.
// REQUIRES: options are from parseCompanion(), and `used` is its result.
void runTrade(const TradeOptions& options, std::span<const UsedOption> used, const Messages& messages,
              StopSignals& signals);

}  // namespace rsphere
