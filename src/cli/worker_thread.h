#pragma once
#include <pthread.h>

#include <functional>

namespace rsphere {

// A thread with a stack that paths of many surfaces fit into, which are traced one inside the other: 64 MB,
// of which the system gives what is used. Joined with its end. Throws std::system_error where it cannot be
// started.
class WorkerThread {
 public:
  static constexpr size_t kStack = size_t{64} << 20;

  explicit WorkerThread(std::function<void()> work);
  ~WorkerThread();
  WorkerThread(const WorkerThread&) = delete;
  WorkerThread& operator=(const WorkerThread&) = delete;

 private:
  std::function<void()> work_;
  pthread_t thread_;
};

}  // namespace rsphere
