#pragma once
#include "answer/messages.h"
#include "compare/compare_options.h"

namespace rsphere {

// Answers the records of the last word of options.scene by rsphere and by the original, and prints on
// standard output how they compare. REQUIRES options from parseCompanion(), and `used` what it answered.
// Throws rad::Error.
CompareStatus runCompare(CompareOptions options, std::span<const UsedOption> used, const Messages& messages);

}  // namespace rsphere
