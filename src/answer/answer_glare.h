#pragma once
#include <vector>

#include "answer/answer_options.h"
#include "answer/answer_writer.h"
#include "answer/batch.h"
#include "answer/run_summary.h"
#include "estimate/glare_estimator.h"

namespace rsphere {

// The estimator of glare (-Su), with a workspace for each thread of -n.
class GlareWorkers {
 public:
  // Keeps a reference to the transport.
  GlareWorkers(const Transport& transport, const AnswerOptions& options);

  // record: eye and gaze. Throws rad::Error with the number of the record if the gaze is 0 or vertical.
  // REQUIRES: worker is below threadCount(options.threads), and no other call for it is in progress.
  GlareAnswer answer(const Record& record, unsigned worker);

 private:
  GlareEstimator estimator_;
  std::vector<SphereEstimator::Workspace> workspaces_;
};

// The function that answers eyes: appends the indices of glare, or a record of each glare source (-Sd). Warns
// if nothing in the scene emits light. All arguments must exist as long as the result.
AnswerRecord answerGlare(const Transport& transport, const AnswerOptions& options, const AnswerWriter& writer,
                         const rad::Warn& warn, RunSummary& summary);

}  // namespace rsphere
