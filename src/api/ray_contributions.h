#pragma once
#include <optional>
#include <string>
#include <vector>

#include "answer/batch.h"
#include "answer/run_summary.h"
#include "contrib/tracked.h"
#include "estimate/contribution_estimator.h"
#include "rsphere/options.h"
#include "transport/transport.h"

namespace rsphere::v1 {

// The modifiers, which share these bins. Throws rad::Error if one is named twice, or if the bins are invalid.
std::vector<TrackedModifier> trackedModifiers(const std::vector<std::string>& of, const Bins& bins);

// Answers rays with contributions, as doubles: for each value of each column the mean over the samples and,
// with more than one sample or an accuracy (-Sa), its standard error. Several threads of -n may call answer()
// at a time.
class RayContributions {
 public:
  // samples: at least 1. Keeps references to transport and options.
  RayContributions(const Transport& transport, const AnswerOptions& options,
                   std::vector<TrackedModifier> modifiers, Contributed what, int samples, rad::Warn warn);
  RayContributions(const RayContributions&) = delete;
  RayContributions& operator=(const RayContributions&) = delete;

  // summary: gets the error of the sum of the contributions, with an accuracy.
  void answer(const Record& record, unsigned worker, std::string& bytes, RunSummary& summary);
  bool hasErrors() const { return samples_ > 1 || estimator_; }
  // Number of values in the means of a record.
  size_t numbers() const { return static_cast<size_t>(tracked_.columns()) * components_; }

 private:
  const AnswerOptions& options_;
  double samePlace_;  // Scene::samePlace
  const Tracked tracked_;
  const size_t components_;
  const int samples_;
  std::optional<const ContributionEstimator> estimator_;  // with an accuracy; samples_ is then not used
  std::vector<ContributionTracer> tracers_;
};

}  // namespace rsphere::v1
