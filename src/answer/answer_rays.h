#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "answer/answer_writer.h"
#include "answer/batch.h"
#include "transport/transport.h"

namespace rsphere {

// The seed of the random numbers of a ray. It depends on the six numbers of the ray and on -Sr; with -u+ it
// also depends on index, the number of its record from 0, so that a repeated ray is a new sample.
uint64_t seedOfRay(std::span<const double> numbers, uint64_t index, const AnswerOptions& options);

// A tracer for each thread of -n. The transport must live as long.
std::vector<PathTracer> rayTracers(const Transport& transport, const AnswerOptions& options);

// The function that answers rays as rtrace does, with their trees (-ot). Warns, as rtrace does, if values are
// asked for and the scene has no light source. All arguments must live as long as the result.
AnswerRecord answerRays(const Transport& transport, const AnswerOptions& options, const AnswerWriter& writer,
                        const rad::Warn& warn);

}  // namespace rsphere
