#pragma once
#include <string>

#include "cli/option_table.h"

namespace rsphere {

// Exit statuses of rsphere-compare. As with cmp(1), all errors are `trouble`, except a signal (3).
enum class CompareStatus { same = 0, differs = 1, trouble = 2, undecided = 4 };

// The options of rsphere-compare: its own and those of rsphere.
struct CompareOptions : Options {
  double tolerance = .01;     // -Ct
  double shareBeyond = .001;  // -Cs
  int repeats = 8;            // -Cr
  int worst = 5;              // -Cw
  int orientations = 128;     // -Cn
  std::string differences;    // -Cp
  std::string page;           // -Ch
};

// Describes rsphere-compare for parseCompanion(), with CompareOptions. It uses ray mode unless -S selects
// sphere mode.
const Companion& compareCompanion();

}  // namespace rsphere
