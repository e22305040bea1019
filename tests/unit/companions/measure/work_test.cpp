#include "companions/measure/work.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <functional>
#include <stdexcept>
#include <thread>
#include <vector>

namespace rsphere {
namespace {

TEST(ForEachIndex, CallsEachOnce) {
  for (const int n : {1, 3}) {
    std::vector<std::atomic<int>> calls(100);
    EXPECT_TRUE(forEachIndex(calls.size(), n, nullptr, [&](size_t i, unsigned worker) {
      EXPECT_LT(worker, static_cast<unsigned>(n));
      ++calls[i];
    }));
    for (const auto& count : calls) EXPECT_EQ(count, 1);
  }
  EXPECT_TRUE(forEachIndex(0, 2, nullptr, [](size_t, unsigned) { FAIL(); }));
}

TEST(ForEachIndex, PassesFaultsOn) {
  EXPECT_THROW(forEachIndex(100, 2, nullptr,
                            [](size_t i, unsigned) {
                              if (i == 5) throw std::runtime_error("five");
                            }),
               std::runtime_error);
}

TEST(ForEachIndex, EndsOnASignal) {
  StopSignals signals("test");
  signals.defer(true);
  size_t calls = 0;
  EXPECT_FALSE(forEachIndex(100, 1, &signals, [&](size_t i, unsigned) {
    ++calls;
    if (i == 3) std::raise(SIGTERM);
  }));
  EXPECT_EQ(calls, 4u);
}

// A call that takes long may look for a signal itself.
TEST(ForEachIndex, ACallMayThrowAfterASignal) {
  StopSignals signals("test");
  signals.defer(true);
  EXPECT_FALSE(forEachIndex(100, 1, &signals, [&](size_t, unsigned) {
    std::raise(SIGTERM);
    signals.check();
  }));
}

// A call that does neither is left behind: the process ends with what there is.
TEST(ForEachIndexDeathTest, LeavesACallThatTakesLong) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto stopped = [](bool leaves) {
    StopSignals signals("test");
    signals.defer(true);
    const std::function<void()> leave = [] { _exit(7); };
    forEachIndex(
        2, 1, &signals,
        [](size_t, unsigned) {
          std::raise(SIGTERM);
          std::this_thread::sleep_for(std::chrono::milliseconds(400));
        },
        leaves ? leave : std::function<void()>());
    _exit(0);
  };
  EXPECT_EXIT(stopped(true), testing::ExitedWithCode(7), "");
  EXPECT_EXIT(stopped(false), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace rsphere
