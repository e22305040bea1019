#include "glare/local_fits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace rsphere {
namespace {

constexpr size_t kMostTerms = 6;
using Terms = std::array<double, kMostTerms>;

// Keeps normal equations regular if all directions lie on a line; relative to the number of directions.
constexpr double kRidge = 1e-9;

// Coordinates in which directions have mean 0 and variance 1 along both axes.
class Axes {
 public:
  Axes(std::span<const V3d> directions, std::span<const size_t> cell) {
    for (const size_t i : cell) middle_ += directions[i] / static_cast<double>(cell.size());
    const V3d z = middle_.normalized();
    const V3d x = (std::abs(z.x) < .5 ? V3d(1, 0, 0) : V3d(0, 1, 0)).cross(z).normalized(), y = z.cross(x);
    double xx = 0, xy = 0, yy = 0;
    for (const size_t i : cell) {
      const V3d off = directions[i] - middle_;
      xx += off.dot(x) * off.dot(x);
      xy += off.dot(x) * off.dot(y);
      yy += off.dot(y) * off.dot(y);
    }
    const double turn = .5 * std::atan2(2 * xy, xx - yy), half = std::hypot(xx - yy, 2 * xy) / 2;
    const auto scale = [&](double squares) {
      return squares > 0 ? std::sqrt(static_cast<double>(cell.size()) / squares) : 0;
    };
    long_ = (std::cos(turn) * x + std::sin(turn) * y) * scale((xx + yy) / 2 + half);
    across_ = (std::cos(turn) * y - std::sin(turn) * x) * scale((xx + yy) / 2 - half);
  }

  double along(const V3d& direction) const { return long_.dot(direction); }
  Terms terms(const V3d& direction) const {
    const double u = long_.dot(direction - middle_), v = across_.dot(direction - middle_);
    return {1, u, v, u * u - 1, u * v, v * v - 1};
  }

 private:
  V3d middle_{0, 0, 0}, long_, across_;
};

// Normal equations A c = b, of which A = L L'.
class NormalEquations {
 public:
  explicit NormalEquations(size_t terms) : size_(terms) {}

  void add(const Terms& terms, double value) {
    for (size_t i = 0; i < size_; ++i) {
      right_[i] += terms[i] * value;
      for (size_t k = 0; k <= i; ++k) a_[i][k] += terms[i] * terms[k];
    }
  }
  void factorize(double ridge) {
    for (size_t i = 0; i < size_; ++i) {
      a_[i][i] += ridge;
      for (size_t k = 0; k <= i; ++k) {
        double sum = a_[i][k];
        for (size_t m = 0; m < k; ++m) sum -= a_[i][m] * a_[k][m];
        a_[i][k] = i == k ? std::sqrt(std::max(sum, ridge)) : sum / a_[k][k];
      }
    }
    right_ = solvedForwards(right_);
  }
  double fit(const Terms& half) const { return product(half, right_); }
  double leverage(const Terms& half) const { return product(half, half); }
  Terms solvedForwards(Terms x) const {
    for (size_t i = 0; i < size_; ++i) {
      for (size_t k = 0; k < i; ++k) x[i] -= a_[i][k] * x[k];
      x[i] /= a_[i][i];
    }
    return x;
  }

 private:
  double product(const Terms& x, const Terms& y) const {
    return std::inner_product(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(size_), y.begin(), 0.);
  }

  size_t size_;
  std::array<Terms, kMostTerms> a_{};
  Terms right_{};
};

size_t termsFor(size_t directions) { return directions >= 24 ? kMostTerms : directions >= 12 ? 3 : 1; }

struct Fitter {
  std::span<const V3d> directions;
  std::span<const double> values;
  size_t most;
  std::vector<double> fits;

  void divide(std::span<size_t> cell) {
    const Axes axes(directions, cell);
    if (cell.size() <= most) return fit(cell, axes);
    const size_t half = cell.size() / 2;
    std::ranges::nth_element(cell, cell.begin() + static_cast<std::ptrdiff_t>(half), [&](size_t i, size_t k) {
      const double a = axes.along(directions[i]), b = axes.along(directions[k]);
      return a < b || (a == b && i < k);
    });
    divide(cell.first(half));
    divide(cell.subspan(half));
  }

  void fit(std::span<const size_t> cell, const Axes& axes) {
    if (cell.size() < 2) return;
    NormalEquations equations(termsFor(cell.size()));
    for (const size_t i : cell) equations.add(axes.terms(directions[i]), values[i]);
    equations.factorize(kRidge * static_cast<double>(cell.size()));
    for (const size_t i : cell) {
      const Terms half = equations.solvedForwards(axes.terms(directions[i]));
      const double own = equations.leverage(half);
      if (own < 1) fits[i] = (equations.fit(half) - own * values[i]) / (1 - own);
    }
  }
};

}  // namespace

std::vector<double> fitsOfOthers(std::span<const V3d> directions, std::span<const double> values,
                                 size_t most) {
  Fitter fitter{directions, values, most, {values.begin(), values.end()}};
  std::vector<size_t> all(directions.size());
  std::iota(all.begin(), all.end(), size_t{0});
  if (!all.empty()) fitter.divide(all);
  return fitter.fits;
}

}  // namespace rsphere
