#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "companions/compare/comparison.h"
#include "image/picture_file.h"

namespace rsphere {

// The warnings, one per line.
std::string warningsText(std::span<const std::string> warnings);

// A table of the figures, with a line for each channel or band; then the verdicts and the conclusion.
std::string figuresText(const Comparison& comparison, double tolerance);

// For points: the -Cn at which the original's answers would be as noisy as rsphere's (in green or the middle
// band), and the CPU time for it. Both are predicted from the original's noise and time with `orientations`
// planes. Because planes are evenly spread, the error falls in proportion to their number where irradiance is
// smooth, and with its square root where irradiance is random; the text gives both predictions. Time is
// proportional to -Cn, except for loading. Seconds are totals over all repeats.
std::string equalErrorText(const Comparison& comparison, int orientations, double ourSeconds,
                           double originalSeconds);

// The conclusion of figuresText(), without its full stop.
std::string_view conclusion(Verdict verdict);

std::string verdictText(const ChannelComparison& channel);

// Formats 0.0123 as "1.23%", with more decimals for smaller values; signedPercent() adds a sign.
std::string percent(double x);
std::string signedPercent(double x);

// The number of records in each class of relative differences of brightness. The limits of classes are
// multiples of the tolerance.
struct DifferenceClass {
  std::string low, high;
  size_t records = 0;
  bool within = false;  // whether the class is within the tolerance
};
std::vector<DifferenceClass> differenceClasses(std::span<const RecordDifference> records, double tolerance);

// A histogram of the relative differences of brightness of records.
std::string histogramText(std::span<const RecordDifference> records, double tolerance);

// The relative differences as a picture, from blue (the original is brighter by ten times the tolerance)
// through white to red.
Raster differencesOnScreen(int64_t width, int64_t height, std::span<const RecordDifference> records,
                           double tolerance);

// Writes the relative differences as a picture of width * height pixels; the first record is the upper left
// pixel. The name determines the format. Formats of radiance (HDR, EXR, TIFF) contain the absolute
// differences in three equal channels, other formats differencesOnScreen(). Throws rad::Error
// (Status::system) if the picture cannot be written.
void writeDifferences(const std::string& name, int64_t width, int64_t height,
                      std::span<const RecordDifference> records, double tolerance);

}  // namespace rsphere
