#pragma once
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "answer/answer_points.h"
#include "answer/stop_signals.h"
#include "trade/curve.h"

namespace rsphere {

// A setting's options, and those of its words that rays depend on: settings with the same can share a
// Transport.
struct Setting {
  AnswerOptions options;
  std::string rays;
};

// Runs settings on a scene's points.
class Trials {
 public:
  // The scene, points (three numbers each) and signals must live as long.
  Trials(const Scene& scene, std::span<const double> points, const StopSignals& signals)
      : scene_(scene), points_(points), signals_(signals) {}

  size_t points() const { return points_.size() / 3; }

  // Answers all points once, with the rotation of its options. standardErrors: whether estimates are wanted.
  // Adds to trial.answers, and to the sums of its seconds and directions where `timed`. False, and nothing
  // added, where a signal came.
  // pointAnswered: called after each point, from several threads.
  bool run(const Setting& setting, bool standardErrors, bool timed, Trial& trial,
           const std::function<void()>& pointAnswered = {});

 private:
  const Transport& transportOf(const Setting& setting);

  const Scene& scene_;
  std::span<const double> points_;
  const StopSignals& signals_;
  std::map<std::string, std::unique_ptr<Transport>> transports_;  // by Setting::rays
};

}  // namespace rsphere
