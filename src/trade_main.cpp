#include "cli/print_request.h"
#include "cli/stop_signals.h"
#include "trade/trade_run.h"

int main(int argc, char** argv) {
  using namespace rsphere;
  const std::string program = "rsphere-trade";
  Messages messages(program);
  try {
    StopSignals signals(program);
    TradeOptions options;
    const std::vector<std::string> words(argv, argv + argc);
    const std::vector<UsedOption> used = parseCompanion(words, tradeCompanion(), options);
    messages.use(options.messages, commandLine(options, true));
    signals.reportTo(messages.descriptor());
    if (options.request != Request::answers) return printRequest(tradeCompanion(), options, messages);
    runTrade(options, used, messages, signals);
    return 0;
  } catch (const rad::Error& error) {
    return messages.error(error);
  } catch (const std::bad_alloc&) {
    return messages.error(rad::Error("out of memory", rad::Status::system));
  }
}
