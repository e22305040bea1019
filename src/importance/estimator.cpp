#include "importance/estimator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "importance/two_halves.h"
#include "rad_parser/error.h"
#include "scene/even_sequence.h"
#include "sphere/directions.h"
#include "transport/ray_answer.h"

namespace rsphere {
namespace {

constexpr double kPi = std::numbers::pi;

// Rays at a point for the mean that the deviation on special objects is held against.
constexpr int kRaysAPoint = 32;

// Glances for each base direction. Each takes .15 to .5 us, a followed direction 1 to 100.
// Not more than kMostGlances where the base alone is not.
constexpr size_t kGlances = 4, kMostGlances = 65536;

// Adds what sums to `excess` over all solid angles: in proportion to the guesses, or evenly where all are 0.
void shareOut(const Rgb& excess, std::span<const Rgb> guesses, std::vector<DirectionSample>& samples) {
  Rgb guessed(0, 0, 0);
  double solidAngle = 0;
  for (size_t i = 0; i < samples.size(); ++i) {
    guessed += guesses[i] * samples[i].solidAngle;
    solidAngle += samples[i].solidAngle;
  }
  for (int c = 0; c < 3; ++c) {
    const double scale = guessed[c] > 0 ? excess[c] / guessed[c] : 0,
                 shift = guessed[c] > 0 || !(solidAngle > 0) ? 0 : excess[c] / solidAngle;
    for (size_t i = 0; i < samples.size(); ++i) samples[i].value[c] += scale * guesses[i][c] + shift;
  }
}

// Single values that guesses have made negative become 0, and the others less by as much in all.
void keepPositive(std::vector<DirectionSample>& samples) {
  for (int c = 0; c < 3; ++c) {
    double sum = 0, positive = 0;
    for (const DirectionSample& s : samples) {
      sum += s.value[c] * s.solidAngle;
      positive += std::max(0., s.value[c]) * s.solidAngle;
    }
    if (!(sum > 0) || sum == positive) continue;
    for (DirectionSample& s : samples) s.value[c] = std::max(0., s.value[c]) * (sum / positive);
  }
}

}  // namespace

SphereEstimator::SphereEstimator(const Transport& transport, const SphereOptions& options, bool standardError)
    : transport_(transport),
      options_(options),
      sources_(transport),
      standardError_(standardError || options.accuracy > 0) {
  const auto count = static_cast<size_t>(options.baseDirections);
  directions_ = rotatedDirections(baseDirections(count), options.rotation);
  const bool equal = options.weights == Weights::homogeneous;
  if (equal) solidAngles_.assign(count, 4 * kPi / static_cast<double>(count));
  if (!equal || standardError_ || options.verify) {
    VoronoiWorkspace workspace;
    const auto areas = cellSolidAngles(directions_, workspace);
    if (!equal) solidAngles_.assign(areas.begin(), areas.end());
    if (standardError_) {
      VoronoiCells cells = voronoiCells(workspace);
      neighbours_ = {std::move(cells.first), std::move(cells.neighbour)};
    }
    if (options.verify)
      if (const auto fault = voronoiFault(workspace))
        throw rad::Error("weights of the directions: " + *fault);
  }
  if (equal) return;
  if (options.weights == Weights::voronoi) base_.emplace(directions_);
  special_ = findSpecialObjects(transport.scene(), options.densityFactor);
  if (options.weights != Weights::silhouettes || !(options.densityFactor > 0)) return;
  const RayOptions& rays = transport.options();
  if (rays.ambientBounces > 0 && rays.ambientDivisions > 0) {
    auto spots = std::make_unique<BrightSpots>(transport.scene(), transport.tracer(), transport.lights());
    if (!spots->empty()) spots_ = std::move(spots);
  }
  targets_.emplace(transport, special_, sources_, spots_.get(), options.densityFactor);
  std::vector<bool> unguessed = sources_.apart();
  for (const int32_t mirror : sources_.mirrors()) unguessed[static_cast<size_t>(mirror)] = true;
  guess_.emplace(transport, unguessed);
  const size_t glances = std::min(kGlances * count, std::max(count, kMostGlances));
  glances_ = rotatedDirections(baseDirections(glances), options.rotation);
  fitGlances_ = baseDirections(RadianceGuess::kFitGlances);
}

PointAnswer SphereEstimator::estimate(const V3d& point, Workspace& w) const {
  w.samples.clear();
  w.rays.clear();
  w.guesses.clear();
  // Directions of -Sa may be a million; they are only kept where they are asked for.
  const bool keep = options_.everyDirection || options_.accuracy <= 0;
  const auto most = static_cast<size_t>(options_.mostOfAllSets());
  struct Half {
    Moments sum;  // of its sets, as are the next two
    Rgb excess{0, 0, 0};
    Variance variance;
    std::vector<std::pair<size_t, size_t>> places;  // of its sets in w.samples, where they are kept
  };
  std::array<Half, 2> halves;
  TwoHalves decision(options_.accuracy);
  uint64_t sets = 0;
  size_t directions = 0, largest = 0;
  for (auto next = decision.next(); next && directions + largest <= most; next = decision.next()) {
    if (w.checkStop) w.checkStop();
    if (!keep) {
      w.samples.clear();
      w.guesses.clear();
    }
    const size_t first = w.samples.size();
    w.excess = Moments();
    sampleSet(point, sets++, w);
    Moments found;
    for (size_t i = first; i < w.samples.size(); ++i)
      found.add(w.samples[i].direction, w.samples[i].value * w.samples[i].solidAngle);
    found.add(w.excess, 1);
    Half& half = halves[*next];
    half.sum.add(found, 1);
    half.excess += w.excess.total;
    half.variance += w.variance;
    if (keep) half.places.push_back({first, w.samples.size()});
    decision.add(*next, brightness(found.total), w.variance.brightness);
    directions += w.samples.size() - first;
    largest = std::max(largest, w.samples.size() - first);
  }
  Moments moments;
  Rgb excess(0, 0, 0);
  Variance variance;
  for (size_t k = 0; k < halves.size(); ++k) {
    const double share = decision.share(k);
    if (!(share > 0)) continue;
    moments.add(halves[k].sum, share);
    excess += halves[k].excess * share;
    variance += halves[k].variance * (share * share);
    for (const auto& [first, end] : halves[k].places)
      for (size_t i = first; i < end; ++i) w.samples[i].solidAngle *= share;
  }
  PointAnswer answer = moments.answer(point, directions);
  // Rounding may leave a variance a little below 0.
  const auto standardError = [](double v) { return std::sqrt(std::max(0., v)) / (4 * kPi); };
  for (int i = 0; i < 3; ++i) answer.standardError[i] = standardError(variance.channels[i]);
  answer.brightnessError = standardError(variance.brightness);
  answer.reached = options_.accuracy <= 0 || decision.isReached();
  if (!w.guesses.empty() && keep) {
    shareOut(excess, w.guesses, w.samples);
    keepPositive(w.samples);
  }
  return answer;
}

void SphereEstimator::sampleSet(const V3d& point, uint64_t set, Workspace& w) const {
  const uint64_t seed = seedOf(std::initializer_list<double>{point.x, point.y, point.z},
                               mixBits(options_.rotation + (set << 32)));
  w.variance = {};
  w.directions = set == 0 ? directions_ : rotatedDirections(directions_, mixBits(seed));
  if (guess_ && set > 0) w.turnedGlances = rotatedDirections(glances_, mixBits(seed));
  w.glances = set == 0 ? glances_ : w.turnedGlances;
  w.rest.clear();
  w.places.clear();
  w.counted.assign(w.directions.size(), true);
  switch (options_.weights) {
    case Weights::homogeneous:
      return sampleEqually(point, seed, w);
    case Weights::voronoi:
      return sampleAsPaper(point, seed, w);
    case Weights::silhouettes:
      return sampleSilhouettes(point, seed, w);
  }
}

void SphereEstimator::sampleEqually(const V3d& point, uint64_t seed, Workspace& w) const {
  const size_t first = w.samples.size();
  for (size_t i = 0; i < w.directions.size(); ++i)
    traceInto(w, point, w.directions[i], solidAngles_[i], mixBits(seed + i));
  if (standardError_) w.variance = baseVariance(std::span(w.samples).subspan(first), neighbours_, w.counted);
}

void SphereEstimator::traceInto(Workspace& w, const V3d& point, const V3d& direction, double solidAngle,
                                uint64_t seed) const {
  const Ray ray = w.tracer.trace(point, direction, 0, seed);
  w.samples.push_back({direction, solidAngle, ray.value});
  if (options_.everyDirection) w.rays.push_back(ray);
}

// The paper, section 4: density times solid angle directions for each special object, those of the objects
// with the fewest dropped where there are too many, plain Voronoi cells of all.
void SphereEstimator::sampleAsPaper(const V3d& point, uint64_t seed, Workspace& w) const {
  const Scene& scene = transport_.scene();
  struct Wanted {
    Silhouette silhouette;
    size_t count;
  };
  std::vector<Wanted> wanted;
  for (const SpecialObject& object : special_) {
    Silhouette s = silhouetteOf(scene, object, point);
    const auto count = static_cast<size_t>(std::min(object.density * s.solidAngle() + .5, 1e9));
    if (count > 0) wanted.push_back({std::move(s), count});
  }
  std::stable_sort(wanted.begin(), wanted.end(),
                   [](const auto& a, const auto& b) { return a.count > b.count; });
  const auto most = static_cast<size_t>(options_.mostDirections);
  size_t left = most > w.directions.size() ? most - w.directions.size() : 0;
  w.dynamic.clear();
  Random random(seed);
  for (const Wanted& object : wanted) {
    const double shift1 = random.uniform(), shift2 = random.uniform();
    const size_t count = std::min(object.count, left);
    for (size_t i = 0; i < count; ++i) {
      const Imath::V2d u = evenly(i, shift1, shift2);
      w.dynamic.push_back(object.silhouette.sample(u.x, u.y));
    }
    left -= count;
  }
  std::vector<V3d> all;
  const bool turned = w.directions != directions_;
  if (turned) {
    all = w.directions;
    all.insert(all.end(), w.dynamic.begin(), w.dynamic.end());
  }
  const auto areas = turned ? cellSolidAngles(all, w.voronoi) : cellSolidAngles(*base_, w.dynamic, w.voronoi);
  if (options_.verify)
    if (const auto fault = voronoiFault(w.voronoi)) throw rad::Error("weights of the directions: " + *fault);
  const size_t first = w.samples.size();
  for (size_t i = 0; i < areas.size(); ++i)
    traceInto(w, point, i < w.directions.size() ? w.directions[i] : w.dynamic[i - w.directions.size()],
              areas[i], mixBits(seed + i));
  if (!standardError_) return;
  VoronoiCells cells = voronoiCells(w.voronoi);
  w.counted.assign(areas.size(), true);
  w.variance = baseVariance(std::span(w.samples).subspan(first),
                            {std::move(cells.first), std::move(cells.neighbour)}, w.counted);
}

// Rays that take no other part: what the guess is fitted to, and what special objects are held against.
void SphereEstimator::lookAround(const V3d& point, uint64_t seed, Workspace& w) const {
  w.traced.clear();
  w.around = 0;
  Random random(mixBits(seed));
  for (int i = 0; i < kRaysAPoint; ++i) {
    // Stratified in height: the sphere's equal-area slices.
    const double z = 1 - 2 * (i + random.uniform()) / kRaysAPoint, angle = 2 * kPi * random.uniform();
    const double r = std::sqrt(std::max(0., 1 - z * z));
    const V3d direction(r * std::cos(angle), r * std::sin(angle), z);
    const Ray ray = w.tracer.trace(point, direction, 0, random.bits());
    if (sources_.shown(w.tracer, w.images)) continue;
    const Hit& hit = w.tracer.firstHit();
    w.traced.push_back({guess_->placeOf(point, direction, hit), hit.surface, ray.value});
    w.around += brightness(ray.value) / kRaysAPoint;
  }
}

void SphereEstimator::sampleSilhouettes(const V3d& point, uint64_t seed, Workspace& w) const {
  const auto most = static_cast<size_t>(options_.mostDirections);
  const size_t base = w.directions.size();

  w.images = sources_.findImages(point, std::max<size_t>(base / 4, 16), options_.densityFactor);
  w.tracer.guessWith(nullptr);
  if (guess_) {
    lookAround(point, mixBits(seed + 2), w);
    const uint64_t fitSeed = mixBits(seed + 4);
    w.local =
        guess_->fit(point, rotatedDirections(fitGlances_, mixBits(fitSeed)), w.traced, mixBits(fitSeed + 1));
    w.tracer.guessWith(&*w.local);
  }

  // Sources that are seen directly.
  double seen = 0;
  w.sources = sources_.sample(point, w.images, mixBits(seed + 1), w.tracer);
  for (const SeenSources::Sample& s : w.sources) {
    seen += s.direction.solidAngle;
    w.samples.push_back(s.direction);
    if (options_.everyDirection) w.rays.push_back(s.ray);
  }

  // Base and dynamic directions, each with the solid angle that it stands for where all that were sent are
  // even.
  const size_t used = base + w.sources.size();
  const Targets targets =
      targets_ ? targets_->at(point, w.around, base, most > used ? most - used : 0) : Targets({});
  double total = 0;
  const auto send = [&](const V3d& d, double baseCell, uint64_t raySeed) {
    const double solidAngle = 1 / (1 / baseCell + targets.densityAt(d));
    traceInto(w, point, d, solidAngle, raySeed);
    if (sources_.shown(w.tracer, w.images)) {
      w.samples.back().solidAngle = 0;
      w.samples.back().value = Rgb(0, 0, 0);
    } else {
      total += solidAngle;
      w.rest.push_back(w.samples.size() - 1);
      if (guess_) w.places.push_back(guess_->placeOf(point, d, w.tracer.firstHit()));
    }
  };
  const size_t firstBase = w.samples.size();
  for (size_t i = 0; i < base; ++i) {
    const size_t before = w.rest.size();
    send(w.directions[i], solidAngles_[i], mixBits(seed + 16 + i));
    w.counted[i] = w.rest.size() > before;
  }
  Random random(mixBits(seed + 3));
  // Whole numbers of directions with the right average, one running sum over all objects.
  double due = random.uniform();
  w.runs.clear();
  uint64_t next = base;
  for (const Target& target : targets.all()) {
    due += target.expected;
    const double shift1 = random.uniform(), shift2 = random.uniform();
    if (!target.continues) w.runs.push_back(w.samples.size());
    for (size_t i = 0; due >= 1; --due, ++i) {
      const Imath::V2d u = evenly(i, shift1, shift2);
      send(target.silhouette.sample(u.x, u.y), 4 * kPi / static_cast<double>(base),
           mixBits(seed + 16 + next++));
    }
  }
  // All stand for the sphere but for the sources' part of it.
  const double scale = total > 0 ? std::max(0., 4 * kPi - seen) / total : 0;
  for (const size_t i : w.rest) w.samples[i].solidAngle *= scale;
  if (guess_) glance(point, w);
  if (standardError_) addVariances(firstBase, w);
}

// What is guessed of the last set's directions, and how much more or less many glances find of it.
void SphereEstimator::glance(const V3d& point, Workspace& w) const {
  w.guesses.resize(w.samples.size(), Rgb(0, 0, 0));
  for (size_t k = 0; k < w.rest.size(); ++k) {
    const size_t i = w.rest[k];
    const DirectionSample& s = w.samples[i];
    w.guesses[i] = w.local->from(w.places[k]);
    w.excess.add(s.direction, w.guesses[i] * -s.solidAngle);
  }
  const double solidAngle = 4 * kPi / static_cast<double>(w.glances.size());
  for (const V3d& direction : w.glances)
    w.excess.add(direction, w.local->along(point, direction) * solidAngle);
}

void SphereEstimator::addVariances(size_t firstBase, Workspace& w) const {
  // What is left to the directions; of the rest only what glances, being more, do not tell.
  w.unguessed.assign(w.samples.begin() + static_cast<ptrdiff_t>(firstBase), w.samples.end());
  if (guess_) {
    w.guessed = w.unguessed;
    for (size_t i = 0; i < w.guessed.size(); ++i) {
      w.guessed[i].value = w.guesses[firstBase + i];
      w.unguessed[i].value -= w.guesses[firstBase + i];
    }
    const double even =
        std::pow(static_cast<double>(w.glances.size()) / static_cast<double>(w.directions.size()), -1.5);
    w.variance +=
        baseVariance(std::span(w.guessed).first(w.directions.size()), neighbours_, w.counted) * even;
  }
  const std::span<const DirectionSample> samples(w.unguessed);
  w.variance += baseVariance(samples.first(w.directions.size()), neighbours_, w.counted);
  w.runs.push_back(w.samples.size());
  for (size_t i = 1; i < w.runs.size(); ++i)
    w.variance += spreadVariance(samples.subspan(w.runs[i - 1] - firstBase, w.runs[i] - w.runs[i - 1]));
  for (size_t i = 0, next = 0; i < w.sources.size(); i = next) {
    while (next < w.sources.size() && w.sources[next].image == w.sources[i].image) ++next;
    w.variance += partsVariance(std::span(w.sources).subspan(i, next - i));
  }
}

RayAnswer directionAnswer(const Scene& scene, const DirectionSample& sample, const Ray& ray) {
  RayAnswer a = answerOf(scene, ray);
  a.direction = sample.direction;
  a.value = sample.value;
  a.solidAngle = sample.solidAngle;
  return a;
}

}  // namespace rsphere
