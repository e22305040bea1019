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

// The options of a setting, and the words among them that affect rays. Settings of points with equal words
// can share a Transport.
struct Setting {
  AnswerOptions options;
  std::string rays;
};

// Answers the points of a scene, or in ray mode its rays, with different settings.
class Trials {
 public:
  // points: perRecord numbers each. leave: ends the process; called if an answer is still unfinished .1 s
  // after a signal. All arguments except `leave` must exist as long as this object.
  Trials(const Scene& scene, std::span<const double> points, size_t perRecord, const StopSignals& signals,
         std::function<void()> leave)
      : scene_(scene), points_(points), perRecord_(perRecord), signals_(signals), leave_(std::move(leave)) {}

  size_t points() const { return points_.size() / perRecord_; }

  // Answers all points once, with the rotation given in the options, and adds the answers to trial.answers.
  // standardErrors: also adds the estimated errors to trial.estimates. timed: includes these answers in the
  // means trial.seconds and trial.directions. pointAnswered is called after each point, from several threads.
  // After a signal, returns false and adds nothing.
  bool run(const Setting& setting, bool standardErrors, bool timed, Trial& trial,
           const std::function<void()>& pointAnswered = {});

 private:
  struct Answer {
    double value = 0, error = 0;  // brightness and its standard error
    size_t directions = 0;
  };
  // Answers record i on a thread.
  using Answerer = std::function<Answer(size_t i, unsigned worker)>;
  Answerer points(const Setting& setting, bool standardErrors);
  Answerer rays(const Setting& setting);
  const Transport& transportOf(const Setting& setting);

  const Scene& scene_;
  std::span<const double> points_;
  size_t perRecord_;
  const StopSignals& signals_;
  std::function<void()> leave_;
  std::map<std::string, std::unique_ptr<Transport>> transports_;  // by Setting::rays
};

}  // namespace rsphere
