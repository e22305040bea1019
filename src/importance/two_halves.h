#pragma once
#include <array>
#include <cstddef>
#include <optional>

namespace rsphere {

// Decides how many sets of directions are averaged for -Sa: sets are added until the estimated standard error
// of the mean is below a fraction of the mean.
//
// A set that happens to find little light also estimates a small error. A rule that decides by the sets that
// it averages therefore stops early if they found too little light, which is a bias. Here the sets are
// divided into two halves. The sets of one half decide how many sets the other half gets, and the answer is
// the average of the means of the halves, which are independent of the decisions about themselves. Answers
// whose own estimate of the error is still too large get more sets; this causes the remaining bias.
//
// Bias with -Sa .005 (tests/bench/importance/runs/2026-11-22-stopping.txt) beside a goal, and
// near chrome balls, where few directions find much of the light; and the number of sets for the
// same error beside the goal:
//
//   rule                                        beside a goal     near chrome      sets
//   stop on the sets averaged                   -.022 +- .001%   -.119 +- .005%   1
//   two halves                                  -.004 +- .001%   -.034 +- .004%   1.06
//   a first set decides and is not averaged     +.003 +- .002%   +.004 +- .005%   1.42
//
// The last rule was refused, because a third of its answers estimate a larger error than was asked for.
class TwoHalves {
 public:
  // accuracy: the fraction. 0: one set is enough. dark: if the average is below this, tuning::Dark::kSets
  // sets are enough, although they may not reach the accuracy.
  explicit TwoHalves(double accuracy, double dark = 0) : accuracy_(accuracy), dark_(dark) {}

  // The half, 0 or 1, that the next set belongs to. Empty if there are enough sets.
  std::optional<size_t> next() const;

  // Adds a set to a half. total: its estimate; variance: of the total.
  void add(size_t half, double total, double variance);

  // The weight of each set of a half in the average. The weights of all sets sum to 1.
  double share(size_t half) const;

  // Whether the estimated standard error is below the accuracy.
  bool isReached() const;

  // Whether the sets are enough only because there is almost no light.
  bool gaveUp() const { return average() < dark_ && !isReached(); }

 private:
  struct Half {
    size_t sets = 0;
    double total = 0, variance = 0;
  };
  size_t setsFor(const Half& other) const;
  double average() const;

  double accuracy_, dark_;
  std::array<Half, 2> halves_;
};

}  // namespace rsphere
