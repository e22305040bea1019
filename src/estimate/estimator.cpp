#include "estimate/estimator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "estimate/equal_weights.h"
#include "estimate/silhouette_weights.h"
#include "estimate/tuning.h"
#include "estimate/two_halves.h"
#include "estimate/voronoi_weights.h"
#include "points/tuning.h"
#include "rays/ray_report.h"
#include "targets/contrasts.h"
#include "transport/find_aims.h"

namespace rsphere {
namespace {

// Adds `excess` to the integral over the samples: in proportion to the light of the glances along them, or
// evenly if that is 0.
void shareOut(const Irradiance& excess, std::vector<DirectionSample>& samples) {
  Irradiance glanced;
  double solidAngle = 0;
  for (const DirectionSample& s : samples) {
    glanced += irradianceFrom(s.glanced, s.solidAngle);
    solidAngle += s.solidAngle;
  }
  // The factor for one channel or band. all: integral of the light of glances; more: the excess.
  const auto scaleOf = [](double all, double more) { return all > 0 ? more / all : 0; };
  const auto shiftOf = [&](double all, double more) {
    return all > 0 || !(solidAngle > 0) ? 0 : more / solidAngle;
  };
  const Color scale =
      combined(excess.color, glanced.color, [&](double e, double g) { return scaleOf(g, e); });
  const Color shift =
      combined(excess.color, glanced.color, [&](double e, double g) { return shiftOf(g, e); });
  for (DirectionSample& s : samples) s.value.color += scale * s.glanced.color + shift;
}

// Sets radiances to 0 that a negative excess has made negative, and reduces the others so that the integral
// does not change.
void keepPositive(std::vector<DirectionSample>& samples) {
  Color sum, positive;
  for (const DirectionSample& s : samples) {
    sum += s.value.color * s.solidAngle;
    Color part = s.value.color;
    part.transform([](double v) { return std::max(0., v); });
    positive += part * s.solidAngle;
  }
  for (DirectionSample& s : samples)
    s.value.color = combined(s.value.color, sum, positive, [](double value, double all, double kept) {
      return !(all > 0) || all == kept ? value : std::max(0., value) * (all / kept);
    });
}

void addAll(const std::vector<SharedError>& more, double share, std::vector<SharedError>& to) {
  to.resize(std::max(to.size(), more.size()));
  for (size_t i = 0; i < more.size(); ++i) to[i].add(more[i], share);
}

// Sums over the sets of one half (two_halves.h), or of both.
struct Half {
  Moments moments;
  Irradiance excess;
  Variance variance;
  SharedError shared;
  KernelVariances ofKernels;
  std::vector<SharedError> sharedByKernel;

  explicit Half(const Kernels& kernels) : moments(kernels.zones.get()), ofKernels(kernels) {}

