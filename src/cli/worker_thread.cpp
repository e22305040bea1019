#include "cli/worker_thread.h"

#include <system_error>

namespace rsphere {
namespace {

void* call(void* work) {
  (*static_cast<std::function<void()>*>(work))();
  return nullptr;
}

}  // namespace

WorkerThread::WorkerThread(std::function<void()> work) : work_(std::move(work)) {
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, kStack);
  const int fault = pthread_create(&thread_, &attributes, call, &work_);
  pthread_attr_destroy(&attributes);
  if (fault != 0) throw std::system_error(fault, std::generic_category());
}

WorkerThread::~WorkerThread() { pthread_join(thread_, nullptr); }

}  // namespace rsphere
