#include "process/memory_limit.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/sysinfo.h>
#include <sys/wait.h>
#include <unistd.h>

namespace rsphere {
namespace {

// The limit of the data of a process, in MB, after limitMemory() in a process that has these limits.
rlim_t megabytes(rlim_t data, rlim_t space) {
  int ends[2];
  EXPECT_EQ(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    struct rlimit limit {
      data, RLIM_INFINITY
    };
    setrlimit(RLIMIT_DATA, &limit);
    limit.rlim_cur = space;
    setrlimit(RLIMIT_AS, &limit);
    limitMemory();
    getrlimit(RLIMIT_DATA, &limit);
    [[maybe_unused]] const ssize_t n = write(ends[1], &limit.rlim_cur, sizeof limit.rlim_cur);
    _exit(0);
  }
  close(ends[1]);
  rlim_t is = 0;
  EXPECT_EQ(read(ends[0], &is, sizeof is), static_cast<ssize_t>(sizeof is));
  close(ends[0]);
  waitpid(child, nullptr, 0);
  return is == RLIM_INFINITY ? 0 : is >> 20;
}

TEST(MemoryLimit, WhatTheMachineHasUnlessThereIsOneAlready) {
  struct sysinfo machine {};
  ASSERT_EQ(sysinfo(&machine), 0);
  EXPECT_GE(megabytes(RLIM_INFINITY, RLIM_INFINITY), (machine.totalram * machine.mem_unit) >> 20);
  EXPECT_EQ(megabytes(rlim_t{1} << 50, RLIM_INFINITY), rlim_t{1} << 30);
  EXPECT_EQ(megabytes(RLIM_INFINITY, rlim_t{1} << 60), 0u);
}

}  // namespace
}  // namespace rsphere
