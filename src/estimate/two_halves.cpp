#include "estimate/two_halves.h"

#include <algorithm>
#include <cmath>

#include "estimate/tuning.h"
#include "glances/tuning.h"

namespace rsphere {
namespace {

constexpr double kMostSets = 1e9;  // more than -Sx allows

}  // namespace

size_t TwoHalves::setsFor(const Half& other) const {
  const double count = static_cast<double>(other.sets), variance = other.variance / count;
  if (!(variance > 0)) return 1;
  const double wanted = tuning::Stopping::kMargin * accuracy_ * std::max(other.total / count, floor_);
  const double sets = wanted > 0 ? variance / (2 * wanted * wanted) : kMostSets;
  return static_cast<size_t>(std::clamp(std::ceil(sets), 1., kMostSets));
}

std::optional<size_t> TwoHalves::next() const {
  const auto& [a, b] = halves_;
  if (a.sets == 0) return 0;
  if (accuracy_ <= 0) return std::nullopt;
  if (b.sets == 0) return 1;
  const bool wantsA = a.sets < setsFor(b), wantsB = b.sets < setsFor(a);
  if (!wantsA && !wantsB && isReached()) return std::nullopt;
  if (a.sets + b.sets >= tuning::DiffuseGlances::kPools && average() < dark_) return std::nullopt;
  if (a.sets >= tuning::Stopping::kMostRatio * b.sets) return 1;
  if (b.sets >= tuning::Stopping::kMostRatio * a.sets) return 0;
  if (wantsA != wantsB) return wantsA ? 0 : 1;
  return a.sets <= b.sets ? 0 : 1;
}

void TwoHalves::add(size_t half, double total, double variance) {
  ++halves_[half].sets;
  halves_[half].total += total;
  halves_[half].variance += variance;
}

double TwoHalves::share(size_t half) const {
  if (halves_[half].sets == 0) return 0;
  return 1 / static_cast<double>((halves_[1].sets > 0 ? 2 : 1) * halves_[half].sets);
}

bool TwoHalves::isReached() const {
  double variance = 0;
  for (size_t half = 0; half < halves_.size(); ++half)
    variance += share(half) * share(half) * halves_[half].variance;
  return std::sqrt(std::max(0., variance)) <= accuracy_ * std::max(average(), floor_);
}

double TwoHalves::average() const { return share(0) * halves_[0].total + share(1) * halves_[1].total; }

}  // namespace rsphere
