#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>

namespace rsphere {

// Mean and variance of values, one at a time (Welford's updates).
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
  // Of one value, estimated; 0 for fewer than two.
  double variance() const { return count_ > 1 ? squares_ / static_cast<double>(count_ - 1) : 0; }
  // Of the mean of independent values.
  double standardError() const {
    return count_ > 0 ? std::sqrt(variance() / static_cast<double>(count_)) : 0;
  }

 private:
  size_t count_ = 0;
  double mean_ = 0, squares_ = 0;
};

// How likely Student's t with that many degrees of freedom lies beyond +t or below -t. 1 for degrees < 1.
// Error below 1e-14. Source: Abramowitz and Stegun, 26.7.3 and 26.7.4 (finite sums); beyond 200 degrees those
// of the normal distribution, off by a factor of 1.4 at most where the answer is above 1e-6.
double beyondT(double t, size_t degrees);

// The same for a difference of which no more is known than its standard error; 0 error: 1 where the
// difference is 0, else 0.
double chanceOf(double difference, double standardError, size_t degrees);

}  // namespace rsphere
