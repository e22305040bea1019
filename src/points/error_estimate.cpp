#include "points/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/even_sequence.h"
#include "points/tuning.h"

namespace rsphere {
namespace {

// The part of a direction's radiance that the ray along it found, without its glance.
Radiance followed(const DirectionSample& s) { return s.value - s.glanced; }

// Each value minus the mean of the values around it.
struct Differences {
  std::vector<Radiance> values;  // 0 where no value is compared
  std::vector<double> around;    // number of values with which each is compared
};

struct SumOfSome {
  Radiance sum;
  double count = 0;

  void add(const Radiance& value) {
    sum += value;
    ++count;
  }
  SumOfSome without(const Radiance& value) const { return {sum - value, count - 1}; }
};

// values: of the samples. Each is compared with its neighbours; the mean of its own region takes the place of
// those in others. Cells end at the edge of a region and add up to its solid angle, so that only what differs
// from the mean is uncertain there. If it has no neighbour in its region, like a direction that sees the wall
// between two windows, it is compared with all other values of its region; if it is alone in its region, with
// all neighbours except those in kNoRegion.
Differences differences(std::span<const Radiance> values, std::span<const DirectionSample> samples,
                        const Neighbours& n) {
  const auto regionOf = [&](size_t i) { return samples[i].region; };
  std::map<RegionId, SumOfSome> regions;
  for (size_t i = 0; i < values.size(); ++i) regions[regionOf(i)].add(values[i]);
  Differences result{std::vector<Radiance>(values.size()), std::vector<double>(values.size())};
  for (size_t i = 0; i < values.size(); ++i) {
    if (regionOf(i) == kNoRegion) continue;
    SumOfSome near, nearInRegion;
    for (uint32_t k = n.first[i]; k < n.first[i + 1]; ++k) {
      const uint32_t other = n.neighbour[k];
      if (regionOf(other) == kNoRegion) continue;
      near.add(values[other]);
      if (regionOf(other) == regionOf(i)) nearInRegion.add(values[other]);
    }
    const SumOfSome& region = regions[regionOf(i)];
    SumOfSome around = near;
    around.sum = nearInRegion.sum + region.sum * ((near.count - nearInRegion.count) / region.count);
    if (nearInRegion.count == 0) around = region.without(values[i]);
    if (around.count == 0) around = near;
    result.around[i] = around.count;
    if (around.count > 0) result.values[i] = values[i] - around.sum / around.count;
  }
  return result;
}

// Variance of one value divided by the variance of its second difference, for independent values with m
// neighbours each. The second difference contains the value itself 1 + 1/m times, and each neighbour -2/m +
// 2/m^2 times, because each neighbour shares two neighbours with the value. kFarther is the contribution of
// neighbours of neighbours, computed for m = 6.
double ownPartOfSecond(double m) {
  constexpr double kFarther = .023;
  return 1 / (std::pow(1 + 1 / m, 2) + 4 / m * std::pow(1 - 1 / m, 2) + kFarther);
}

// The neighbours of the first `count` points of evenly() in the unit square. Points at its opposite sides are
// not neighbours.
Neighbours latticeNeighbours(size_t count, const Imath::V2d& shift) {
  constexpr size_t kSteps = 3;  // a point has six neighbours, in three pairs of opposite steps
  std::vector<std::vector<uint32_t>> around(count);
  for (const EvenStep& s : shortestSteps(count, kSteps))
    for (size_t i = 0; i + s.ahead < count; ++i) {
      const Imath::V2d there = evenly(i, shift.x, shift.y) + s.step;
      if (there.x < 0 || there.x >= 1 || there.y < 0 || there.y >= 1) continue;
      around[i].push_back(static_cast<uint32_t>(i + s.ahead));
      around[i + s.ahead].push_back(static_cast<uint32_t>(i));
    }
  Neighbours n;
  for (const auto& near : around) {
    n.first.push_back(static_cast<uint32_t>(n.neighbour.size()));
    n.neighbour.insert(n.neighbour.end(), near.begin(), near.end());
  }
  n.first.push_back(static_cast<uint32_t>(n.neighbour.size()));
  return n;
}

// The effective number of directions that cause the variance, from the fourth moment of their brightness: n
// for uniformly distributed values; 1.8 k if only k of n directions hit something small and bright.
double sharing(std::span<const DirectionSample> samples, const SpectralSampling* sampling) {
  const auto partOf = [&](const DirectionSample& s) {
    return photopicOf(irradianceFrom(followed(s), s.solidAngle).color, sampling);
  };
  const double n = static_cast<double>(samples.size());
  double mean = 0, second = 0, fourth = 0;
  for (const DirectionSample& s : samples) mean += partOf(s) / n;
  for (const DirectionSample& s : samples) {
    const double square = std::pow(partOf(s) - mean, 2);
    second += square;
    fourth += square * square;
  }
  constexpr double kUniform = 1.8;  // fourth moment of uniformly distributed values over the square of the
                                    // second
  return fourth > 0 ? std::min(n, kUniform * second * second / fourth) : n;
}

// The variance of the sum of all batches, estimated from the differences between them. It includes the
// variance due to the random choice of vertices.
Variance spreadOf(const SharedError& error, const SpectralSampling* sampling) {
  const auto n = static_cast<double>(error.batches.size());
  if (n < 2) return {};
  Irradiance mean;
  for (const Irradiance& b : error.batches) mean += b / n;
  Variance spread;
  for (const Irradiance& b : error.batches) spread += Variance::of(b - mean, sampling) * (n / (n - 1));
  return spread;
}

}  // namespace

void SharedError::add(const SharedError& other, double share) {
  batches.resize(std::max(batches.size(), other.batches.size()));
  for (size_t i = 0; i < other.batches.size(); ++i) batches[i] += other.batches[i] * share;
  chosen += other.chosen * (share * share);
}

Variance sharedVariance(const SharedError& error, const SpectralSampling* sampling) {
  const Variance spread = spreadOf(error, sampling);
  const auto beyond = [](double all, double part) { return std::max(0., all - part); };
  return {combined(spread.channels, error.chosen.channels, beyond),
          beyond(spread.brightness, error.chosen.brightness)};
}

Variance varianceWith(const SharedError& error, Variance own, const SpectralSampling* sampling) {
  const Variance spread = spreadOf(error, sampling);
  own += sharedVariance(error, sampling);
  // The relative standard deviation of a variance estimated from n independent sums is (2 / (n - 1))^1/2.
  const auto n = static_cast<double>(error.batches.size());
  const double least = n < 2 ? 0 : tuning::ErrorEstimate::kLeastShared * std::sqrt(2 / (n - 1));
  const auto larger = [&](double all, double part) { return std::max(all, least * part); };
  return {combined(own.channels, spread.channels, larger), larger(own.brightness, spread.brightness)};
}

void KernelVariances::add(const V3d& direction, const Variance& variance) {
  kernels.weigh(direction, [&](size_t i, double weight) { all[i] += variance * (weight * weight); });
}

void KernelVariances::addToZones(const V3d& direction, double cell, const Variance& variance) {
  if (kernels.zones)
    kernels.zones->divide(direction, cell,
                          [&](size_t zone, double share) { all[zone] += variance * (share * share); });
}

std::vector<DirectionSample> weighted(std::span<const DirectionSample> samples, const Kernels& kernels,
                                      size_t quantity) {
  std::vector<DirectionSample> all(samples.begin(), samples.end());
  for (DirectionSample& s : all) {
    const double weight = kernels.weight(quantity, s.direction);
    s.value *= weight;
    s.glanced *= weight;
  }
  return all;
}

void KernelVariances::add(const KernelVariances& other, double factor) {
  for (size_t i = 0; i < other.all.size(); ++i) all[i] += other.all[i] * factor;
}

Variance evenVariance(std::span<const DirectionSample> samples, const Neighbours& n,
                      const SpectralSampling* sampling, KernelVariances* to) {
  std::vector<Radiance> values(samples.size());
  std::ranges::transform(samples, values.begin(), followed);
  const Differences once = differences(values, samples, n), twice = differences(once.values, samples, n);
  Variance sum;
  for (size_t i = 0; i < samples.size(); ++i) {
    const double m = once.around[i];
    if (m == 0) continue;
    const bool second = m >= tuning::ErrorEstimate::kFewestAround, apart = samples[i].region != 0 && !second;
    const Variance part =
        Variance::of(irradianceFrom((second ? twice : once).values[i], samples[i].solidAngle), sampling) *
        ((second ? ownPartOfSecond(m) : m / (m + 1)) * (apart ? 1 : tuning::ErrorEstimate::kEvenSet));
    sum += part;
    if (to) to->addToZones(samples[i].direction, samples[i].solidAngle, part);
  }
  return sum;
}

Variance latticeVariance(std::span<const DirectionSample> samples, const Imath::V2d& shift,
                         const SpectralSampling* sampling, KernelVariances* to) {
  std::vector<Radiance> values(samples.size());
  std::ranges::transform(samples, values.begin(), followed);
  const Differences once = differences(values, samples, latticeNeighbours(samples.size(), shift));
  Variance sum;
  for (size_t i = 0; i < samples.size(); ++i) {
    if (samples[i].region == kNoRegion) continue;
    const double m = once.around[i];
    const Radiance& differs = m > 0 ? once.values[i] : values[i];
    const Variance part = Variance::of(irradianceFrom(differs, samples[i].solidAngle), sampling) *
                          (m > 0 ? m / (m + 1) * tuning::ErrorEstimate::kEvenSet : 1);
    sum += part;
    if (to) to->addToZones(samples[i].direction, samples[i].solidAngle, part);
  }
  return sum;
}

Variance spreadVariance(std::span<const DirectionSample> samples, const SpectralSampling* sampling,
                        KernelVariances* to) {
  const double n = static_cast<double>(samples.size());
  Irradiance sum;
  Variance squares;
  for (const DirectionSample& s : samples) {
    const Irradiance part = irradianceFrom(followed(s), s.solidAngle);
    sum += part;
    squares += Variance::of(part, sampling);
  }
  if (samples.size() < 2) {
    if (to && !samples.empty()) to->addToZones(samples[0].direction, samples[0].solidAngle, squares);
    return squares;
  }
  // Factor by which even spreading reduces the variance. If an edge crosses the region, only the cells on the
  // edge contribute to the variance: about n^1/2 of n cells. For an object smaller than the spacing of
  // directions, there is no reduction. Therefore n is the effective number of directions that sharing()
  // returns, which is small if few directions find the object.
  const double even = 1 / (1 + std::sqrt(sharing(samples, sampling)) / tuning::ErrorEstimate::kEvenRun);
  for (const DirectionSample& s : samples)
    if (to)
      to->addToZones(
          s.direction, s.solidAngle,
          Variance::of(irradianceFrom(followed(s), s.solidAngle) - sum / n, sampling) * (n / (n - 1) * even));
  squares += Variance::of(sum, sampling) * (-1 / n);
  return squares * (n / (n - 1) * even);
}

Variance loneVariance(const DirectionSample& sample, std::span<const DirectionSample> base,
                      const SpectralSampling* sampling, KernelVariances* to) {
  Radiance sum;
  int count = 0;
  for (const DirectionSample& s : base) {
    if (s.region != sample.region) continue;
    sum += followed(s);
    ++count;
  }
  const double own = count == 0 ? 1 : static_cast<double>(count) / (count + 1);
  const Radiance around = count == 0 ? Radiance() : sum / count;
  const Variance variance =
      Variance::of(irradianceFrom(followed(sample) - around, sample.solidAngle), sampling) * own;
  if (to) to->addToZones(sample.direction, sample.solidAngle, variance);
  return variance;
}

Variance unseenVariance(std::span<const DirectionSample> samples, const SpectralSampling* sampling,
                        KernelVariances* to) {
  struct Found {
    Irradiance sum;
    int count = 0;
    V3d direction{0, 0, 1};  // of one of the samples
  };
  std::map<RegionId, Found> found;
  for (const DirectionSample& s : samples) {
    if (s.region == 0 || s.region == kNoRegion) continue;
    Found& here = found[s.region];
    here.sum += irradianceFrom(s.value, s.solidAngle);
    ++here.count;
    here.direction = s.direction;
  }
  Variance sum;
  for (const auto& [region, here] : found) {
    const Variance unseen =
        Variance::of(here.sum * (tuning::ErrorEstimate::kUnseen / (here.count + 1)), sampling);
    sum += unseen;
    if (to) to->addToZones(here.direction, 0, unseen);
  }
  return sum;
}

}  // namespace rsphere
