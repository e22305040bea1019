#pragma once
#include <functional>

#include "cli/answer_writer.h"
#include "cli/batch.h"
#include "importance/estimator.h"

namespace rsphere {

// Points in, spherical means out, or every direction of them (-Sd); pictures of them (-Si). Warns where
// nothing can give light, and of points where -Sa is not reached. checkStop is called now and then while a
// picture is drawn; it may throw to give up. All that is given must live as long as the answer to be called
// for.
AnswerRecord answerPoints(const SphereEstimator& estimator, const Transport& transport,
                          const Options& options, const AnswerWriter& writer, const rad::Warn& warn,
                          std::function<void()> checkStop);

}  // namespace rsphere
