#pragma once
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <utility>

#include "answer/answer_points.h"
#include "companions/trade/curve.h"
#include "process/stop_signals.h"

namespace rsphere {

// The options of a setting, and the words among them that affect rays. Settings with equal words can share a
// Transport.
struct Setting {
  AnswerOptions options;
  std::string rays;
};

// Answers the points of a scene with different settings.
class Trials {
 public:
  // points: three numbers each. leave: ends the process; called if an answer is still unfinished .1 s after a
  // signal. All arguments except `leave` must exist as long as this object.
  Trials(const Scene& scene, std::span<const double> points, const StopSignals& signals,
         std::function<void()> leave)
      : scene_(scene), points_(points), signals_(signals), leave_(std::move(leave)) {}

  size_t points() const { return points_.size() / 3; }

  // Answers all points once, with the rotation given in the options, and adds the answers to trial.answers.
  // standardErrors: also adds the estimated errors to trial.estimates. timed: includes these answers in the
  // means trial.seconds and trial.directions. pointAnswered is called after each point, from several threads.
  // After a signal, returns false and adds nothing.
  bool run(const Setting& setting, bool standardErrors, bool timed, Trial& trial,
           const std::function<void()>& pointAnswered = {});

 private:
  const Transport& transportOf(const Setting& setting);

  const Scene& scene_;
  std::span<const double> points_;
  const StopSignals& signals_;
  std::function<void()> leave_;
  std::map<std::string, std::unique_ptr<Transport>> transports_;  // by Setting::rays
};

}  // namespace rsphere
