#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>

namespace rsphere {

// Mean and variance of values that are added one at a time (Welford's algorithm).
class Spread {
 public:
  void add(double x) {
    ++count_;
    const double before = x - mean_;
    mean_ += before / static_cast<double>(count_);
    squares_ += before * (x - mean_);
  }
  size_t count() const { return count_; }
  double mean() const { return mean_; }
  // The sample variance; 0 for fewer than two values.
  double variance() const { return count_ > 1 ? squares_ / static_cast<double>(count_ - 1) : 0; }
  // The standard error of the mean, if the values are independent.
  double standardError() const {
    return count_ > 0 ? std::sqrt(variance() / static_cast<double>(count_)) : 0;
  }

 private:
  size_t count_ = 0;
  double mean_ = 0, squares_ = 0;
};

// The two-sided probability of Student's t with this number of degrees of freedom: the probability of a value
// above |t| or below -|t|. 1 for degrees < 1. Error below 1e-14. Source: Abramowitz and Stegun, 26.7.3 and
// 26.7.4 (finite sums). Above 200 degrees, the normal distribution is used, which is wrong by a factor of at
// most 1.4 for probabilities above 1e-6.
double beyondT(double t, size_t degrees);

// The probability of a difference at least as large if its expected value is 0: beyondT() of the difference
// over its standard error. If the standard error is 0, it is 1 for a difference of 0, otherwise 0.
double chanceOf(double difference, double standardError, size_t degrees);

}  // namespace rsphere
