#pragma once
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>

#include "answer/answer_writer.h"
#include "answer/batch.h"
#include "importance/estimator.h"

namespace rsphere {

// Collects the points at which -Sa was not reached, for one line at the end. May be called from any thread.
class Unreached {
 public:
  void add(uint64_t record, const PointAnswer& answer);

  // "-Sa 0.01 was not reached at 3 of 20 points with at most 8192 directions; the worst is record 7: 1.25%".
  // Empty if it was reached at all points.
  std::string summary(const SphereOptions& options) const;

 private:
  mutable std::mutex mutex_;
  uint64_t points_ = 0, missed_ = 0, worst_ = 0;
  double worstError_ = -1;  // relative standard error of the mean brightness
};

// Answers points with their spherical means, or with every direction (-Sd), and writes pictures of what
// they see (-Si). Warns if nothing can give light. checkStop is called before each set of directions
// and each row of a picture; it may throw to abandon a point. All arguments that are references must
// outlive the returned function.
AnswerRecord answerPoints(const SphereEstimator& estimator, const Transport& transport,
                          const AnswerOptions& options, const AnswerWriter& writer, const rad::Warn& warn,
                          Unreached& unreached, std::function<void()> checkStop);

}  // namespace rsphere
