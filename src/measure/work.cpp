#include "measure/work.h"

#include <algorithm>
#include <atomic>
#include <ctime>
#include <exception>
#include <mutex>

#include "answer/threads.h"

namespace rsphere {
namespace {

double secondsOf(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

double threadSeconds() { return secondsOf(CLOCK_THREAD_CPUTIME_ID); }
double processSeconds() { return secondsOf(CLOCK_PROCESS_CPUTIME_ID); }

bool forEachIndex(size_t count, int threads, const StopSignals* signals,
                  const std::function<void(size_t index, unsigned worker)>& work) {
  std::atomic<size_t> next{0};
  std::atomic<bool> stopped{false};
  std::exception_ptr error;
  std::mutex mutex;
  const auto run = [&](unsigned worker) {
    try {
      while (!stopped) {
        if (signals != nullptr && signals->raised()) {
          stopped = true;
          return;
        }
        const size_t index = next++;
        if (index >= count) return;
        work(index, worker);
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!error && (signals == nullptr || !signals->raised())) error = std::current_exception();
      stopped = true;
    }
  };
  const size_t most = std::max<size_t>(count, 1);
  runOnThreads(static_cast<unsigned>(std::min<size_t>(threadCount(threads), most)), run);
  if (error) std::rethrow_exception(error);
  return !stopped;
}

}  // namespace rsphere
