#pragma once
// Speed and accuracy of settings, computed from their answers and from those of a reference.
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rsphere {

// Answers (brightness of the mean radiance). The answers to all points in repeat r are at [r * points, (r +
// 1) * points).
struct RepeatedAnswers {
  size_t points = 0;
  std::vector<double> values;
  size_t repeats() const { return points > 0 ? values.size() / points : 0; }
};

// Means of the points over many repeats. Relative errors of a point refer to scale(): the mean of the point,
// or kDarkestPoint times the mean over all points if that is larger.
class Reference {
 public:
  explicit Reference(const RepeatedAnswers& answers);

  double mean(size_t point) const { return means_[point]; }
  double scale(size_t point) const { return scales_[point]; }
  // Relative standard errors: the rms over the points, and the error of the mean over the points.
  double error() const { return error_; }
  double meanError() const { return meanError_; }
  size_t points() const { return means_.size(); }
  // Whether all means are 0.
  bool isDark() const;
  size_t repeats() const { return repeats_; }

 private:
  std::vector<double> means_, scales_;
  double error_ = 0, meanError_ = 0;
  size_t repeats_ = 0;
};
inline constexpr double kDarkestPoint = .01;

// The measurements of a setting.
struct Trial {
  std::vector<std::string> words;  // its options
  RepeatedAnswers answers;
  std::vector<double> estimates;  // standard errors estimated by the setting; number i is of point i % points
  size_t timed = 0;               // number of answers over which `seconds` and `directions` are means
  double seconds = 0;             // CPU time for a point, without the error estimate unless -Sa needs it
  double setupSeconds = 0;        // CPU time before the first point
  double directions = 0;          // number of directions for a point
};

// All errors are relative to the reference.
struct Figures {
  std::vector<std::string> words;
  double seconds = 0, setupSeconds = 0, directions = 0;
  double rms = 0;                  // rms error of answers, without the error of the reference
  double rmsAtMost = 0;            // upper limit of rms at 95% confidence
  double largest = 0;              // largest error
  double bias = 0, biasError = 0;  // mean error, and its standard error
  bool biased = false;             // whether the bias is significant (99%)
  double estimated = 0;            // rms of the standard errors estimated by the setting
  bool limited = false;  // whether the error of the reference is over half of the difference found, so that
                         // rms is uncertain
  bool best = false;     // whether no other setting is both as fast and as accurate
};

// REQUIRES: the trial has at least one repeat of the points of the reference.
Figures figuresOf(const Trial& trial, const Reference& reference);

// Sets Figures::best for each setting.
void markBest(std::vector<Figures>& all);

// The index of the fastest setting whose rmsAtMost is within the accuracy; empty if there is none.
std::optional<size_t> cheapest(std::span<const Figures> all, double accuracy);

// The recommended setting: cheapest() or, if there is none, the one with the smallest rms; `sure` is then
// false. REQUIRES: there is at least one setting.
struct Recommendation {
  size_t index = 0;
  bool sure = false;
};
Recommendation recommend(std::span<const Figures> all, double accuracy);

}  // namespace rsphere
