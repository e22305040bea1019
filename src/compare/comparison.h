#pragma once
// Statistics of the repeated answers of two programs to the same records.
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "base/colorimetry.h"

namespace rsphere {

// The answers of one program. The answer to record i in repeat r is at [r * records + i].
struct Answers {
  size_t records = 0, repeats = 0;
  std::vector<Color> values;
  const SpectralSampling* sampling = nullptr;  // of a spectral run, whose bands are compared
  const Color& of(size_t record, size_t repeat) const { return values[repeat * records + record]; }
};

// The result of the comparison with the tolerance, in ascending order of difference.
enum class Verdict {
  same,       // no bias is certain, and a bias as large as the tolerance is ruled out
  small,      // a bias is certain, but a bias as large as the tolerance is ruled out
  undecided,  // no bias above the tolerance is certain, but noise could hide one
  differs     // a bias above the tolerance is certain, or too many records differ by more than it
};

// The comparison of one channel, or of one band of a spectral run. The bias is relative to the mean of the
// original. The difference of a record is that of its means over the repeats; it is relative to the mean of
// both programs for the record, or to kDarkest times the mean of all records where this is larger.
struct ChannelComparison {
  std::string name;  // "red", or the middle of the band: "570 nm"
  double ourMean = 0, originalMean = 0;
  double bias = 0, biasError = 0;          // relative bias of the mean, and its standard error
  double chance = 1;                       // probability of so large a bias if there is none
  double rms = 0;                          // of the records' relative differences
  double noiseRms = 0;                     // the part of it that noise explains
  double ourNoise = 0, originalNoise = 0;  // relative standard deviation of single answers, rms
  std::array<double, 4> percentiles{};     // of the absolute relative differences: see kPercentiles
  double shareWithin = 0;                  // fraction of records within the tolerance
  size_t beyond = 0;                       // records that exceed it with certainty
  Verdict verdict = Verdict::same;
};
inline constexpr std::array<double, 4> kPercentiles = {.5, .9, .99, 1};
inline constexpr double kDarkest = .01;

// Probability of a false alarm, for the means of all channels together and for all records together.
inline constexpr double kFalseAlarm = .001;

struct RecordDifference {
  double difference = 0, error = 0;  // relative difference of brightness (photopic), and its standard error
};

struct Comparison {
  std::vector<ChannelComparison> channels = std::vector<ChannelComparison>(3);
  std::vector<RecordDifference> records;
  std::vector<size_t> worst;  // indexes, in descending order of the difference beyond noise
  Verdict verdict = Verdict::same;

  // Green, or the band in the middle of the spectrum.
  const ChannelComparison& middle() const { return channels[channels.size() / 2]; }
};

// The mean of the repeats for a record.
Color meanOf(const Answers& answers, size_t record);
// Its brightness, or photopic integral.
double brightnessOf(const Answers& answers, size_t record);

// Compares the answers of two programs. tolerance: relative. shareBeyond: the fraction of records that may
// exceed it. independentRecords: whether the errors of different records are independent. If they are not
// (points that share directions), the error of the mean is estimated from the means of whole repeats.
// Noise is assumed to be normal, and probabilities are those of Student's t: for a record with 2 (repeats -
// 1) degrees of freedom, and with Sidak's correction for the number of records.
// REQUIRES: both have the same records, at least one, and the same number of repeats, at least two.
Comparison compare(const Answers& ours, const Answers& original, double tolerance, double shareBeyond,
                   bool independentRecords);

}  // namespace rsphere
