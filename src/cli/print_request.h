#pragma once
#include "answer/messages.h"
#include "cli/option_table.h"

namespace rsphere {

// Prints the text of -version, -defaults, -help or -features on standard output. Returns the exit status: 1,
// with a message, if a feature is missing. Throws the errors of RecordWriter.
// REQUIRES: options.request is not Request::answers.
int printRequest(const Options& options, const Messages& messages);

int printRequest(const Companion& companion, Options& options, const Messages& messages);

}  // namespace rsphere
