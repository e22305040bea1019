#pragma once
// How long measuring will take, from what it took so far.
#include <cstddef>
#include <span>
#include <string>

#include "answer/answer_options.h"

namespace rsphere {

// How far the reference is.
struct ReferenceProgress {
  double rotations = 0;          // so far; below 1 the share of the points that were answered once
  size_t leastRotations = 0;     // how many there are in any case
  double seconds = 0;            // taken so far
  double error = 0, target = 0;  // relative standard error so far, and the one that is wanted
  size_t points = 0;
  bool moreThreads = false;  // whether -n 0 would use more threads
};

// Whether `error` is known well enough to predict from: it is estimated from the rotations of all points.
bool canPredict(const ReferenceProgress& progress);

// Seconds that are left, as the error falls with the square root of the rotations. Of the rotations that
// there are in any case alone where the error is not known yet.
double secondsLeft(const ReferenceProgress& progress);

// What to say where the reference takes longer than a minute in all, with the options that make it quicker;
// empty where it does not. The error of -Te that it names is the one that is reached in about a minute.
std::string slowReference(const ReferenceProgress& progress);

// What a setting costs beside others: its directions times the power 3/4 of the indirect rays of each (-ad).
// Within a factor of two or so for the usual settings, which is enough to tell the time that is left.
double costOf(const AnswerOptions& setting);

// Seconds for the settings that are left, from the seconds that the first `done` of them took.
double secondsLeft(std::span<const double> costs, size_t done, double seconds);

// "40 s", "2.5 min", "12 min", "3.5 h".
std::string durationText(double seconds);

}  // namespace rsphere
