#pragma once
#include <array>
#include <cstddef>
#include <optional>

namespace rsphere {

// How many sets of directions are averaged for -Sa: as many as bring the estimated standard error of the mean
// below a share of it.
//
// A set that happens to find little light estimates a small error, too, so that who stops on what was
// averaged stops early where too little was found. Therefore the sets have two halves: what one half finds
// decides how many sets the other gets, and the answer is the average of the halves' means, which do not know
// of that decision. Answers whose own estimate is still too large get more sets, which makes what is left of
// the bias. With -Sa .005 (tests/bench/importance/runs), beside a goal, and near chrome balls, where few
// directions find much of the light; the last column is the number of sets for the same error, beside the
// goal:
//   stopping on what was averaged           -.022 +- .001%     -.119 +- .005%     1
//   two halves                              -.004 +- .001%     -.034 +- .004%     1.06
//   a first set that decides on the rest    +.003 +- .002%     +.004 +- .005%     1.42
//   and is thrown away
// The last leaves the estimated error of a third of the answers above what was asked for.
class TwoHalves {
 public:
  // accuracy: the share. 0: one set is enough.
  explicit TwoHalves(double accuracy) : accuracy_(accuracy) {}

  // The half, 0 or 1, that the next set belongs to; empty where there are enough.
  std::optional<size_t> next() const;

  // A set of that half, with its total and the variance of that.
  void add(size_t half, double total, double variance);

  // What each set of a half counts in the average of all; the shares of all sets sum to 1.
  double share(size_t half) const;

  // Whether the estimated standard error is below the accuracy.
  bool isReached() const;

 private:
  struct Half {
    size_t sets = 0;
    double total = 0, variance = 0;
  };
  size_t setsFor(const Half& other) const;

  double accuracy_;
  std::array<Half, 2> halves_;
};

}  // namespace rsphere
