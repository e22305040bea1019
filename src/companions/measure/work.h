#pragma once
#include <cstddef>
#include <functional>

#include "process/stop_signals.h"

namespace rsphere {

// Calls work(index, worker) for each index below count, on threadCount(threads) threads, numbered by `worker`
// from 0. Throws the first exception of work. After a signal (signals may be null) no further call begins,
// calls in progress may throw to end early, and the result is false. leave: ends the process; may return.
// Called on the calling thread if a call is still in progress .1 s after a signal, because not all work asks
// whether to stop (base/stop_check.h). If it is empty, calls in progress are awaited. Throws rad::Error
// (Status::system) if no thread can be started.
bool forEachIndex(size_t count, int threads, const StopSignals* signals,
                  const std::function<void(size_t index, unsigned worker)>& work,
                  const std::function<void()>& leave = {});

// CPU time, in seconds, of the calling thread and of the process.
double threadSeconds();
double processSeconds();

}  // namespace rsphere
