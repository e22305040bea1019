#include "estimate/ray_estimator.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "base/colorimetry.h"
#include "estimate/tuning.h"
#include "points/error_estimate.h"
#include "targets/contrasts.h"
#include "transport/final_gather.h"
#include "transport/tuning.h"

namespace rsphere {
namespace {

constexpr size_t kSets = RayEstimator::kSets, kInHalf = kSets / 2;
static_assert(kInHalf % kInterleavedGathers == 0);

// All gathers of one ray so far. The sets of a half have equal numbers of rays.
class Gathers {
 public:
  Gathers(bool usesPatches, const SpectralSampling* sampling)
      : usesPatches_(usesPatches), sampling_(sampling) {}

  // A round sends gathers of equal size in all sets of a half.
  void beginRound(size_t half) { rounds_[half].emplace_back(); }
  void add(size_t set, int rays, const TracedRay& ray) {
    Round& round = rounds_[set / kInHalf].back();
    round.rays = rays;
    round.values.push_back(ray.value);
    sums_[set] += ray.value * rays;
    rays_[set] += rays;
    mirrored_ += ray.mirrored * rays;
    ++traced_;
  }
  double raysOf(size_t half) const { return rays_[half * kInHalf]; }  // of each set
  uint64_t traced() const { return traced_; }

  Radiance mean(size_t half) const {
    const std::array<Radiance, kSets> all = means();
    return meanOf(std::span(all).subspan(half * kInHalf, kInHalf));
  }
  Radiance mean() const { return (mean(0) + mean(1)) / 2; }
  Radiance mirrored() const { return mirrored_ / (kInHalf * (raysOf(0) + raysOf(1))); }

  // The part of the variance of the mean that more rays reduce, of a half and of both. The gathers of a round
  // are independent, but for their solutions.
  Variance ofGathers(size_t half) const {
    Variance sum;
    for (const Round& round : rounds_[half]) {
      const double weight = round.rays / (kInHalf * raysOf(half));
      sum += spreadOf(round.values) * (static_cast<double>(round.values.size()) * weight * weight);
    }
    return sum;
  }
  Variance ofGathers() const {
    Variance both = ofGathers(0);
    both += ofGathers(1);
    return both * (1. / 4);
  }
  // The variance of the mean of both halves.
  Variance variance() const {
    const Variance one = ofGathers(), other = ofSolutions();
    return {combined(one.channels, other.channels, [](double x, double y) { return std::max(x, y); }),
            std::max(one.brightness, other.brightness)};
  }

  // Whether the noise of patches is far above this error, and its variance above a multiple of the gathers'.
  bool patchesExceed(double error, double timesGathers) const {
    const double shown = ofSolutions().brightness, most = tuning::RaySets::kTooNoisy * error;
    return shown > most * most && shown > timesGathers * ofGathers().brightness;
  }

 private:
  struct Round {
    int rays = 0;  // of each gather
    std::vector<Radiance> values;
  };

  // Of the gathers of each set.
  std::array<Radiance, kSets> means() const {
    std::array<Radiance, kSets> of;
    for (size_t k = 0; k < kSets; ++k) of[k] = sums_[k] / rays_[k];
    return of;
  }
  static Radiance meanOf(std::span<const Radiance> values) {
    Radiance sum;
    for (const Radiance& value : values) sum += value;
    return sum / static_cast<double>(values.size());
  }
  // The variance of a single value, from the spread of all.
  Variance spreadOf(std::span<const Radiance> values) const {
    const Radiance mean = meanOf(values);
    Variance sum;
    for (const Radiance& value : values) sum += Variance::of(Irradiance((value - mean).color), sampling_);
    return sum * (1. / static_cast<double>(values.size() - 1));
  }
  // From the spread of the means of all sets, whose solutions are their own; 0 without patches.
  Variance ofSolutions() const {
    if (!usesPatches_) return {};
    return spreadOf(means()) * (1. / kSets);
  }

