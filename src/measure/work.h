#pragma once
#include <cstddef>
#include <functional>

#include "answer/stop_signals.h"

namespace rsphere {

// Calls work(index, worker) for each index below count, on threadCount(threads) threads, which
// `worker` numbers from 0. Throws the first exception that work throws. After a signal (signals may
// be null) no further call begins, calls under way may throw to end early, and the result is false.
// Throws rad::Error (Status::system) if no thread can be started.
bool forEachIndex(size_t count, int threads, const StopSignals* signals,
                  const std::function<void(size_t index, unsigned worker)>& work);

// CPU time, in seconds, of the calling thread and of the process.
double threadSeconds();
double processSeconds();

}  // namespace rsphere
