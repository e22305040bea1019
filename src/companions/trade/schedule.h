#pragma once
// Predicts the time of measurements from the time already taken.
#include <cstddef>
#include <span>
#include <string>

#include "answer/answer_options.h"

namespace rsphere {

struct ReferenceProgress {
  double rotations = 0;          // number of finished rotations; below 1, the fraction of points answered in
                                 // the first one
  size_t leastRotations = 0;     // minimum number of rotations
  double seconds = 0;            // time taken
  double error = 0, target = 0;  // relative standard error: achieved, and requested
  size_t points = 0;
  bool moreThreads = false;  // whether -n 0 would use more threads
};

// Whether `error`, estimated from the rotations of all points, is accurate enough for predictions.
bool canPredict(const ReferenceProgress& progress);

// The remaining time in seconds, assuming that the error falls with the square root of the number of
// rotations. If the error is not yet known, the time for the minimum number of rotations.
double secondsLeft(const ReferenceProgress& progress);

// A message if the whole reference takes longer than a minute, with options that make it faster; otherwise
// empty. The error that it suggests for -Te takes about a minute.
std::string slowReference(const ReferenceProgress& progress);

// The relative cost of a setting: its directions times the power 3/4 of the indirect rays of each (-ad). For
// the default settings this is right within a factor of about two, which is sufficient to predict the
// remaining time.
double costOf(const AnswerOptions& setting);

// The time in seconds for the remaining settings, predicted from the time for the first `done` settings.
double secondsLeft(std::span<const double> costs, size_t done, double seconds);

// Formats a duration as "40 s", "2.5 min", "12 min" or "3.5 h".
std::string durationText(double seconds);

}  // namespace rsphere
