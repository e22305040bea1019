#include "process/threads.h"

#include <fmt/format.h>
#include <pthread.h>
#include <sys/resource.h>

#include <algorithm>
#include <limits>
#include <list>
#include <system_error>
#include <thread>

#include "rad_parser/error.h"

namespace rsphere {
namespace {

constexpr size_t kStack = size_t{64} << 20;  // bytes

void* call(void* work) {
  (*static_cast<std::function<void()>*>(work))();
  return nullptr;
}

// A thread with a stack of kStack bytes, joined by its destructor. std::thread cannot choose the stack size.
class Thread {
 public:
  // Throws std::system_error if the thread cannot be started.
  explicit Thread(std::function<void()> work) : work_(std::move(work)) {
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, kStack);
    const int fault = pthread_create(&thread_, &attributes, call, &work_);
    pthread_attr_destroy(&attributes);
    if (fault != 0) throw std::system_error(fault, std::generic_category());
  }
  ~Thread() { pthread_join(thread_, nullptr); }
  Thread(const Thread&) = delete;
  Thread& operator=(const Thread&) = delete;

 private:
  std::function<void()> work_;
  pthread_t thread_;
};

// The number of stacks that fit into half of the memory limit.
unsigned mostThreads() {
  rlim_t most = std::numeric_limits<unsigned>::max();
  for (const auto resource : {RLIMIT_DATA, RLIMIT_AS}) {
    struct rlimit limit {};
    if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) continue;
    most = std::min(most, limit.rlim_cur / 2 / kStack);
  }
  return static_cast<unsigned>(std::max<rlim_t>(most, 1));
}

}  // namespace

unsigned wantedThreads(int asked) {
  if (asked > 0) return static_cast<unsigned>(asked);
  return std::max(1u, std::thread::hardware_concurrency());
}

unsigned threadCount(int asked) { return std::min(wantedThreads(asked), mostThreads()); }

void runOnThreads(unsigned count, const std::function<void(unsigned)>& work,
                  const std::function<void(unsigned, const std::string&)>& fewer,
                  const std::function<void(unsigned)>& watch) {
  std::list<Thread> threads;
  try {
    for (unsigned i = 0; i < count; ++i) threads.emplace_back([&work, i] { work(i); });
  } catch (const std::system_error& error) {
    if (threads.empty())
      throw rad::Error(fmt::format("cannot start a thread: {}", error.what()), rad::Status::system);
    if (fewer) fewer(static_cast<unsigned>(threads.size()), error.what());
  }
  if (watch) watch(static_cast<unsigned>(threads.size()));
}

}  // namespace rsphere
