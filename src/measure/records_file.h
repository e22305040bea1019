#pragma once
#include <string>
#include <vector>

#include "answer/answer_options.h"

namespace rsphere {

// The numbers of all records of a file ("-": standard input): rays of six numbers, or in sphere mode points
// of three, in the format of -f. Throws rad::Error, with the file's name and the line, as RecordReader does;
// Status::system where the file cannot be read, and Status::input where there is no record in it, or where
// text is read as floats or doubles.
std::vector<double> readRecords(const std::string& name, const AnswerOptions& options);

}  // namespace rsphere