  void add(const SampledSet& set, const Moments& ofSet) {
    moments.add(ofSet, 1);
    excess += set.excess.total;
    variance += set.variance;
    shared.add(set.shared, 1);
    ofKernels.add(set.ofKernels, 1);
    addAll(set.sharedByKernel, 1, sharedByKernel);
  }
  void add(const Half& other, double share) {
    moments.add(other.moments, share);
    excess += other.excess * share;
    variance += other.variance * (share * share);
    shared.add(other.shared, share);
    ofKernels.add(other.ofKernels, share * share);
    addAll(other.sharedByKernel, share, sharedByKernel);
  }
};

struct KeptSet {
  size_t half;
  SampledSet set;
};

template <class T>
void append(std::vector<T>& all, std::vector<T>&& more) {
  if (all.empty())
    all = std::move(more);
  else
    all.insert(all.end(), more.begin(), more.end());
}

// Merges all sets into one, with their weights in the average of the sets. excess: the average of
// SampledSet::excess, which is added to the samples if every direction is printed.
SampledSet joined(std::vector<KeptSet> sets, const TwoHalves& halves, const Irradiance& excess,
                  bool everyDirection) {
  SampledSet all;
  for (KeptSet& kept : sets) {
    for (DirectionSample& s : kept.set.samples) s.solidAngle *= halves.share(kept.half);
    append(all.samples, std::move(kept.set.samples));
    append(all.rays, std::move(kept.set.rays));
  }
  if (everyDirection && !(excess.color == Color(0))) {
    shareOut(excess, all.samples);
    keepPositive(all.samples);
  }
  return all;
}

// The relative error of the coarse solution, common to all points of a run; 0 without a coarse solution.
double coarseError(const SphereTracing& tracing) {
  if (!tracing.caches.coarse) return 0;
  const RayOptions& o = tracing.prepared.options();
  const double rays = std::max(o.ambientDivisions + o.ambientSuperSamples, o.leastForPatches);
  return tuning::ErrorEstimate::kPatches *
         std::sqrt(1 + tuning::ErrorEstimate::kUsualRays / std::max(rays, 1.));
}

// The variance of the total due to the relative error of the coarse solution.
Variance coarseVariance(const Irradiance& total, const SpectralSampling* sampling, double error) {
  return Variance::of(total, sampling) * (error * error);
}

// Rounding may leave a variance a little below 0.
PointAnswer::OwnError standardErrorOf(const Variance& variance, double solidAngle) {
  const auto root = [&](double v) { return solidAngle > 0 ? std::sqrt(std::max(0., v)) / solidAngle : 0; };
  PointAnswer::OwnError error{Radiance(variance.channels), root(variance.brightness)};
  error.channels.color.transform(root);
  return error;
}

// The errors of the zones and quantities that have errors of their own.
class KernelErrors {
 public:
  // coarse: coarseError().
  KernelErrors(const Half& sums, const BaseSet& base, double coarse)
      : sums_(sums), base_(base), coarse_(coarse) {}

  std::vector<PointAnswer::OwnError> ofZones() const {
    std::vector<PointAnswer::OwnError> errors;
    for (size_t i = 0; i < base_.kernels.zoneCount(); ++i) {
      const Color& border = sums_.moments.borders[i];
      errors.push_back(
          of(i, sums_.moments.ofZones[i], base_.kernels.zones->solidAngle(i), {border, brightness(border)}));
    }
    return errors;
  }
  // answer: with the quantities.
  std::vector<PointAnswer::OwnError> ofQuantities(const PointAnswer& answer) const {
    std::vector<PointAnswer::OwnError> errors;
    if (base_.kernels.quantities.none()) return errors;
    const size_t first = base_.kernels.zoneCount();
    for (size_t i = 0; i < Kernels::kQuantities; ++i) errors.push_back(of(first + i, valueOf(i, answer), 1));
    return errors;
  }

 private:
  PointAnswer::OwnError of(size_t kernel, const Irradiance& value, double solidAngle,
                           const Variance& more = {}) const {
    Variance variance = sums_.ofKernels.all[kernel];
    variance += more;
    if (kernel < sums_.sharedByKernel.size())
      variance = varianceWith(sums_.sharedByKernel[kernel], variance, base_.sampling);
    variance += coarseVariance(value, base_.sampling, coarse_);
    return standardErrorOf(variance, solidAngle);
  }
  Irradiance valueOf(size_t quantity, const PointAnswer& a) const {
    if (quantity == Kernels::cylindrical) return a.cylindricalIrradiance;
    if (quantity == Kernels::semicylindrical) return a.semicylindricalIrradiance(base_.kernels.facing);
    if (quantity == Kernels::hemispherical) return a.hemisphericalIrradiance();
    if (quantity < Kernels::vector) return a.facing[quantity - Kernels::faces];
    const size_t axis = quantity - Kernels::vector;
    return a.facing[2 * axis] - a.facing[2 * axis + 1];
  }

