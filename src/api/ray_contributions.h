#pragma once
#include <string>
#include <vector>

#include "answer/batch.h"
#include "contrib/tracked.h"
#include "rsphere/options.h"
#include "transport/transport.h"

namespace rsphere::v1 {

// The modifiers, all with the same bins. Throws rad::Error if one is named twice, or if the bins are wrong.
std::vector<TrackedModifier> trackedModifiers(const std::vector<std::string>& of, const Bins& bins);

// Answers rays with contributions, as doubles: the mean of each number of each column over the samples, and
// with more than one sample the standard errors of these means. Threads of -n may call answer() at once.
class RayContributions {
 public:
  // samples: at least 1. Keeps references to transport and options.
  RayContributions(const Transport& transport, const AnswerOptions& options,
                   std::vector<TrackedModifier> modifiers, Contributed what, int samples, rad::Warn warn);
  RayContributions(const RayContributions&) = delete;
  RayContributions& operator=(const RayContributions&) = delete;

  void answer(const Record& record, unsigned worker, std::string& bytes);
  // Numbers of a mean.
  size_t numbers() const { return static_cast<size_t>(tracked_.columns()) * components_; }

 private:
  const AnswerOptions& options_;
  const Tracked tracked_;
  const size_t components_;
  const int samples_;
  std::vector<ContributionTracer> tracers_;
};

}  // namespace rsphere::v1
