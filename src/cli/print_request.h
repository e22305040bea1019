#pragma once
#include "answer/messages.h"
#include "cli/option_table.h"

namespace rsphere {

// Prints the text of -version, -defaults, -help or -features on standard output. Returns the exit status: 1,
// with a message, if a feature is missing. Throws the errors of RecordWriter. companion: null for rsphere.
// REQUIRES: options.request is not Request::answers.
int printRequest(Options& options, const Messages& messages, const Companion* companion = nullptr);

}  // namespace rsphere