  bool usesPatches_;
  const SpectralSampling* sampling_;
  std::array<std::vector<Round>, 2> rounds_;  // by half
  std::array<Radiance, kSets> sums_;          // of values times rays, by set
  std::array<double, kSets> rays_{};
  Radiance mirrored_;  // times rays
  uint64_t traced_ = 0;
};

// The average radiance that the surfaces of the scene see (W/sr/m2), or the irradiance that it causes.
double usualValue(const Transport& transport) {
  RayOptions few = transport.prepared().options();  // a few paths are enough
  few.ambientAccuracy = few.ambientSuperSamples = 0;
  few.ambientDivisions = 1;
  const Transport ofPaths(transport, few);
  const SeenSources sources(ofPaths.prepared());
  const double radiance = typicalRadiance({ofPaths.prepared(), ofPaths.caches()}, sources);
  return transport.prepared().irradiance() == IrradianceAt::none ? radiance : std::numbers::pi * radiance;
}

}  // namespace

RayEstimator::RayEstimator(const Transport& transport, const Options& options)
    : transport_(transport), options_(options), target_(options.accuracy), floor_(options.floor) {
  const PreparedScene& prepared = transport.prepared();
  const RayOptions& o = prepared.options();
  const int asked = o.ambientDivisions + o.ambientSuperSamples;
  if (options.accuracy > 0) {
    first_ = tuning::RaySets::kFirst;
    most_ = tuning::RaySets::kMost / (options.accuracy * options.accuracy * kSets);
    usual_ = usualValue(transport);
    if (floor_ < 0) floor_ = tuning::RaySets::kDark * usual_;
    return;
  }
  floor_ = 0;
  first_ = std::max(1, asked / static_cast<int>(kSets));
  if (prepared.irradiance() != IrradianceAt::point || o.ambientSuperSamples == 0) return;
  // As without -oe, the gather of a sensor gets more rays where it is noisy.
  target_ = o.ambientAccuracy / tuning::SensorNoise::kAccuracy;
  most_ = (asked + mostAddedAtSensors(o)) / static_cast<double>(kSets);
}

// Rays do not reduce the noise of patches, which therefore has to be below the accuracy.
double RayEstimator::raysForPatches(const RayOptions& options, double accuracy) {
  constexpr double kUsualAccuracy = .01;  // at which -ad + -as suffice
  const double finer = kUsualAccuracy / accuracy;
  return (options.ambientDivisions + options.ambientSuperSamples) *
         std::clamp(finer * finer, tuning::RaySets::kFewestForPatches, tuning::RaySets::kMostForPatches);
}

std::vector<PathTracer> RayEstimator::tracers() const {
  TracingMode mode;
  mode.interpolates = false;
  std::vector<PathTracer> tracers;
  for (; mode.solution < transport_.prepared().options().solutions; ++mode.solution)
    tracers.push_back(transport_.pathTracer(mode));
  static const Caches none;
  if (options_.accuracy > 0 && transport_.caches().coarse)
    tracers.emplace_back(transport_.prepared(), none, transport_.aims());
  return tracers;
}

RayEstimator::Estimate RayEstimator::estimate(std::vector<PathTracer>& tracers, const V3d& origin,
                                              const V3d& direction, double farthest, uint64_t seed,
                                              PathRequest request) const {
  const bool usesPatches = transport_.caches().coarse != nullptr;
  const auto trace = [&](PathTracer& tracer, const Sent& sent) {
    request.rays = sent.rays;
    return tracer.trace(origin, direction, farthest, sent.seed, request);
  };
  const auto solutions = static_cast<size_t>(transport_.prepared().options().solutions);
  const auto gather = [&](const Sent& sent) {
    if (usesPatches)
      request.interleaved = {.lattice = sent.together,
                             .number = static_cast<int>(sent.set % kInterleavedGathers)};
    return trace(tracers[sent.set % solutions], sent);
  };
  const Attempt attempted = attempt(gather, seed, usesPatches);
  if (!attempted.patchesTooNoisy) return attempted.estimate;
  request.interleaved.reset();
  const Attempt byPaths =
      attempt([&](const Sent& sent) { return trace(tracers.back(), sent); }, mixBits(seed), false);
  const bool better = byPaths.estimate.relativeError < attempted.estimate.relativeError;
  return (better ? byPaths : attempted).estimate;
}

RayEstimator::Estimate RayEstimator::estimate(const Gather& gather, uint64_t seed) const {
  return attempt(gather, seed, transport_.caches().coarse != nullptr).estimate;
}

RayEstimator::Attempt RayEstimator::attempt(const Gather& gather, uint64_t seed, bool usesPatches) const {
  const SpectralSampling* const sampling = transport_.prepared().options().sampling;
  Attempt attempted;
  Estimate& answer = attempted.estimate;
  Gathers all(usesPatches, sampling);
  bool gathers = false;
  // Adds a round of gathers to a half, so that each of its sets has this number of rays.
  const auto addRound = [&](size_t half, double upTo) {
    const double more = upTo - all.raysOf(half);  // of each set
    const int most = gathers ? tuning::RaySets::kMostAtOnce : tuning::RaySets::kFirst;
    const int least = all.raysOf(half) > 0 ? 1 : tuning::RaySets::kFirstGathers;
    const int times = std::max(least, static_cast<int>(std::ceil(more / most)));
    const int rays = std::max(1, static_cast<int>(more / times));
    all.beginRound(half);
    const uint64_t round = mixBits(~seed ^ mixBits(1 + all.traced()));
    for (size_t k = half * kInHalf; k < (half + 1) * kInHalf; ++k) {
      for (int i = 0; i < times; ++i) {
        const TracedRay ray = gather({.set = k,
                                      .rays = rays,
                                      .seed = mixBits(seed ^ mixBits(1 + all.traced())),
                                      .together = mixBits(round + i * kSets + k / kInterleavedGathers)});
        if (all.traced() == 0) answer.ray = ray;
        gathers = gathers || ray.gathers;
        all.add(k, rays, ray);
      }
    }
  };
  const auto valueOf = [&](const Radiance& mean) {
    return std::max(std::abs(photopicOf(mean.color, sampling)), floor_);
  };
  const double margin = usesPatches ? tuning::RaySets::kOfGathers : tuning::Stopping::kMargin;
  addRound(0, first_);
  addRound(1, first_);
  for (bool goesOn = target_ > 0; goesOn;) {
    if (options_.accuracy > 0 &&
        all.patchesExceed(target_ * valueOf(all.mean()), tuning::RaySets::kByPatches)) {
      attempted.patchesTooNoisy = true;
      answer.reached = false;
      break;
    }
    std::array<double, 2> asked;
    const auto ask = [&](size_t half, double rays) {
      const double has = all.raysOf(half);
      asked[half] = std::min({rays, has * tuning::RaySets::kGrowth, most_});
      // Few rays more are not worth a round.
      if (!(asked[half] > tuning::RaySets::kLeastGrowth * has)) asked[half] = has;
    };
    const auto asks = [&] { return asked[0] > all.raysOf(0) || asked[1] > all.raysOf(1); };
    for (const size_t half : {0, 1}) {
      const size_t other = 1 - half;
      const double wanted = margin * target_ * valueOf(all.mean(other));
      const double excess = all.ofGathers(other).brightness / (2 * wanted * wanted);
      ask(half, all.raysOf(other) * excess);
    }
    if (!asks()) {
      const double wanted = target_ * valueOf(all.mean()), most = wanted * wanted;
      const double excess = all.variance().brightness / most;
      const bool reached = !(excess > 1);  // also if both are 0
      const bool helps = all.ofGathers().brightness > tuning::RaySets::kLargePart * most;
      answer.reached = reached || !(options_.accuracy > 0);
      for (const size_t half : {0, 1})
        if (!reached && helps) ask(half, all.raysOf(half) * std::max(excess, tuning::RaySets::kAtLast));
    }
    goesOn = asks();
    if (!goesOn && !answer.reached)
      attempted.patchesTooNoisy =
          all.patchesExceed(target_ * valueOf(all.mean()), tuning::RaySets::kByPatchesAtLast);
    for (const size_t half : {0, 1})
      if (asked[half] > all.raysOf(half)) addRound(half, asked[half]);
  }
  const auto root = [](double v) { return std::sqrt(std::max(0., v)); };
  Variance variance = all.variance();
  answer.ray.value = all.mean();
  // If no ray has found light, one more might have found as much as surfaces usually see.
  if (gathers && isBlack(answer.ray.value.color) && variance.brightness == 0) {
    const double missed = usual_ / (kInHalf * (all.raysOf(0) + all.raysOf(1)));
    variance = {Color(missed * missed), missed * missed};
  }
  answer.ray.mirrored = all.mirrored();
  answer.standardError = Radiance(variance.channels);
  answer.standardError.color.transform(root);
  answer.brightnessError = root(variance.brightness);
  if (const double value = valueOf(answer.ray.value); value > 0)
    answer.relativeError = answer.brightnessError / value;
  return attempted;
}

}  // namespace rsphere
