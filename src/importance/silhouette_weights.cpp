#include "importance/silhouette_weights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "importance/cells_in_targets.h"
#include "importance/clamp.h"
#include "importance/tuning.h"
#include "scene/even_sequence.h"
#include "sphere/directions.h"
#include "transport/tuning.h"

namespace rsphere {
namespace {

using std::numbers::pi;
using Tuning = tuning::SilhouetteWeights;

// The streams of random numbers of a set, named after their uses. They are separate, so that a use that draws
// more numbers does not change the others.
enum class Stream : uint64_t {
  imagesOfSources = 1,
  surroundings = 2,
  dynamicDirections = 3,
  guess = 4,
  guide = 5,
  guidedGlances = 6,
  firstRay = 16,  // of the base and dynamic directions; those after it belong to the next rays
};

uint64_t seedOf(const SetAtPoint& set, Stream stream, uint64_t number = 0) {
  return mixBits(set.seed() + static_cast<uint64_t>(stream) + number);
}

double solidAngleOf(std::span<const SeenSources::Sample> samples) {
  double sum = 0;
  for (const SeenSources::Sample& s : samples) sum += s.direction.solidAngle;
  return sum;
}

// Light sources that are integrated separately, and the mirrors that show them, are not guessed.
ById<SurfaceId, bool> unguessedSurfaces(const SeenSources& sources) {
  ById<SurfaceId, bool> unguessed = sources.apart();
  for (const SurfaceId mirror : sources.mirrors()) unguessed[mirror] = true;
  return unguessed;
}

// beside: the directions that -Sx allows besides the base directions.
size_t raysToImages(size_t base, size_t beside, bool glances) {
  const size_t usual = std::max(base / Tuning::kBaseDirectionsPerRayToImages, Tuning::kLeastRaysToImages);
  return glances ? std::max(usual, std::min(tuning::DiffuseGlances::kRaysToImages * base, beside / 2))
                 : usual;
}

std::vector<V3d> glancesFor(const SphereOptions& options) {
  const auto count = static_cast<size_t>(options.baseDirections);
  const size_t glances =
      std::min(Tuning::kGlancesPerDirection * count, std::max(count, Tuning::kMostGlances));
  return rotatedDirections(baseDirections(glances), options.rotation);
}

}  // namespace

SilhouetteWeights::SilhouetteWeights(const SphereTracing& tracing, const SphereOptions& options,
                                     const BaseSet& base, std::span<const SpecialObject> special,
                                     const SeenSources& sources, const LightPatches* patches,
                                     const DiffuseGlances* glances)
    : options_(options), base_(base), sources_(sources), glances_(glances) {
  if (!(options.densityFactor > 0)) return;
  guidance_.emplace(Guidance{TargetChoice(tracing, special, sources, options.densityFactor),
                             RadianceGuess(tracing.prepared, unguessedSurfaces(sources)),
                             glances ? std::vector<V3d>() : glancesFor(options),
                             baseDirections(tuning::RadianceGuess::kFitGlances), std::nullopt,
                             tracing.prepared.tracer(), patches});
  if (!base.neighbours || glances) return;
  VoronoiWorkspace workspace;
  cellSolidAngles(guidance_->glances, workspace);
  guidance_->neighbours = neighboursOf(workspace);
}

SampledSet SilhouetteWeights::sample(const SetAtPoint& set, PathTracer& tracer, VoronoiWorkspace&) const {
  const size_t base = base_.directions.size(), most = static_cast<size_t>(options_.mostDirections);
  const Images images =
      sources_.findImages(set.point(), raysToImages(base, most > base ? most - base : 0, glances_ != nullptr),
                          options_.densityFactor);
  DiffuseGlances::Found found = glances_ ? glances_->at(set) : DiffuseGlances::Found{};
  Surroundings around;
  std::optional<LocalGuess> guess;
  if (glances_) {
    around.meanBrightness = tuning::DiffuseGlances::kLeft * brightness(found.moments.total) / (4 * pi);
  } else if (guidance_) {
    around = lookAround(set, images, PathsFrom(tracer, set.point()));
    guess = fitGuess(set, around);
  }
  const PathsFrom paths(tracer, set.point(), requestFor(set, guess));
  const std::vector<SeenSources::Sample> toImages =
      sources_.sample(paths, images, seedOf(set, Stream::imagesOfSources));
  const std::optional<DirectionGuide> guide =
      guidance_ && guidance_->patches
          ? std::optional(DirectionGuide(*guidance_->patches, guidance_->tracer, set.point()))
          : std::nullopt;
  const size_t used = base + toImages.size();
  size_t left = most > used ? most - used : 0;
  const size_t guided =
      guide ? std::min(left, static_cast<size_t>(Tuning::kGuided * static_cast<double>(base))) : 0;
  left -= guided;
  const Targets targets =
      guidance_ ? guidance_->targets.at(set.point(), around.meanBrightness, base, left) : Targets({});
  const double besideImages = std::max(0., 4 * pi - solidAngleOf(toImages));
  Others others = sampleOthers(set, images, targets, besideImages, guess ? &*guess : nullptr,
                               guided > 0 ? &*guide : nullptr, guided, paths);

  SampledSet sampled;
  if (guess) {
    const Excess excess = excessOfGlances(set, others, *guess, guided > 0 ? &*guide : nullptr);
    sampled.excess = excess.moments;
    sampled.variance = excess.variance;
  }
  if (glances_) addGlances(std::move(found), others, sampled);
  if (options_.clamp > 0) {
    Irradiance total = sampled.excess.total;
    for (const SeenSources::Sample& s : toImages)
      total += irradianceFrom(s.direction.value, s.direction.solidAngle);
    for (const DirectionSample& s : others.samples) total += irradianceFrom(s.value, s.solidAngle);
    sampled.clamped =
        clampContributions(others.samples, others.guesses, total, options_.clamp, base_.sampling);
  }
  if (base_.neighbours) sampled.variance += varianceOf(others, toImages);
  sampled.samples.reserve(toImages.size() + others.samples.size());
  for (const SeenSources::Sample& s : toImages) {
    sampled.samples.push_back(s.direction);
    if (options_.everyDirection) sampled.rays.push_back(s.ray);
    if (!others.guesses.empty()) sampled.guesses.emplace_back();
  }
  sampled.samples.insert(sampled.samples.end(), others.samples.begin(), others.samples.end());
  sampled.rays.insert(sampled.rays.end(), others.rays.begin(), others.rays.end());
  sampled.guesses.insert(sampled.guesses.end(), others.guesses.begin(), others.guesses.end());
  return sampled;
}

PathRequest SilhouetteWeights::requestFor(const SetAtPoint& set,
                                          const std::optional<LocalGuess>& guess) const {
  PathRequest request;
  if (guess) request.guess = &*guess;
  if (glances_) request.vertexLight = &glances_->light(set.number());
  return request;
}

// With -Sd, each sample has the light that a glance in its direction finds, which is a guess here: the mean
// follows from the many glances.
void SilhouetteWeights::addGlances(DiffuseGlances::Found found, const Others& others,
                                   SampledSet& sampled) const {
  sampled.excess = found.moments;
  for (size_t i = 0; i < others.guesses.size(); ++i)
    if (others.regions[i] != kNoRegion)
      sampled.excess.add(others.samples[i].direction,
                         irradianceFrom(others.guesses[i], -others.samples[i].solidAngle), base_.sampling);
  sampled.variance = found.variance;
  sampled.shared = std::move(found.shared);
  sampled.litGlances = found.lit;
}

SilhouetteWeights::Surroundings SilhouetteWeights::lookAround(const SetAtPoint& set, const Images& images,
                                                              const PathsFrom& paths) const {
  Surroundings around;
  Random random(mixBits(seedOf(set, Stream::surroundings)));
  for (int i = 0; i < Tuning::kRaysAround; ++i) {
    // Stratified in height: slices of the sphere with equal areas.
    const double z = 1 - 2 * (i + random.uniform()) / Tuning::kRaysAround, angle = 2 * pi * random.uniform();
    const double r = std::sqrt(std::max(0., 1 - z * z));
    const V3d direction(r * std::cos(angle), r * std::sin(angle), z);
    const TracedRay ray = paths.trace(direction, random.bits());
    if (sources_.isOne(ray.shown, images)) continue;
    const Hit& hit = ray.firstHit;
    around.traced.push_back({guidance_->guess.placeOf(set.point(), direction, hit), hit.surface, ray.value});
    around.meanBrightness += brightness(ray.value) / Tuning::kRaysAround;
  }
  return around;
}

LocalGuess SilhouetteWeights::fitGuess(const SetAtPoint& set, const Surroundings& around) const {
  const uint64_t seed = seedOf(set, Stream::guess);
  const std::vector<V3d> glances = rotatedDirections(guidance_->fitGlances, mixBits(seed));
  return guidance_->guess.fit(set.point(), glances, around.traced, mixBits(seed + 1));
}

SilhouetteWeights::Others SilhouetteWeights::sampleOthers(const SetAtPoint& set, const Images& images,
                                                          const Targets& targets, double solidAngle,
                                                          const LocalGuess* guess,
                                                          const DirectionGuide* guide, size_t guided,
                                                          const PathsFrom& paths) const {
  Others others;
  CellsInTargets cells;
  const auto guidedDensity = static_cast<double>(guided);
  // The solid angle of each is the inverse of the density of all directions around it.
  const auto send = [&](const V3d& d, double baseCell) {
    const Targets::Region region = targets.regionAt(d);
    const double cell = 1 / (1 / baseCell + region.density + (guide ? guidedDensity * guide->density(d) : 0));
    const TracedRay ray = paths.trace(d, seedOf(set, Stream::firstRay, others.samples.size()));
    const bool enters = !sources_.isOne(ray.shown, images);
    others.regions.push_back(enters ? region.id : kNoRegion);
    cells.add(cell, region, enters);
    others.samples.push_back({d, 0, enters ? ray.value : Radiance()});
    if (options_.everyDirection) others.rays.push_back(ray);
    if (glances_ && options_.everyDirection) {
      others.guesses.push_back(enters ? glances_->along(set, d, others.samples.size()) : Radiance());
      others.samples.back().value += others.guesses.back();
    }
    if (guess)
      others.guesses.push_back(enters ? guess->from(guidance_->guess.placeOf(set.point(), d, ray.firstHit))
                                      : Radiance());
  };
  const std::vector<V3d> base = set.turned(base_.directions);
  others.samples.reserve(base.size());
  for (size_t i = 0; i < base.size(); ++i) send(base[i], base_.solidAngles[i]);

  Random random(seedOf(set, Stream::dynamicDirections));
  const double averageCell = 4 * pi / static_cast<double>(base.size());
  // A running sum over all targets gives each a whole number of directions with the right average.
  double due = random.uniform();
  for (const Target& target : targets.all()) {
    due += target.expected;
    const double shift1 = random.uniform(), shift2 = random.uniform();
    if (!target.continues) others.runs.push_back(others.samples.size());
    for (size_t i = 0; due >= 1; --due, ++i) {
      const Imath::V2d u = evenly(i, shift1, shift2);
      send(target.silhouette.sample(u.x, u.y), averageCell);
    }
  }
  others.runs.push_back(others.samples.size());
  if (guide) {
    Random own(seedOf(set, Stream::guide));
    for (const V3d& d : guide->directions(guided, own)) send(d, averageCell);
  }
  cells.fit(targets);
  cells.scale(solidAngle);
  for (size_t i = 0; i < others.samples.size(); ++i) others.samples[i].solidAngle = cells.solidAngle(i);
  return others;
}

SilhouetteWeights::Excess SilhouetteWeights::excessOfGlances(const SetAtPoint& set, const Others& others,
                                                             const LocalGuess& guess,
                                                             const DirectionGuide* guide) const {
  Excess result;
  Moments& excess = result.moments;
  for (size_t i = 0; i < others.samples.size(); ++i)
    if (others.regions[i] != kNoRegion)
      excess.add(others.samples[i].direction,
                 irradianceFrom(others.guesses[i], -others.samples[i].solidAngle), base_.sampling);
  std::vector<DirectionSample> seen;
  const double even = static_cast<double>(guidance_->glances.size()) / (4 * pi);  // per sr
  const auto guided =
      guide ? static_cast<size_t>(Tuning::kGuided * static_cast<double>(guidance_->glances.size())) : 0;
  const auto look = [&](const V3d& direction) {
    const double density = even + (guide ? static_cast<double>(guided) * guide->density(direction) : 0);
    const Radiance radiance = guess.along(set.point(), direction);
    const Irradiance part = irradianceFrom(radiance, 1 / density);
    excess.add(direction, part, base_.sampling);
    if (guidance_->neighbours) seen.push_back({direction, 1 / density, radiance});
    return part;
  };
  for (const V3d& direction : set.turned(guidance_->glances)) look(direction);
  if (guidance_->neighbours)
    result.variance = evenVariance(seen, *guidance_->neighbours, {}, base_.sampling) * Tuning::kEvenGlances;
  if (!guide) return result;
  Random random(seedOf(set, Stream::guidedGlances));
  std::optional<Irradiance> last;
  for (const V3d& direction : guide->directions(guided, random)) {
    const Irradiance part = look(direction);
    if (last && guidance_->neighbours) result.variance += Variance::of(part - *last, base_.sampling) * .5;
    last = part;
  }
  return result;
}

Variance SilhouetteWeights::varianceOf(const Others& others,
                                       std::span<const SeenSources::Sample> toImages) const {
  const size_t base = base_.directions.size();
  Variance variance;
  std::vector<DirectionSample> unguessed = others.samples;
  for (size_t i = 0; i < others.guesses.size(); ++i) unguessed[i].value -= others.guesses[i];
  const std::span<const DirectionSample> samples(unguessed);
  variance += evenVariance(samples.first(base), *base_.neighbours, others.regions, base_.sampling);
  for (size_t i = 1; i < others.runs.size(); ++i) {
    const size_t first = others.runs[i - 1], count = others.runs[i] - first;
    variance += count == 1 ? loneVariance(samples[first], others.regions[first], samples.first(base),
                                          others.regions, base_.sampling)
                           : spreadVariance(samples.subspan(first, count), base_.sampling);
  }
  variance += unseenVariance(others.samples, others.regions, base_.sampling);
  // Successive directions of the guide are near to each other: their differences are errors.
  for (size_t i = others.runs.back() + 1; i < samples.size(); ++i)
    variance += Variance::of(irradianceFrom(samples[i].value, samples[i].solidAngle) -
                                 irradianceFrom(samples[i - 1].value, samples[i - 1].solidAngle),
                             base_.sampling) *
                .5;
  for (size_t i = 0, next = 0; i < toImages.size(); i = next) {
    while (next < toImages.size() && toImages[next].image == toImages[i].image) ++next;
    variance += partsVariance(toImages.subspan(i, next - i), base_.sampling);
  }
  variance += choiceVariance(toImages, base_.sampling);
  return variance;
}

}  // namespace rsphere
