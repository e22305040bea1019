#pragma once
#include <string>
#include <vector>

#include "answer/answer_options.h"

namespace rsphere {

// Reads the numbers of all records of a file ("-": standard input), in the format of -f: six numbers for a
// ray, or in sphere mode three for a point. Throws rad::Error with the file's name and line, like
// RecordReader; with Status::system if the file cannot be read, and with Status::input if it contains no
// record, or text instead of the expected floats or doubles.
std::vector<double> readRecords(const std::string& name, const AnswerOptions& options);

}  // namespace rsphere
