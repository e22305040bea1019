#pragma once
#include <cstdint>
#include <span>

#include "answer/answer_writer.h"
#include "answer/batch.h"
#include "answer/run_summary.h"
#include "estimate/ray_estimator.h"
#include "transport/transport.h"

namespace rsphere {

// The seed of a ray's random numbers. It depends on the six numbers of the ray and on -Sr. With -u+ it also
// depends on index, the number of the record from 0, so that a repeated ray is a new sample.
uint64_t seedOfRay(std::span<const double> numbers, uint64_t index, const AnswerOptions& options);

// The function that answers rays like rtrace, including their trees (-ot). Like rtrace, it warns if values
// are requested and the scene has no light source; also of names of -te and -ti that are the modifier of no
// surface. The summary gets the sensors of -I. All arguments must exist as long as the result.
AnswerRecord answerRays(const Transport& transport, const AnswerOptions& options, const AnswerWriter& writer,
                        const rad::Warn& warn, RunSummary& summary);

}  // namespace rsphere
