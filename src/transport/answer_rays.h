#pragma once
#include "cli/answer_writer.h"
#include "cli/batch.h"
#include "transport/path_tracer.h"

namespace rsphere {

// Rays in, what rtrace answers out, with their trees (-ot). Warns where values are asked for and nothing can
// give light. All that is given must live as long as the answer to be called for.
AnswerRecord answerRays(const Transport& transport, const Options& options, const AnswerWriter& writer,
                        const rad::Warn& warn);

}  // namespace rsphere
