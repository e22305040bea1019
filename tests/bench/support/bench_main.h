#pragma once
#include <fmt/format.h>

#include <cstdio>

#include "rad_parser/error.h"

namespace rsphere {

// The exit status of a benchmark: run()'s, or 1 after a line with what was thrown.
template <class Run>
int benchMain(const char* name, Run run, int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const rad::Error& error) {
    fmt::print(stderr, "{}: {}\n", name, error.what());
    return 1;
  }
}

}  // namespace rsphere
