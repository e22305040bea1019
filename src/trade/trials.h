#pragma once
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "cli/stop_signals.h"
#include "importance/estimator.h"
#include "trade/curve.h"

namespace rsphere {

// Runs settings on a scene's points.
class Trials {
 public:
  // The scene, points (three numbers each) and signals must live as long.
  Trials(const Scene& scene, std::span<const double> points, const StopSignals& signals)
      : scene_(scene), points_(points), signals_(signals) {}

  // Answers all points once, with the rotation of options. standardErrors: whether estimates are wanted. Adds
  // to trial.answers, and to the sums of its seconds and directions where `timed`. False, and nothing added,
  // where a signal came.
  bool run(const Options& options, bool standardErrors, bool timed, Trial& trial);

 private:
  const Transport& transportOf(const Options& options);

  const Scene& scene_;
  std::span<const double> points_;
  const StopSignals& signals_;
  std::map<std::string, std::unique_ptr<Transport>> transports_;  // by what -defaults prints of their options
};

}  // namespace rsphere
