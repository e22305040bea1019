#include "companions/measure/work.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <ctime>
#include <exception>
#include <mutex>

#include "base/stop_check.h"
#include "process/threads.h"

namespace rsphere {
namespace {

double secondsOf(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

using Clock = std::chrono::steady_clock;

// Time for calls that end soon after a signal.
constexpr std::chrono::milliseconds kGrace(100);
// Interval at which signals are checked.
constexpr std::chrono::milliseconds kGlance(20);

// The number of threads that have ended.
class Ended {
 public:
  void add() {
    const std::lock_guard lock(mutex_);
    ++count_;
    changed_.notify_all();
  }
  // Waits for this number of threads, but not beyond `end`. Returns whether they have ended.
  bool await(unsigned count, Clock::time_point end) {
    std::unique_lock lock(mutex_);
    return changed_.wait_until(lock, end, [&] { return count_ >= count; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  unsigned count_ = 0;
};

}  // namespace

double threadSeconds() { return secondsOf(CLOCK_THREAD_CPUTIME_ID); }
double processSeconds() { return secondsOf(CLOCK_PROCESS_CPUTIME_ID); }

bool forEachIndex(size_t count, int threads, const StopSignals* signals,
                  const std::function<void(size_t index, unsigned worker)>& work,
                  const std::function<void()>& leave) {
  std::atomic<size_t> next{0};
  std::atomic<bool> stopped{false};
  std::exception_ptr error;
  std::mutex mutex;
  const auto run = [&](unsigned worker) {
    const StopCheck stopCheck([&] {
      if (signals != nullptr) signals->check();
    });
    try {
      while (!stopped) {
        StopCheck::here();
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
  Ended ended;
  const auto watch = [&](unsigned started) {
    while (!ended.await(started, Clock::now() + kGlance))
      if (signals != nullptr && signals->raised() && !ended.await(started, Clock::now() + kGrace)) leave();
  };
  const size_t most = std::max<size_t>(count, 1);
  runOnThreads(
      static_cast<unsigned>(std::min<size_t>(threadCount(threads), most)),
      [&](unsigned worker) {
        run(worker);
        ended.add();
      },
      {}, leave ? watch : std::function<void(unsigned)>());
  if (error) std::rethrow_exception(error);
  return !stopped;
}

}  // namespace rsphere
