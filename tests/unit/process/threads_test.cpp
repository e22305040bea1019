#include "process/threads.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <mutex>
#include <set>
#include <thread>

namespace rsphere {
namespace {

TEST(Threads, ZeroIsOneForEachCore) {
  EXPECT_EQ(threadCount(0), std::max(1u, std::thread::hardware_concurrency()));
  EXPECT_EQ(wantedThreads(0), std::max(1u, std::thread::hardware_concurrency()));
  EXPECT_EQ(wantedThreads(7), 7u);
}

// Half of the memory limit, a gigabyte, is for stacks of 64 MB.
TEST(Threads, AreAsManyAsHaveRoomForTheirStacks) {
  struct rlimit before {};
  ASSERT_EQ(getrlimit(RLIMIT_DATA, &before), 0);
  struct rlimit gigabyte = before;
  gigabyte.rlim_cur = rlim_t{1} << 30;
  ASSERT_EQ(setrlimit(RLIMIT_DATA, &gigabyte), 0);
  const unsigned many = threadCount(1000), few = threadCount(5);
  setrlimit(RLIMIT_DATA, &before);
  EXPECT_EQ(many, 8u);
  EXPECT_EQ(few, 5u);
}

TEST(Threads, EachWorkerRunsOnceBesideTheCaller) {
  const std::thread::id caller = std::this_thread::get_id();
  std::mutex mutex;
  std::multiset<unsigned> workers;
  runOnThreads(3, [&](unsigned worker) {
    EXPECT_NE(std::this_thread::get_id(), caller);
    const std::lock_guard lock(mutex);
    workers.insert(worker);
  });
  EXPECT_EQ(workers, (std::multiset<unsigned>{0, 1, 2}));
}

}  // namespace
}  // namespace rsphere
