#pragma once
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "answer/answer_options.h"
#include "answer/batch.h"
#include "answer/messages.h"
#include "estimate/ray_estimator.h"
#include "points/glare_answer.h"
#include "points/point_answer.h"
#include "rays/prepared_scene.h"

namespace rsphere {

// Collects data for the warnings at the end of a run from its answers. Thread-safe; the warnings do not
// depend on the order of the answers.
class RunSummary {
 public:
  // Add the answer at a point, at an eye (-Su), and for a sensor of -I.
  void add(uint64_t record, const PointAnswer& answer, const PreparedScene& prepared);
  void add(uint64_t record, const GlareAnswer& answer, const PreparedScene& prepared);
  void addSensor(uint64_t record, const V3d& point, const PreparedScene& prepared);
  // Adds the error of a ray.
  void add(uint64_t record, const RayEstimator::Estimate& estimate);

  // Points where almost no direction finds light, or none. If the whole scene is dark, another warning says
  // so:
  //   "no light reaches 3 of 20 points, or almost none; the first is record 7: check the units of the ..."
  // Other points, and sensors, that are far away from a scene that does not consist of lamps alone:
  //   "3 of 20 points are far away from the scene, which reaches from 0 0 0 to 8 6 4; the first is ..."
  // Eyes before a black background:
  //   "UGR is infinite at 3 of 20 eyes; the first is record 7: ..."
  // Points or rays where the accuracy of -Sa was not reached:
  //   "-Sa: 37 of 40 sensors are within 1%; the largest error is 1.8% (record 12): 3.2 times the rays
  //   (mean of runs with other -Sr) would do"
  std::vector<std::string> warnings(const AnswerOptions& options, const PreparedScene& prepared) const;
  // Writes these warnings. In a terminal it also reports that all records are within the accuracy of -Sa:
  //   "-Sa: 40 of 40 sensors are within 1%; the largest error is 0.93% (record 12)"
  void tell(const Messages& messages, const AnswerOptions& options, const PreparedScene& prepared) const;

 private:
  // Records to warn about, and the worst of them; if several are equally bad, the first.
  struct Some {
    uint64_t records = 0, worst = 0;
    double most = -1;
    void add(uint64_t record, double value = 0);
  };
  void addError(uint64_t record, double relativeError, bool reached);
  std::string accuracyText(const AnswerOptions& options) const;
  void addPlace(uint64_t record, const V3d& point, bool unlit, const PreparedScene& prepared);

  mutable std::mutex mutex_;
  uint64_t records_ = 0;
  Some unlit_, far_;
  Some infinite_;            // UGR
  Some estimated_, missed_;  // -Sa: relative standard errors of brightness; and those above the accuracy
};

// Adds the sensors that `answer` answers to the summary. Returns `answer` itself for rays other than those of
// -I. Keeps references.
AnswerRecord withSensors(AnswerRecord answer, const AnswerOptions& options, const PreparedScene& prepared,
                         RunSummary& summary);

}  // namespace rsphere
