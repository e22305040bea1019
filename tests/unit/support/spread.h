#pragma once
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

}  // namespace rsphere
