#include "estimate/silhouette_weights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/even_sequence.h"
#include "estimate/tuning.h"
#include "glances/tuning.h"
#include "openings/tuning.h"
#include "silhouettes/source_variance.h"
#include "silhouettes/tuning.h"
#include "sphere/directions.h"
#include "targets/cells_in_targets.h"

namespace rsphere {
namespace {

using std::numbers::pi;

// Streams of random numbers in a set, named after their uses. They are separate, so that drawing more numbers
// in one leaves the others unchanged.
enum class Stream : uint64_t {
  imagesOfSources = 1,
  raysAround = 2,
  dynamicDirections = 3,
  firstRay = 16,  // of the first direction; the next directions have the numbers that follow
};

uint64_t seedOf(const SetAtPoint& set, Stream stream, uint64_t number = 0) {
  return mixBits(set.seed() + static_cast<uint64_t>(stream) + number);
}

// beside: number of directions that -Sx allows in addition to the base directions.
size_t raysToImages(size_t base, size_t beside, bool glances) {
  const size_t usual = std::max(base / tuning::SilhouetteWeights::kBaseDirectionsPerRayToImages,
                                static_cast<size_t>(tuning::SeenSources::kUsualRays));
  return glances ? std::max(usual, std::min(base, beside / 2)) : usual;
}

// Joins the directions to images of sources and the other directions into one set.
SampledSet joined(std::span<const SeenSources::Sample> toImages, const SampledSet& others, bool keepRays) {
  SampledSet all;
  all.samples.reserve(toImages.size() + others.samples.size());
  for (const SeenSources::Sample& s : toImages) {
    all.samples.push_back(s.direction);
    if (keepRays) all.rays.push_back(s.ray);
  }
  all.samples.insert(all.samples.end(), others.samples.begin(), others.samples.end());
  all.rays.insert(all.rays.end(), others.rays.begin(), others.rays.end());
  return all;
}

}  // namespace

SilhouetteWeights::SilhouetteWeights(const SphereTracing& tracing, const SphereOptions& options,
                                     const BaseSet& base, std::span<const SpecialObject> special,
                                     const SeenSources& sources, const DiffuseGlances* glances)
    : options_(options), base_(base), sources_(sources), glances_(glances) {
  if (!(options.densityFactor > 0)) return;
  targets_.emplace(tracing, special, sources, options.densityFactor);
}

SampledSet SilhouetteWeights::sample(const SetAtPoint& set, PathTracer& tracer, VoronoiWorkspace&) const {
  View view = viewFrom(set, tracer);
  PathRequest request;
  const std::shared_ptr<const VertexLight> light = glances_ ? glances_->light(set) : nullptr;
  request.vertexLight = light.get();
  const PathsFrom paths(tracer, set.point(), request);
  const std::vector<SeenSources::Sample> toImages =
      sources_.sample(paths, view.images, seedOf(set, Stream::imagesOfSources));
  const Plan plan = planFor(set, view, toImages);
  const SampledSet others = traced(set, view, plan, paths);

  SampledSet sampled = joined(toImages, others, options_.everyDirection);
  const auto othersOf = std::span(sampled.samples).subspan(toImages.size());
  sampled.excess = glancedBeside(view, others.samples);
  sampled.shared = std::move(view.glanced.shared);
  sampled.sharedByKernel = std::move(view.glanced.sharedByKernel);
  sampled.ofKernels = std::move(view.glanced.ofKernels);
  sampled.litGlances = view.glanced.lit;
  sampled.variance = view.glanced.variance;
  if (!base_.neighbours) return sampled;
  sampled.variance += varianceOf(othersOf, plan.runs, toImages, &sampled.ofKernels);
  sampled.ofKernels.addQuantities([&](size_t quantity) {
    auto images = toImages;
    for (SeenSources::Sample& image : images)
      image.direction.value *= base_.kernels.weight(quantity, image.direction.direction);
    return varianceOf(weighted(othersOf, base_.kernels, quantity), plan.runs, images, nullptr);
  });
  return sampled;
}

SilhouetteWeights::View SilhouetteWeights::viewFrom(const SetAtPoint& set, PathTracer& tracer) const {
  const size_t base = base_.directions.size(), most = static_cast<size_t>(options_.mostDirections);
  View view;
  view.glanced = DiffuseGlances::Found(base_.kernels, set.gaze());
  view.images =
      sources_.findImages(set.point(), raysToImages(base, most > base ? most - base : 0, glances_ != nullptr),
                          options_.densityFactor);
  if (glances_) {
    view.glanced = glances_->at(set, tracer);
    view.meanBrightness = tuning::DiffuseGlances::kLeft * brightness(view.glanced.moments.total) / (4 * pi);
  } else if (targets_) {
    view.meanBrightness = lookAround(set, tracer, view.images);
  }
  return view;
}

double SilhouetteWeights::lookAround(const SetAtPoint& set, PathTracer& tracer, const Images& images) const {
  const PathsFrom paths(tracer, set.point());
  Random random(mixBits(seedOf(set, Stream::raysAround)));
  double sum = 0;
  for (int i = 0; i < tuning::Caps::kProbes; ++i) {
    // Stratified in height: slices of the sphere with equal areas.
    const double z = 1 - 2 * (i + random.uniform()) / tuning::Caps::kProbes,
                 angle = 2 * pi * random.uniform();
    const double r = std::sqrt(std::max(0., 1 - z * z));
    const V3d direction(r * std::cos(angle), r * std::sin(angle), z);
    const TracedRay ray = paths.trace(direction, random.bits());
    if (!sources_.isOne(ray.shown, images)) sum += brightness(ray.value);
  }
  return sum / tuning::Caps::kProbes;
}

SilhouetteWeights::Plan SilhouetteWeights::planFor(const SetAtPoint& set, const View& view,
                                                   std::span<const SeenSources::Sample> toImages) const {
  Plan plan;
  const size_t base = base_.directions.size(), used = base + toImages.size();
  const size_t most = static_cast<size_t>(options_.mostDirections), left = most > used ? most - used : 0;
  if (targets_) plan.targets = targets_->at(set.point(), view.meanBrightness, base, left);
  plan.apart.resize(plan.targets.all().size() + 1);
  for (const SeenSources::Sample& s : toImages)
    plan.apart[plan.targets.regionAt(s.direction.direction).fitted] += s.direction.solidAngle;
  chooseDirections(set, plan);
  return plan;
}

void SilhouetteWeights::chooseDirections(const SetAtPoint& set, Plan& plan) const {
  plan.directions = set.turned(base_.directions);
  Random random(seedOf(set, Stream::dynamicDirections));
  // Accumulating the expected numbers of directions gives each target a whole number whose expected value is
  // exact.
  double due = random.uniform();
  for (const Target& target : plan.targets.all()) {
    due += target.expected;
    const double shift1 = random.uniform(), shift2 = random.uniform();
    if (target.continues)
      plan.runs.back().shift.reset();
    else
      plan.runs.push_back({plan.directions.size(), 0, Imath::V2d(shift1, shift2)});
    for (size_t i = 0; due >= 1; --due, ++i) {
      const Imath::V2d u = evenly(i, shift1, shift2);
      plan.directions.push_back(target.silhouette.sample(u.x, u.y));
    }
    plan.runs.back().end = plan.directions.size();
  }
}

SampledSet SilhouetteWeights::traced(const SetAtPoint& set, const View& view, const Plan& plan,
                                     const PathsFrom& paths) const {
  SampledSet sampled;
  std::vector<CellInTarget> cells;
  sampled.samples.reserve(plan.directions.size());
  cells.reserve(plan.directions.size());
  const double averageCell = 4 * pi / static_cast<double>(base_.directions.size());
  for (size_t i = 0; i < plan.directions.size(); ++i) {
    const V3d& direction = plan.directions[i];
    const Targets::Region region = plan.targets.regionAt(direction);
    const TracedRay ray = paths.trace(direction, seedOf(set, Stream::firstRay, i));
    const bool enters = !sources_.isOne(ray.shown, view.images);
    // The solid angle of each direction is the inverse of the density of directions around it.
    const double baseCell = i < base_.solidAngles.size() ? base_.solidAngles[i] : averageCell;
    cells.push_back({1 / (1 / baseCell + region.density), region.fitted, enters});
    DirectionSample sample;
    sample.direction = direction;
    sample.region = enters ? region.id : kNoRegion;
    if (enters) {
      // Glances find all light of plain diffuse surfaces. With -Sd, one along each direction estimates it.
      if (glances_ && options_.everyDirection)
        sample.glanced = glances_->along(set, direction, i + 1, paths.tracer());
      sample.value = ray.value + sample.glanced;
    }
    sampled.samples.push_back(sample);
    if (options_.everyDirection) sampled.rays.push_back(ray);
  }
  const std::vector<double> solidAngles = cellsInTargets(std::move(cells), plan.targets, plan.apart);
  for (size_t i = 0; i < solidAngles.size(); ++i) sampled.samples[i].solidAngle = solidAngles[i];
  return sampled;
}

Moments SilhouetteWeights::glancedBeside(const View& view, std::span<const DirectionSample> others) const {
  Moments moments = view.glanced.moments;
  if (!options_.everyDirection) return moments;
  for (const DirectionSample& s : others)
    moments.add(s.direction, irradianceFrom(s.glanced, -s.solidAngle), base_.sampling, s.solidAngle);
  return moments;
}

Variance SilhouetteWeights::varianceOf(std::span<const DirectionSample> others,
                                       std::span<const Plan::Run> runs,
                                       std::span<const SeenSources::Sample> toImages,
                                       KernelVariances* to) const {
  const auto base = others.first(base_.directions.size());
  Variance variance = evenVariance(base, *base_.neighbours, base_.sampling, to);
  for (const Plan::Run& r : runs) {
    const auto run = others.subspan(r.first, r.end - r.first);
    variance += run.size() == 1 ? loneVariance(run[0], base, base_.sampling, to)
                : r.shift       ? latticeVariance(run, *r.shift, base_.sampling, to)
                                : spreadVariance(run, base_.sampling, to);
  }
  variance += unseenVariance(others, base_.sampling, to);
  for (size_t i = 0, next = 0; i < toImages.size(); i = next) {
    while (next < toImages.size() && toImages[next].image == toImages[i].image) ++next;
    variance += partsVariance(toImages.subspan(i, next - i), base_.sampling, to);
  }
  variance += choiceVariance(toImages, base_.sampling, to);
  return variance;
}

}  // namespace rsphere
