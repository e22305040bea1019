#include "measure/work.h"

#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <stdexcept>
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

}  // namespace
}  // namespace rsphere
