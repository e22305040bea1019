#pragma once
// What repeated answers of two programs to the same records say.
#include <array>
#include <cstddef>
#include <vector>

#include "base/rgb.h"

namespace rsphere {

// The answers of one program: of record i in repeat r at [r * records + i].
struct Answers {
  size_t records = 0, repeats = 0;
  std::vector<Rgb> values;
  const Rgb& of(size_t record, size_t repeat) const { return values[repeat * records + record]; }
};

// What differences come to, against the tolerance; the worst last.
enum class Verdict {
  same,       // no bias is certain, and one as large as the tolerance is ruled out
  small,      // a bias is certain, and one as large as the tolerance ruled out
  undecided,  // nothing beyond the tolerance is certain, but noise could hide it
  differs     // a bias above the tolerance is certain, or more records are beyond it than may be
};

// Of one channel. Relative to the original's mean; relative differences of a record to the mean of
// both programs' values, or to kDarkest of the mean where that is less. Of records, means over the repeats
// are meant.
struct ChannelComparison {
  double ourMean = 0, originalMean = 0;
  double bias = 0, biasError = 0;          // of the mean, relative, with its standard error
  double chance = 1;                       // that no bias gives one as large
  double rms = 0;                          // of records' relative differences
  double noiseRms = 0;                     // what of it noise accounts for
  double ourNoise = 0, originalNoise = 0;  // rms of the relative standard deviation of single answers
  std::array<double, 4> percentiles{};     // of records' relative differences' sizes: see kPercentiles
  double shareWithin = 0;                  // records within the tolerance
  size_t beyond = 0;                       // records that are beyond it whatever the noise
  Verdict verdict = Verdict::same;
};
inline constexpr std::array<double, 4> kPercentiles = {.5, .9, .99, 1};
inline constexpr double kDarkest = .01;

// Chance of a false alarm, for the means of all channels together and for all records together.
inline constexpr double kFalseAlarm = .001;

struct RecordDifference {
  double difference = 0, error = 0;  // relative, of brightness, with its standard error
};

struct Comparison {
  std::array<ChannelComparison, 3> channels;
  std::vector<RecordDifference> records;
  std::vector<size_t> worst;  // those that differ most beyond noise first
  Verdict verdict = Verdict::same;
};

// REQUIRES: both have the same records, at least one, and the same repeats, at least two. independentRecords:
// whether errors of one record have nothing to do with those of another; if they may (points that share
// directions), the error of the mean is told from that of whole repeats. tolerance: relative; shareBeyond:
// the share of records that may be beyond it.
// Noise is taken as normal: standard errors are means over repeats, and Student's t is asked how likely they
// are; per record with 2 (repeats - 1) degrees of freedom and Sidak's correction for the number of records.
Comparison compare(const Answers& ours, const Answers& original, double tolerance, double shareBeyond,
                   bool independentRecords);

}  // namespace rsphere
