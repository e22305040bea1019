#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "answer/answer_options.h"

namespace rsphere {

// The name of an -o letter, as in -defaults; empty: it has none (c of rays, as in rtrace).
std::string_view letterName(char letter, const AnswerOptions& options);

// The names of the columns of a record (-Sf), for each letter of -o in turn, a word each: the name of the
// letter with a suffix for red, green and blue, bands, coordinates, faces and zones; with contributors, also
// the number of the contributor. As in rtrace, a tilde has no columns.
std::vector<std::vector<std::string>> columnNames(const AnswerOptions& options);
// The number of all columns, for NCOMP= of the header.
int componentCount(const AnswerOptions& options);

}  // namespace rsphere
