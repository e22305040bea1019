#pragma once
// Predicts the time that measurements will take from the time that they have taken so far.
#include <cstddef>
#include <span>
#include <string>

#include "answer/answer_options.h"

namespace rsphere {

// The progress of the reference.
struct ReferenceProgress {
  double rotations = 0;          // finished; below 1, the fraction of the points answered in the first
  size_t leastRotations = 0;     // minimum number of rotations
  double seconds = 0;            // time so far
  double error = 0, target = 0;  // relative standard error so far, and the one asked for
  size_t points = 0;
  bool moreThreads = false;  // whether -n 0 would use more threads
};

// Whether `error`, which is estimated from the rotations of all points, is accurate enough for predictions.
bool canPredict(const ReferenceProgress& progress);

// The remaining time in seconds, given that the error falls with the square root of the number of rotations.
// If the error is not known yet, the time to the minimum number of rotations.
double secondsLeft(const ReferenceProgress& progress);

// A message if the whole reference takes longer than a minute, with the options that make it faster;
// otherwise empty. The error that it suggests for -Te is reached in about a minute.
std::string slowReference(const ReferenceProgress& progress);

// The relative cost of a setting: its directions times the indirect rays of each (-ad) to the
// power 3/4. For the default settings it is right within a factor of about two, which suffices to
// predict the remaining time.
double costOf(const AnswerOptions& setting);

// The time in seconds for the remaining settings, predicted from that of the first `done` settings.
double secondsLeft(std::span<const double> costs, size_t done, double seconds);

// A duration as "40 s", "2.5 min", "12 min" or "3.5 h".
std::string durationText(double seconds);

}  // namespace rsphere
