#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "answer/answer_writer.h"
#include "answer/batch.h"
#include "transport/path_tracer.h"

namespace rsphere {

// The seed of the random numbers of a ray, the index-th record of the input from 0: it follows from the six
// numbers of the ray and from -Sr; with -u+ also from index, so that a repeated ray is another sample.
uint64_t seedOfRay(std::span<const double> numbers, uint64_t index, const AnswerOptions& options);

// A tracer for each thread of -n, which aims at the bright spots of the transport.
std::vector<PathTracer> rayTracers(const Transport& transport, const AnswerOptions& options);

// Rays in, what rtrace answers out, with their trees (-ot). Warns where values are asked for and there
// is no light source, as rtrace does. All that is given must live as long as the answer to be called for.
AnswerRecord answerRays(const Transport& transport, const AnswerOptions& options, const AnswerWriter& writer,
                        const rad::Warn& warn);

}  // namespace rsphere
