#pragma once
#include "answer/answer_options.h"
#include "answer/answer_writer.h"
#include "answer/batch.h"
#include "answer/progress.h"
#include "answer/run_summary.h"
#include "transport/transport.h"

namespace rsphere {

// Throws rad::Error if the records that have arrived need more pictures (-Si) than the name can number,
// before any of these pictures is drawn. Waits for the first record if there are pictures.
void requirePictureNames(const AnswerOptions& options, RecordReader& reader);

// The function that answers points in sphere mode: appends the spherical mean, or a record of each direction
// (-Sd), and writes pictures of the points (-Si). Warns if nothing in the scene emits light.
// pictureReport: receives the progress of pictures. All other arguments must exist as long as the result.
// Throws the errors of SphereEstimator.
AnswerRecord answerPoints(const Transport& transport, const AnswerOptions& options,
                          const AnswerWriter& writer, const rad::Warn& warn, RunSummary& summary,
                          const PictureProgress::Report& pictureReport = {});

}  // namespace rsphere
