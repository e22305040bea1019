#pragma once
#include <string>

#include "cli/option_table.h"

namespace rsphere {

// Exit statuses of rsphere-compare. Every fault is `trouble`, as with cmp(1), except a signal (3).
enum class CompareStatus { same = 0, differs = 1, trouble = 2, undecided = 4 };

// What rsphere-compare has besides rsphere's options.
struct CompareOptions : Options {
  double tolerance = .01;     // -Ct
  double shareBeyond = .001;  // -Cs
  int repeats = 8;            // -Cr
  int worst = 5;              // -Cw
  int orientations = 128;     // -Cn
  std::string differences;    // -Cp
};

// Its options, for parseCompanion() with a CompareOptions. Ray mode holds unless -S says otherwise.
const Companion& compareCompanion();

}  // namespace rsphere
