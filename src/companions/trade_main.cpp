#include "cli/program.h"
#include "companions/trade/trade_run.h"

int main(int argc, char** argv) {
  using namespace rsphere;
  TradeOptions options;
  return runCompanion(tradeCompanion(), argc, argv, options,
                      [&](std::span<const UsedOption> used, const Messages& messages, StopSignals& signals) {
                        runTrade(options, used, messages, signals);
                        return 0;
                      });
}
