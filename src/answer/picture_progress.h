#pragma once
#include <chrono>
#include <functional>
#include <string>
#include <string_view>

namespace rsphere {

// Reports the progress of a picture at intervals:
//   "picture view.png: 34% after 5.0 seconds, about 10 seconds left"
class PictureProgress {
 public:
  // Receives a line; may be called from several threads at once. Null: nothing is reported.
  using Report = std::function<void(std::string_view)>;

  // seconds: time between reports.
  PictureProgress(std::string name, const Report& report, double seconds)
      : name_(std::move(name)), report_(report), seconds_(seconds) {}

  // done: 0 to 1.
  void at(double done);

 private:
  using Clock = std::chrono::steady_clock;

  std::string name_;
  const Report& report_;
  double seconds_;
  Clock::time_point start_ = Clock::now(), last_ = start_;
  Clock::time_point started_ = start_;  // when the initial part of the picture was finished
  double doneThen_ = 0;
};

}  // namespace rsphere
