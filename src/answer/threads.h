#pragma once
#include <functional>
#include <string>

namespace rsphere {

// The number of threads that -n asks for: `asked`, or one for each core where it is 0.
unsigned wantedThreads(int asked);

// The number of threads to start: those wanted, but no more than have room for their stacks (64 MB each) in
// half of the memory that the process may have (RLIMIT_DATA, RLIMIT_AS), and at least one. The other half is
// for the scene and the answers. The same at each call, unless these limits change.
unsigned threadCount(int asked);

// Calls work(worker) on each of `count` new threads, with worker = 0, 1, ..., and returns when all of them
// have ended. Each thread has a stack of 64 MB, of which the system provides the pages that are used: the
// surfaces along a path are traced recursively, and a path may meet many. If the system starts only some of
// the threads, calls fewer(started, reason) and goes on with those. Throws rad::Error (Status::system) if it
// starts none. Meanwhile, watch(started) runs on the calling thread. REQUIRES: none of them throws.
void runOnThreads(unsigned count, const std::function<void(unsigned worker)>& work,
                  const std::function<void(unsigned started, const std::string& reason)>& fewer = {},
                  const std::function<void(unsigned started)>& watch = {});

}  // namespace rsphere
