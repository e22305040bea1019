#pragma once
#include "answer/answer_options.h"
#include "answer/answer_writer.h"
#include "answer/batch.h"
#include "answer/run_summary.h"
#include "transport/transport.h"

namespace rsphere {

// The function that answers eyes with their gazes: appends the indices of glare, or a record of each glare
// source (-Sd). sources: writes records of the sources behind the indices, too. Warns if nothing in the scene
// emits light. The function throws rad::Error with the number of the record if the gaze is 0 or vertical. All
// arguments must exist as long as the result.
AnswerRecord answerGlare(const Transport& transport, const AnswerOptions& options, const AnswerWriter& writer,
                         const rad::Warn& warn, RunSummary& summary, const AnswerWriter* sources = nullptr);

}  // namespace rsphere
