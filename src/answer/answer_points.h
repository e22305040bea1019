#pragma once
#include <vector>

#include "answer/answer_options.h"
#include "answer/answer_writer.h"
#include "answer/batch.h"
#include "answer/progress.h"
#include "answer/run_summary.h"
#include "estimate/estimator.h"

namespace rsphere {

// The estimator of sphere mode, with a workspace for each thread of -n.
class PointWorkers {
 public:
  // standardError: whether PointAnswer should contain standard errors. Keeps a reference to the transport.
  // Throws the errors of SphereEstimator.
  PointWorkers(const Transport& transport, const AnswerOptions& options, bool standardError);

  // REQUIRES: worker is below threadCount(options.threads), and no other call for it is in progress.
  PointAnswer answer(const V3d& point, unsigned worker) {
    return estimator_.estimate(point, workspaces_[worker]);
  }

  const SphereEstimator& estimator() const { return estimator_; }
  // After answer(): the directions of the point, and their rays.
  SphereEstimator::Workspace& workspace(unsigned worker) { return workspaces_[worker]; }

 private:
  SphereEstimator estimator_;
  std::vector<SphereEstimator::Workspace> workspaces_;
};

// Throws rad::Error if the records that have arrived need more pictures (-Si) than the name can number,
// before any of these pictures is drawn. Waits for the first record if there are pictures.
void requirePictureNames(const AnswerOptions& options, RecordReader& reader);

// The function that answers points in sphere mode: appends the spherical mean, or a record of each direction
// (-Sd), and writes pictures of the points (-Si). Warns if nothing in the scene emits light.
// pictureReport: receives the progress of pictures. All other arguments must exist as long as the result.
// Throws the errors of PointWorkers.
AnswerRecord answerPoints(const Transport& transport, const AnswerOptions& options,
                          const AnswerWriter& writer, const rad::Warn& warn, RunSummary& summary,
                          const PictureProgress::Report& pictureReport = {});

}  // namespace rsphere
