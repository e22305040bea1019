#pragma once
#include "answer/messages.h"
#include "companions/compare/compare_options.h"

namespace rsphere {

// Answers records with rsphere and with the original, and prints a comparison on standard output. The last
// word of options.scene is the file of records. REQUIRES: options come from parseCompanion(), and `used` is
// its result. Throws rad::Error.
CompareStatus runCompare(CompareOptions options, std::span<const UsedOption> used, const Messages& messages);

}  // namespace rsphere
