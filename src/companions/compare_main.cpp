#include "cli/program.h"
#include "companions/compare/compare_run.h"

int main(int argc, char** argv) {
  using namespace rsphere;
  CompareOptions options;
  return runCompanion(compareCompanion(), argc, argv, options,
                      [&](std::span<const UsedOption> used, const Messages& messages, StopSignals&) {
                        return static_cast<int>(runCompare(options, used, messages));
                      });
}
