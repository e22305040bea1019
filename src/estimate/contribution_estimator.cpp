#include "estimate/contribution_estimator.h"

#include <algorithm>
#include <numbers>
#include <span>

#include "base/spectral_sampling.h"
#include "estimate/tuning.h"

namespace rsphere {
namespace {

// values: components() of a contribution.
Radiance colorOf(std::span<const double> values, const SpectralSampling* sampling) {
  if (sampling == nullptr) return Radiance(Color(values[0], values[1], values[2]));
  Bands bands(*sampling);
  std::copy(values.begin(), values.end(), bands.values().begin());
  return Radiance(Color(std::move(bands)));
}

Radiance sumOf(const ContributionList& list, const SpectralSampling* sampling) {
  const auto components = static_cast<size_t>(list.components());
  std::vector<double> sum(components);
  for (size_t i = 0; i < list.values().size(); ++i) sum[i % components] += list.values()[i];
  return colorOf(sum, sampling);
}

void addTimes(double factor, const ContributionList& from, ContributionList& to) {
  const auto components = static_cast<size_t>(from.components());
  std::vector<double> values(components);
  for (size_t i = 0; i < from.columns().size(); ++i) {
    for (size_t c = 0; c < components; ++c) values[c] = factor * from.values()[i * components + c];
    to.add(from.columns()[i], values);
  }
}

}  // namespace

ContributionEstimator::ContributionEstimator(const Transport& transport, RayEstimator::Options options,
                                             Contributed what)
    : estimator_(transport,
                 [&] {
                   const bool irradiance = transport.prepared().irradiance() != IrradianceAt::none;
                   if (what == Contributed::coefficients && options.floor < 0)
                     options.floor = tuning::RaySets::kDark * (irradiance ? std::numbers::pi : 1.);
                   return options;
                 }()),
      sampling_(transport.prepared().options().sampling) {}

ContributionEstimator::Estimate ContributionEstimator::estimate(ContributionTracer& tracer, const V3d& origin,
                                                                const V3d& direction, double farthest,
                                                                uint64_t seed) const {
  Estimate answer{ContributionList(tracer.components()), {}, {}};
  constexpr size_t kSets = RayEstimator::kSets;
  const auto components = static_cast<size_t>(tracer.components());
  std::vector<ContributionList> sums(kSets, answer.means);  // of contributions times rays
  std::array<double, kSets> rays{};
  const auto gather = [&](const RayEstimator::Sent& sent) {
    const ContributionList& list = tracer.trace(origin, direction, farthest, sent.seed, sent.rays);
    addTimes(sent.rays, list, sums[sent.set]);
    rays[sent.set] += sent.rays;
    TracedRay ray = tracer.ray();
    ray.value = sumOf(list, sampling_);
    return ray;
  };
  answer.sum = estimator_.estimate(gather, seed);

  for (size_t set = 0; set < kSets; ++set) addTimes(1 / (kSets * rays[set]), sums[set], answer.means);
  // The variance of the mean of all sets is s^2 / kSets. A set that contributes nothing to a column has 0
  // there.
  answer.variances.assign(answer.means.values().size(), 0);
  constexpr double kOfSquares = 1. / (kSets * (kSets - 1));
  for (size_t set = 0; set < kSets; ++set)
    for (size_t i = 0; i < sums[set].values().size(); ++i) {
      const size_t at =
          answer.means.positionOf(sums[set].columns()[i / components]) * components + i % components;
      const double value = sums[set].values()[i] / rays[set];
      answer.variances[at] += kOfSquares * value * value;
    }
  for (size_t at = 0; at < answer.variances.size(); ++at) {
    const double mean = answer.means.values()[at];
    answer.variances[at] -= kOfSquares * kSets * mean * mean;
  }
  // Rounding may leave a variance below 0 if all values are equal.
  for (double& variance : answer.variances) variance = std::max(0., variance);
  return answer;
}

}  // namespace rsphere
