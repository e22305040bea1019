#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compare/comparison.h"
#include "image/picture_file.h"

namespace rsphere {

// The warnings, a line for each.
std::string warningsText(std::span<const std::string> warnings);

// A table of the figures, a line for each channel or band; then the verdicts and the conclusion.
std::string figuresText(const Comparison& comparison, double tolerance);

// For points: the -Cn at which the original's answers are as noisy as rsphere's (green, or the middle band),
// and the CPU time that it would take then. Both are predicted from its noise and its time with
// `orientations` planes. The planes are spread evenly: the error of smooth irradiance falls with their
// number, and that of random irradiance with its square root, so that the text gives both predictions. The
// time is proportional to -Cn, except for loading. Seconds are those of all repeats.
std::string equalErrorText(const Comparison& comparison, int orientations, double ourSeconds,
                           double originalSeconds);

// The conclusion of figuresText(), without its full stop.
std::string_view conclusion(Verdict verdict);

// The verdict on a channel.
std::string verdictText(const ChannelComparison& channel);

// 0.0123 as "1.23%", with more decimals for smaller values; signedPercent() with a sign.
std::string percent(double x);
std::string signedPercent(double x);

// The number of records in each class of relative differences of brightness. The limits of the classes are
// multiples of the tolerance.
struct DifferenceClass {
  std::string low, high;
  size_t records = 0;
  bool within = false;  // the tolerance
};
std::vector<DifferenceClass> differenceClasses(std::span<const RecordDifference> records, double tolerance);

// A histogram of the records' relative differences of brightness.
std::string histogramText(std::span<const RecordDifference> records, double tolerance);

// The relative differences as a picture from blue (the original is brighter by ten tolerances) through white
// to red.
Raster differencesOnScreen(int64_t width, int64_t height, std::span<const RecordDifference> records,
                           double tolerance);

// Writes the relative differences as a picture of width * height pixels, whose upper left corner is the first
// record. The name determines the format. Formats of radiance (HDR, EXR, TIFF) get the absolute differences
// in three equal channels. Other formats get differencesOnScreen(). Throws rad::Error (Status::system) if the
// picture cannot be written.
void writeDifferences(const std::string& name, int64_t width, int64_t height,
                      std::span<const RecordDifference> records, double tolerance);

}  // namespace rsphere
