#pragma once
#include "answer/messages.h"
#include "compare/compare_options.h"

namespace rsphere {

// Answers the records in the file that is the last word of options.scene with rsphere and with the original,
// and prints a comparison on standard output. REQUIRES: options are from parseCompanion(), and `used` is its
// result. Throws rad::Error.
CompareStatus runCompare(CompareOptions options, std::span<const UsedOption> used, const Messages& messages);

}  // namespace rsphere
