#include "cli/program.h"

#include <new>
#include <string>
#include <vector>

#include "answer/header.h"
#include "cli/print_request.h"

namespace rsphere {

int exitStatus(const Messages& messages, const std::function<int()>& program, int faultStatus) {
  const auto fault = [&](const rad::Error& error) {
    const int status = messages.error(error);
    return faultStatus == 0 || error.status() == rad::Status::signal ? status : faultStatus;
  };
  try {
    return program();
  } catch (const rad::Error& error) {
    return fault(error);
  } catch (const std::bad_alloc&) {
    return fault(rad::Error("out of memory", rad::Status::system));
  }
}

int runCompanion(const Companion& companion, int argc, char** argv, Options& options,
                 const CompanionRun& run) {
  const std::string program(companion.name);
  Messages messages(program);
  const auto inside = [&] {
    StopSignals signals(program);
    const std::vector<std::string> words(argv, argv + argc);
    const std::vector<UsedOption> used = parseCompanion(words, companion, options);
    messages.use(options.messages, commandLine(options, true));
    signals.reportTo(messages.descriptor());
    if (options.request != Request::answers) return printRequest(options, messages, &companion);
    return run(used, messages, signals);
  };
  return exitStatus(messages, inside, companion.faultStatus);
}

}  // namespace rsphere
