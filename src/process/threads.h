#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace rsphere {

// The number of threads requested with -n: `asked`, or one for each core if it is 0.
unsigned wantedThreads(int asked);

// The number of threads to start: as many as requested, but at least one, and no more than have room for
// their stacks (64 MB each) in half of the memory limit (RLIMIT_DATA, RLIMIT_AS). The other half is for the
// scene and the answers. The result only changes with these limits.
unsigned threadCount(int asked);

// The results of threadCount(asked) calls of make(), one for each thread.
template <class Make>
auto forThreads(int asked, const Make& make) {
  auto all = std::make_shared<std::vector<decltype(make())>>();
  for (unsigned i = 0; i < threadCount(asked); ++i) all->push_back(make());
  return all;
}

// Calls work(worker) on each of `count` new threads, with worker = 0, 1, ..., and returns when all have
// ended. Each thread has a stack of 64 MB, because surfaces along a path are traced recursively, and a path
// may have many; the system provides only the pages that are used. If only some threads can be started, calls
// fewer(started, reason) and continues with them. Throws rad::Error (Status::system) if none can be started.
// Meanwhile, watch(started) runs on the calling thread. REQUIRES: none of these functions throws.
void runOnThreads(unsigned count, const std::function<void(unsigned worker)>& work,
                  const std::function<void(unsigned started, const std::string& reason)>& fewer = {},
                  const std::function<void(unsigned started)>& watch = {});

}  // namespace rsphere
