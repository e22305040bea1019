#pragma once
#include <ctime>
#include <string>
#include <vector>

#include "companions/compare/comparison.h"

namespace rsphere {

// The subject of a comparison, and the parts of the report that are text.
struct CompareSubject {
  std::string scene, recordsFile;
  std::string given;                      // the command line of rsphere-compare
  std::string original, originalVersion;  // path and version of the program
  bool points = false;                    // records are points, not rays
  bool irradiance = false;                // answers are W/m2, not W/sr/m2
  double tolerance = 0;
  int64_t width = 0, height = 0;      // of the picture formed by the records; both 0 if they do not form one
  std::string worst, times;           // lines on the worst records; lines on CPU times and the like
  std::vector<std::string> warnings;  // warnings written to standard error
};

// An SVG plot of the brightness of rsphere's answers against the original's (means of the repeats), with
// logarithmic axes. If there are more than kMostMarks records, an evenly chosen subset and the worst ones are
// drawn. Records with an answer that is not above 0 are omitted.
std::string comparePlot(const Answers& ours, const Answers& original, const Comparison& comparison,
                        const CompareSubject& subject);
inline constexpr size_t kMostMarks = 2000;

// An HTML page with the verdict, the warnings, the figures, comparePlot(), a histogram, the pictures, and the
// rest of the report. REQUIRES: comparison was computed from these answers. Throws rad::Error
// (Status::system) if OpenImageIO, which encodes the pictures, cannot be loaded.
std::string comparePage(const Answers& ours, const Answers& original, const Comparison& comparison,
                        const CompareSubject& subject, std::time_t when);

}  // namespace rsphere
