#pragma once
#include <span>
#include <string>

#include "compare/comparison.h"

namespace rsphere {

// A table of the figures, a line for each channel; then the verdicts and the conclusion.
std::string figuresText(const Comparison& comparison, double tolerance);

// For points: the -Cn at which the original's answers are as noisy as rsphere's (green), and the CPU time
// that it would take then. Both are predicted from its noise and its time with `orientations` planes. The
// planes are spread evenly: the error of smooth irradiance falls with their number, and that of random
// irradiance with its square root, so that the text gives both predictions. The time is proportional to -Cn,
// except for loading. Seconds are those of all repeats.
std::string equalErrorText(const Comparison& comparison, int orientations, double ourSeconds,
                           double originalSeconds);

// A histogram of the records' relative differences of brightness. The limits of its classes are
// multiples of the tolerance.
std::string histogramText(std::span<const RecordDifference> records, double tolerance);

// Writes the relative differences as a picture of width * height pixels, whose upper left corner is the first
// record. The name determines the format. Formats of radiance (HDR, EXR, TIFF) get the absolute differences
// in three equal channels. Other formats range from blue (the original is brighter by ten tolerances) through
// white to red. Throws rad::Error (Status::system) if the picture cannot be written.
void writeDifferences(const std::string& name, int64_t width, int64_t height,
                      std::span<const RecordDifference> records, double tolerance);

}  // namespace rsphere
