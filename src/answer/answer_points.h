#pragma once
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "answer/answer_options.h"
#include "answer/answer_writer.h"
#include "answer/batch.h"
#include "answer/picture_progress.h"
#include "importance/estimator.h"

namespace rsphere {

// The estimator of sphere mode, with a workspace for each thread of -n.
class PointWorkers {
 public:
  // standardError: whether PointAnswer should contain standard errors. checkStop is called repeatedly during
  // an estimate; it may throw to abandon the point. Keeps a reference to the transport. Throws the errors of
  // SphereEstimator.
  PointWorkers(const Transport& transport, const AnswerOptions& options, bool standardError,
               const std::function<void()>& checkStop = {});
  PointWorkers(const PointWorkers&) = delete;
  PointWorkers& operator=(const PointWorkers&) = delete;

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

// Collects data for the warnings at the end of a run from its answers. Thread-safe; the warnings do not
// depend on the order of the answers.
class PointSummary {
 public:
  // sampling: RayOptions::sampling.
  void add(uint64_t record, const PointAnswer& answer, const SpectralSampling* sampling);

  // Points where almost no direction finds light, or none. If the whole scene is dark, answerPoints() warns
  // instead:
  //   "no light reaches 3 of 20 points, or almost none; the first is record 7: check the units of the ..."
  // Points with light where the accuracy of -Sa was not reached:
  //   "-Sa 0.01 was not reached at 3 of 20 points with at most 8192 directions; the worst is record 7: 1.25%"
  // Points where -Sf removed light:
  //   "-Sf 0.01 clamped 3 of 20 points and took 1.4% of their light on average; the most is record 7: 2.5%"
  std::vector<std::string> warnings(const SphereOptions& options, const PreparedScene& prepared) const;

 private:
  // Points to warn about, with the worst of them; of equal ones the first record.
  struct Some {
    uint64_t points = 0, worst = 0;
    double most = -1;
    void add(uint64_t record, double value);
  };
  mutable std::mutex mutex_;
  uint64_t points_ = 0;
  Some unlit_;    // dark points
  Some missed_;   // -Sa: relative standard errors of the mean brightness
  Some clamped_;  // -Sf: fractions of the unclamped light that were removed
  // The sum of these fractions as a whole number, so that it does not depend on the order of summation.
  uint64_t billionths_ = 0;
};

// Throws rad::Error if the records that have arrived need more pictures (-Si) than the name can number,
// before any of these pictures is drawn. Waits for the first record if there are pictures.
void requirePictureNames(const AnswerOptions& options, RecordReader& reader);

// The function that answers points in sphere mode: appends the spherical mean, or a record of each direction
// (-Sd), and writes pictures of the points (-Si). Warns if nothing in the scene emits light. checkStop: see
// PointWorkers; it is copied. pictureReport: receives the progress of pictures. All other arguments must
// exist as long as the result. Throws the errors of PointWorkers.
AnswerRecord answerPoints(const Transport& transport, const AnswerOptions& options,
                          const AnswerWriter& writer, const rad::Warn& warn, PointSummary& summary,
                          const std::function<void()>& checkStop,
                          const PictureProgress::Report& pictureReport = {});

}  // namespace rsphere
