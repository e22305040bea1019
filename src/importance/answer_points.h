#pragma once
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>

#include "cli/answer_writer.h"
#include "cli/batch.h"
#include "importance/estimator.h"

namespace rsphere {

// Where -Sa was not reached, over all points: told at the end in one line. Called from any thread.
class Unreached {
 public:
  void add(uint64_t record, const PointAnswer& answer);

  // "-Sa 0.01 was not reached at 3 of 20 points with at most 8192 directions; the worst is record 7: 1.25%",
  // or nothing where it was reached everywhere.
  std::string summary(const SphereOptions& options) const;

 private:
  mutable std::mutex mutex_;
  uint64_t points_ = 0, missed_ = 0, worst_ = 0;
  double worstError_ = -1;  // standard error over mean, of brightness
};

// Points in, spherical means out, or every direction of them (-Sd); pictures of them (-Si). Warns where
// nothing can give light. checkStop is called now and then; it may throw to give a point up. All that is
// given must live as long as the answer to be called for.
AnswerRecord answerPoints(const SphereEstimator& estimator, const Transport& transport,
                          const Options& options, const AnswerWriter& writer, const rad::Warn& warn,
                          Unreached& unreached, std::function<void()> checkStop);

}  // namespace rsphere
