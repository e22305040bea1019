#include "answer/picture_progress.h"

#include <fmt/format.h>

namespace rsphere {
namespace {

// The part of a picture that must be done before it says how much time is left: its first rows make the coarse solution.
constexpr double kEnough = .1;

}  // namespace

void PictureProgress::at(double done) {
  if (!report_) return;
  const auto now = Clock::now();
  const auto since = [&](Clock::time_point then) {
    return std::chrono::duration<double>(now - then).count();
  };
  if (since(last_) < seconds_) return;
  last_ = now;
  const double seconds = since(start_);
  std::string text = fmt::format("picture {}: {:.0f}% after {:.1f} seconds", name_, 100 * done, seconds);
  if (done > kEnough) text += fmt::format(", about {:.0f} seconds left", seconds * (1 / done - 1));
  report_(text);
}

}  // namespace rsphere
