#pragma once
// Statistics of repeated answers of two programs to the same records.
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "base/colorimetry.h"

namespace rsphere {

// Answers of one program. The answer to record i in repeat r is at [r * records + i].
struct Answers {
  size_t records = 0, repeats = 0;
  std::vector<Color> values;
  const SpectralSampling* sampling = nullptr;  // of a spectral run, in which bands are compared
  const Color& of(size_t record, size_t repeat) const { return values[repeat * records + record]; }
};

// The result of a comparison with the tolerance, in ascending order of difference.
enum class Verdict {
  same,       // no bias is certain, and a bias above the tolerance is ruled out
  small,      // a bias is certain, but a bias above the tolerance is ruled out
  undecided,  // no bias above the tolerance is certain, but noise could hide one
  differs     // a bias above the tolerance is certain, or too many records exceed the tolerance
};

// The comparison of one channel, or of one band in a spectral run. The bias is relative to the mean of the
// original. The difference of a record is the difference between the two programs' means over the repeats. It
// is relative to the mean of both programs for the record, or to kDarkest times the mean over all records if
// that is larger.
struct ChannelComparison {
  std::string name;  // "red", or the middle wavelength of the band: "570 nm"
  double ourMean = 0, originalMean = 0;
  double bias = 0, biasError = 0;          // relative bias of the mean, and its standard error
  double chance = 1;                       // probability of a bias this large if there is none
  double rms = 0;                          // rms of the relative differences of the records
  double noiseRms = 0;                     // the part of rms that is explained by noise
  double ourNoise = 0, originalNoise = 0;  // relative standard deviation of single answers, rms
  std::array<double, 4> percentiles{};     // of the absolute relative differences: see kPercentiles
  double shareWithin = 0;                  // fraction of records within the tolerance
  size_t beyond = 0;                       // number of records that exceed it with certainty
  Verdict verdict = Verdict::same;
};
inline constexpr std::array<double, 4> kPercentiles = {.5, .9, .99, 1};
inline constexpr double kDarkest = .01;

// Probability of a false alarm, for the means of all channels together, and for all records together.
inline constexpr double kFalseAlarm = .001;

struct RecordDifference {
  double difference = 0, error = 0;  // relative difference of brightness (photopic), and its standard error
};

struct Comparison {
  std::vector<ChannelComparison> channels = std::vector<ChannelComparison>(3);
  std::vector<RecordDifference> records;
  std::vector<size_t> worst;  // indices, in descending order of the difference beyond noise
  Verdict verdict = Verdict::same;

  // The result for green, or for the middle band of the spectrum.
  const ChannelComparison& middle() const { return channels[channels.size() / 2]; }
};

// The mean over the repeats for a record.
Color meanOf(const Answers& answers, size_t record);
// The brightness (or photopic integral) of this mean.
double brightnessOf(const Answers& answers, size_t record);

// Compares the answers of two programs. tolerance: relative. shareBeyond: fraction of records that may exceed
// it. independentRecords: whether the errors of different records are independent; if not (points that share
// directions), the error of the mean is estimated from the means of whole repeats. Noise is assumed to be
// normal. Probabilities are those of Student's t with 2 (repeats - 1) degrees of freedom for a record, with
// Sidak's correction for the number of records. REQUIRES: both answer the same records, at least one, in an
// equal number of repeats, at least two.
Comparison compare(const Answers& ours, const Answers& original, double tolerance, double shareBeyond,
                   bool independentRecords);

}  // namespace rsphere
