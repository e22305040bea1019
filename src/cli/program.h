#pragma once
#include <functional>

#include "answer/messages.h"
#include "cli/option_table.h"

namespace rsphere {

// Calls `program` and returns its exit status. If it throws, writes a message and returns the status that
// rtrace(1) gives the error: the status of the rad::Error, or 2 if memory is exhausted.
int exitStatus(const Messages& messages, const std::function<int()>& program);

// Prints the text of -version, -defaults, -help or -features on standard output. Returns the exit status: 1,
// with a message, if a feature is missing. Throws the errors of RecordWriter. companion: null for rsphere.
// REQUIRES: options.request is not Request::answers.
int printRequest(Options& options, const Messages& messages, const Companion* companion = nullptr);

}  // namespace rsphere
