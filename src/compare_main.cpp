#include "cli/print_request.h"
#include "cli/stop_signals.h"
#include "compare/compare_run.h"

int main(int argc, char** argv) {
  using namespace rsphere;
  const std::string program = "rsphere-compare";
  Messages messages(program);
  const auto fault = [&](const rad::Error& error) {
    const int status = messages.error(error);
    return status == static_cast<int>(rad::Status::signal) ? status
                                                           : static_cast<int>(CompareStatus::trouble);
  };
  try {
    StopSignals signals(program);
    CompareOptions options;
    const std::vector<std::string> words(argv, argv + argc);
    const std::vector<UsedOption> used = parseCompanion(words, compareCompanion(), options);
    messages.use(options.messages, commandLine(options, true));
    signals.reportTo(messages.descriptor());
    if (options.request != Request::answers) return printRequest(compareCompanion(), options, messages);
    return static_cast<int>(runCompare(options, used, messages));
  } catch (const rad::Error& error) {
    return fault(error);
  } catch (const std::bad_alloc&) {
    return fault(rad::Error("out of memory", rad::Status::system));
  }
}
