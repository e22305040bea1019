#pragma once
#include <string>

#include "cli/option_table.h"

namespace rsphere {

// Exit statuses of rsphere-compare. Every fault is `trouble`, as with cmp(1), except a signal (3).
enum class CompareStatus { same = 0, differs = 1, trouble = 2, undecided = 4 };

// The options of rsphere-compare: those of rsphere, and its own.
struct CompareOptions : Options {
  double tolerance = .01;     // -Ct
  double shareBeyond = .001;  // -Cs
  int repeats = 8;            // -Cr
  int worst = 5;              // -Cw
  int orientations = 128;     // -Cn
  std::string differences;    // -Cp
  std::string page;           // -Ch
};

// rsphere-compare, for parseCompanion() with a CompareOptions. It is in ray mode unless
// -S switches to sphere mode.
const Companion& compareCompanion();

}  // namespace rsphere
