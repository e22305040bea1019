#pragma once
#include <span>
#include <string>

#include "compare/comparison.h"

namespace rsphere {

// The figures of each channel, a line each, and a line with what they come to.
std::string figuresText(const Comparison& comparison, double tolerance);

// Points: which -Cn gives the original the noise that rsphere's answers have (green), and the CPU time that
// it then takes, from what it took with `orientations`. Its planes are spread evenly: what varies smoothly
// with their direction has an error that falls with their number, what is random one that falls with its
// square root, so that two numbers are named. Its time is in proportion to -Cn, loading aside. Seconds are
// those of all repeats.
std::string equalErrorText(const Comparison& comparison, int orientations, double ourSeconds,
                           double originalSeconds);

// How many records have which relative difference of brightness, as bars; classes grow from the tolerance.
std::string histogramText(std::span<const RecordDifference> records, double tolerance);

// Writes relative differences as a picture of width * height, the first record at its upper left corner, in
// the format of the name: their sizes as three equal channels where it keeps radiance (HDR, EXR, TIFF), else
// from blue (the original is brighter by ten tolerances) by white to red. Throws rad::Error (Status::system)
// where it cannot be written.
void writeDifferences(const std::string& name, int64_t width, int64_t height,
                      std::span<const RecordDifference> records, double tolerance);

}  // namespace rsphere