  const Half& sums_;
  const BaseSet& base_;
  double coarse_;
};

// Whether the default strategy (-Sw c) sends directions to special objects (-Sk above 0).
bool sendsToSpecialObjects(const SphereOptions& options) {
  return options.weights == Weights::silhouettes && options.densityFactor > 0;
}

// Null where light vertices miss some of the light, and for strategies that do not use them.
std::unique_ptr<const DiffuseGlances> glancesFor(const PreparedScene& prepared, const SphereOptions& options,
                                                 const BaseSet& base) {
  if (!sendsToSpecialObjects(options)) return nullptr;
  return DiffuseGlances::make(prepared, options, base);
}

// Light vertices replace the caches of interpolated light: they are unbiased, and need less time for an equal
// error (tests/bench/rtrace/runs/2026-11-25-lamps.txt). Without caches (-aa 0), bright spots are found only
// behind openings.
const Caches& cachesFor(const Transport& transport, bool haveVertices) {
  static const Caches none;
  return haveVertices ? none : transport.caches();
}
Aims aimsFor(const Transport& transport, bool haveVertices) {
  Aims aims = transport.aims();
  if (haveVertices && !aims.of<Openings>()) aims.leaveOut<BrightSpots>();
  return aims;
}

}  // namespace

SphereEstimator::SphereEstimator(const Transport& transport, const SphereOptions& options, bool standardError)
    : options_(options),
      base_(makeBaseSet(options, transport.prepared().options().sampling,
                        standardError || options.accuracy > 0)),
      sources_(transport.prepared()),
      usual_(usualMethod(transport, options, base_)) {
  const PreparedScene& prepared = transport.prepared();
  if (options.weights != Weights::homogeneous)
    special_ = findSpecialObjects(prepared.scene(), options.densityFactor);
  usual_.strategy = makeStrategy(usual_);
  if (!usual_.glances && sendsToSpecialObjects(options))
    if (auto surfaces = daylitSurfaces(usual_.tracing))
      daylit_ = std::make_unique<Daylit>(std::move(*surfaces));
  floor_ = 4 * std::numbers::pi * std::max(options.accuracyFloor, 0.);
  if (options.accuracy > 0 && options.accuracyFloor < 0)
    dark_ = 4 * std::numbers::pi * tuning::Dark::kShare * typicalRadiance(usual_.tracing, sources_);
}

SphereEstimator::Method SphereEstimator::usualMethod(const Transport& transport, const SphereOptions& options,
                                                     const BaseSet& base) {
  auto glances = glancesFor(transport.prepared(), options, base);
  const bool haveVertices = glances != nullptr;
  SphereTracing tracing{transport.prepared(), cachesFor(transport, haveVertices)};
  if (sendsToSpecialObjects(options)) {
    if (haveVertices)
      tracing.pools = &glances->lights();
    else
      tracing.ofPoints = findAimsOfPoints(transport.prepared());
    tracing.aims = aimsFor(transport, haveVertices);
    tracing.aims.add(tracing.ofPoints);
  }
  return {std::move(glances), std::move(tracing)};
}

SphereEstimator::Method SphereEstimator::daylitMethod(const PlainSurfaces& surfaces) const {
  const SphereTracing& usual = usual_.tracing;
  auto glances = DiffuseGlances::makeDaylit(usual, surfaces, options_, base_);
  SphereTracing tracing{usual.prepared, usual.caches, usual.aims, &glances->lights()};
  tracing.aims.leaveOut<BrightSpots>();
  return {std::move(glances), std::move(tracing)};
}

const SamplingStrategy& SphereEstimator::strategyFor(const V3d& point) const {
  if (!daylit_ || !suitsDaylight(point, daylit_->surfaces, usual_.tracing.prepared.options().ambientBounces))
    return *usual_.strategy;
  std::call_once(daylit_->made, [&] {
    Method& made = daylit_->method.emplace(daylitMethod(daylit_->surfaces));
    made.strategy = makeStrategy(made);
  });
  return *daylit_->method->strategy;
}

double SphereEstimator::sharedError() const { return coarseError(usual_.tracing); }

std::unique_ptr<const SamplingStrategy> SphereEstimator::makeStrategy(const Method& method) const {
  switch (options_.weights) {
    case Weights::homogeneous: return std::make_unique<EqualWeights>(options_, base_);
    case Weights::voronoi:
      return std::make_unique<VoronoiWeights>(method.tracing.prepared.scene(), options_, base_, special_);
    case Weights::silhouettes: break;
  }
  return std::make_unique<SilhouetteWeights>(method.tracing, options_, base_, special_, sources_,
                                             method.glances.get());
}

SphereEstimator::Workspace::Workspace(const SphereEstimator& estimator)
    : tracer(estimator.usual_.tracing.tracer()) {}

// lit: number of directions that found light. A small number means a dark point only with -Sw c, which sends
// directions to the sources; with other strategies all directions may miss small sources.
bool SphereEstimator::isDark(const PointAnswer& answer, size_t lit) const {
  if (maxChannel(answer.mean.color) == 0) return true;
  if (sources_.haveSensors()) return false;  // a sensor is found by a single direction
  return options_.weights == Weights::silhouettes &&
         static_cast<double>(lit) < tuning::Dark::kShare * static_cast<double>(answer.directions);
}

PointAnswer SphereEstimator::estimate(const V3d& point, Workspace& workspace) const {
  // -Sa may send a million directions. They are kept only if they are to be printed.
  const bool keep = options_.everyDirection || options_.accuracy <= 0;
  const auto most = static_cast<size_t>(options_.mostOfAllSets());
  std::array<Half, 2> halves{Half(base_.kernels), Half(base_.kernels)};
  std::vector<KeptSet> kept;
  TwoHalves decision(options_.accuracy, dark_, floor_);
  const SamplingStrategy& strategy = strategyFor(point);
  uint64_t sets = 0;
  size_t directions = 0, largest = 0, lit = 0;
  for (auto next = decision.next(); next && directions + largest <= most; next = decision.next()) {
    SampledSet set =
        strategy.sample(SetAtPoint(point, sets++, options_.rotation), workspace.tracer, workspace.voronoi_);
    const Moments moments = set.moments(base_);
    halves[*next].add(set, moments);
    decision.add(*next, photopicOf(moments.total.color, base_.sampling),
                 varianceWith(set.shared, set.variance, base_.sampling).brightness);
    directions += set.samples.size();
    lit += static_cast<size_t>(std::ranges::count_if(
        set.samples, [](const DirectionSample& s) { return maxChannel(s.value.color) != 0; }));
    lit += set.litGlances;
    largest = std::max(largest, set.samples.size());
    if (keep) kept.push_back({*next, std::move(set)});
  }
  Half all(base_.kernels);
  for (size_t k = 0; k < halves.size(); ++k)
    if (const double share = decision.share(k); share > 0) all.add(halves[k], share);
  Variance variance = varianceWith(all.shared, all.variance, base_.sampling);
  variance += coarseVariance(all.moments.total, base_.sampling, sharedError());
  SampledSet samples = joined(std::move(kept), decision, all.excess, options_.everyDirection);
  workspace.samples = std::move(samples.samples);
  workspace.rays = std::move(samples.rays);
  PointAnswer answer = all.moments.answer(point, directions);
  const PointAnswer::OwnError error = standardErrorOf(variance, 4 * std::numbers::pi);
  answer.standardError = error.channels;
  answer.brightnessError = error.brightness;
  if (base_.neighbours) {
    const KernelErrors errors(all, base_, sharedError());
    answer.zoneErrors = errors.ofZones();
    answer.quantityErrors = errors.ofQuantities(answer);
  }
  answer.isDark = isDark(answer, lit) || decision.gaveUp();
  const double value =
      std::max(photopicOf(answer.mean.color, base_.sampling), floor_ / (4 * std::numbers::pi));
  answer.relativeError = value > 0 ? answer.brightnessError / value : 0;
  answer.reached = options_.accuracy <= 0 || decision.isReached();
  return answer;
}

RayAnswer directionAnswer(const Scene& scene, const DirectionSample& sample, const TracedRay& ray) {
  RayAnswer a = answerOf(scene, ray);
  a.direction = sample.direction;
  a.value = sample.value;
  a.solidAngle = sample.solidAngle;
  return a;
}

}  // namespace rsphere
