#pragma once
// Speed and accuracy of settings, from answers of each and a reference.
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rsphere {

// Answers (brightness of the mean radiance) of all points in repeat r at [r * points, (r + 1) * points).
struct RepeatedAnswers {
  size_t points = 0;
  std::vector<double> values;
  size_t repeats() const { return points > 0 ? values.size() / points : 0; }
};

// Means of the points over many repeats. `scale` is what relative errors of a point refer to: its own mean,
// or kDarkestPoint of the mean over all where that is more.
class Reference {
 public:
  explicit Reference(const RepeatedAnswers& answers);

  double mean(size_t point) const { return means_[point]; }
  double scale(size_t point) const { return scales_[point]; }
  // Relative standard error: root mean square over the points, and that of the mean over them.
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

// What was measured of a setting.
struct Trial {
  std::vector<std::string> words;  // its options
  RepeatedAnswers answers;
  std::vector<double> estimates;  // estimated standard errors; of point i % points, maybe several times
  double seconds = 0;             // CPU time a point, without the estimate unless the setting needs it (-Sa)
  double setupSeconds = 0;        // before the first point
  double directions = 0;          // a point
};

// All errors are relative to the reference.
struct Figures {
  std::vector<std::string> words;
  double seconds = 0, setupSeconds = 0, directions = 0;
  double rms = 0;                  // of an answer's error, without the reference's own
  double rmsAtMost = 0;            // 95% sure, as far as so few answers tell
  double largest = 0;              // error found
  double bias = 0, biasError = 0;  // mean error, and its standard error
  bool biased = false;             // whether the bias is certain (99%)
  double estimated = 0;            // rms of the standard errors that it estimates itself
  bool limited = false;  // the reference's error is more than half of what was found: rms is a guess
  bool best = false;     // nothing measured is both as fast and as accurate
};

// REQUIRES at least one repeat, of the reference's points.
Figures figuresOf(const Trial& trial, const Reference& reference);

// Sets `best` of each.
void markBest(std::vector<Figures>& all);

// The fastest of those that meet an accuracy (rmsAtMost); empty where none does.
std::optional<size_t> cheapest(std::span<const Figures> all, double accuracy);

}  // namespace rsphere
