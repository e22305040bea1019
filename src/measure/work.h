#pragma once
#include <cstddef>
#include <functional>

#include "cli/options.h"
#include "cli/stop_signals.h"

namespace rsphere {

// Calls work(index, worker) for each index below count, on as many threads as -n asks for; `worker` counts
// them from 0. Throws what work throws first. Once a signal came (signals may be null) no more are begun, and
// the answer is false.
bool forEachIndex(size_t count, const Options& options, const StopSignals* signals,
                  const std::function<void(size_t index, unsigned worker)>& work);

// CPU time of this thread, and of the process, s.
double threadSeconds();
double processSeconds();

}  // namespace rsphere
