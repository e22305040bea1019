#pragma once
#include "cli/messages.h"
#include "compare/compare_options.h"

namespace rsphere {

// Exit statuses of rsphere-compare. Every fault is `trouble`, as with cmp(1), but for a signal (3).
enum class CompareStatus { same = 0, differs = 1, trouble = 2, undecided = 4 };

// Answers the records of the last word of options.scene by rsphere and by the original, and prints on
// standard output how they compare. REQUIRES options from parseCompanion(), and `used` what it answered.
// Throws rad::Error.
CompareStatus runCompare(CompareOptions options, std::span<const UsedOption> used, const Messages& messages);

}  // namespace rsphere
