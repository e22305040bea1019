#pragma once
#include <string>
#include <string_view>

#include "answer/header.h"
#include "rcontrib/contribution_options.h"

namespace rsphere {

// The offset of the records in a file that a run with -r is to complete. bytes: its contents. Throws
// rad::Error if its header shows that its records are not those of this run: a line of the layout differs, or
// the command line in it has other options that determine records, or another scene.
size_t recordsBeginIn(const std::string& file, std::string_view bytes, const ContributionOptions& options,
                      const RecordLayout& layout);

}  // namespace rsphere
