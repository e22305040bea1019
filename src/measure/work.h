#pragma once
#include <cstddef>
#include <functional>

#include "answer/stop_signals.h"

namespace rsphere {

// Calls work(index, worker) for each index below count, on threadCount(threads) threads, which
// `worker` numbers from 0. Throws the first exception that work throws. After a signal (signals may
// be null) no further call begins, calls under way may throw to end early, and the result is false.
// leave: ends the process; it may not return. Called on the calling thread where a call is still under way .1
// s after a signal, because no thread can be stopped within a call. If it is empty, the calls are awaited.
// Throws rad::Error (Status::system) if no thread can be started.
bool forEachIndex(size_t count, int threads, const StopSignals* signals,
                  const std::function<void(size_t index, unsigned worker)>& work,
                  const std::function<void()>& leave = {});

// CPU time, in seconds, of the calling thread and of the process.
double threadSeconds();
double processSeconds();

}  // namespace rsphere
