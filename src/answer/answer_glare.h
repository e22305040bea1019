#pragma once
#include <functional>
#include <string>
#include <vector>

#include "answer/answer_options.h"
#include "answer/answer_writer.h"
#include "answer/batch.h"
#include "importance/glare_estimator.h"

namespace rsphere {

// The estimator of glare (-Su), with a workspace for each thread of -n.
class GlareWorkers {
 public:
  // checkStop is called now and then during an estimate; it may throw to abandon the eye. Keeps a reference
  // to the transport.
  GlareWorkers(const Transport& transport, const AnswerOptions& options,
               const std::function<void()>& checkStop = {});
  GlareWorkers(const GlareWorkers&) = delete;
  GlareWorkers& operator=(const GlareWorkers&) = delete;

  // record: eye and gaze. Throws rad::Error with the number of the record if the gaze has no length or is
  // vertical. REQUIRES: worker is below threadCount(options.threads), and no other call for it is under way.
  GlareAnswer answer(const Record& record, unsigned worker);

 private:
  GlareEstimator estimator_;
  std::vector<SphereEstimator::Workspace> workspaces_;
};

// The function that answers eyes: appends the indices of glare, or a record of every glare source (-Sd).
// Warns if nothing in the scene gives light. checkStop: see GlareWorkers; it is copied. The other arguments
// must live as long as the result.
AnswerRecord answerGlare(const Transport& transport, const AnswerOptions& options, const AnswerWriter& writer,
                         const rad::Warn& warn, const std::function<void()>& checkStop);

}  // namespace rsphere
