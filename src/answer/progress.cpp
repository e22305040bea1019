#include "answer/progress.h"

#include <fmt/format.h>

namespace rsphere {
namespace {

// kStart: initial part of a picture. Its time does not predict the time of the rest, because its rays compute
// the coarse solution. kEnough: the part after it that must be finished before the remaining time is
// reported.
constexpr double kStart = .1, kEnough = .05;

}  // namespace

void PictureProgress::at(double done) {
  if (!report_) return;
  const auto now = Clock::now();
  if (done <= kStart) {
    started_ = now;
    doneThen_ = done;
  }
  const auto since = [&](Clock::time_point then) {
    return std::chrono::duration<double>(now - then).count();
  };
  if (since(last_) < seconds_) return;
  last_ = now;
  std::string text =
      fmt::format("picture {}: {:.0f}% after {:.1f} seconds", name_, 100 * done, since(start_));
  if (const double part = done - doneThen_; part > kEnough)
    text += fmt::format(", about {:.0f} seconds left", since(started_) * (1 - done) / part);
  report_(text);
}

}  // namespace rsphere
