#include "glances/diffuse_glances.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/constants.h"
#include "base/random.h"
#include "glances/tuning.h"
#include "light/surface_point.h"
#include "light_paths/tuning.h"
#include "shade/scattering.h"
#include "sphere/directions.h"

namespace rsphere {
namespace {

enum class GlanceStream : uint64_t { glances = 0x7001, joins, single };

Random randomOf(const SetAtPoint& set, GlanceStream stream, uint64_t number = 0) {
  return Random(mixBits(mixBits(set.seed() + static_cast<uint64_t>(stream)) + number));
}

size_t glancesFor(const SphereOptions& options) {
  const auto base = static_cast<size_t>(options.baseDirections);
  return std::min(tuning::DiffuseGlances::kPerDirection * base,
                  std::max(base, tuning::DiffuseGlances::kMost));
}

struct Outdoors {
  PathTracer& tracer;
  Radiance operator()(const V3d& origin, const V3d& direction, int bounces, Random& random) const {
    return tracer.outdoors(origin, direction, bounces, random.bits());
  }
};

size_t poolsFor(const SphereOptions& options) {
  return options.accuracy > 0 || options.glare.wanted ? tuning::DiffuseGlances::kPools : 1;
}

// The error due to light vertices is estimated from the differences between batches of light paths. Each
// batch has enough paths to know its mean within 3% if the standard deviation of a path equals the mean.
size_t pathsFor(const SphereOptions& options, bool daylit) {
  const double least = LightVertex::kBatches * static_cast<double>(tuning::DiffuseGlances::kLeastPaths);
  const double finer = options.accuracy > 0 ? SphereOptions::kUsualAccuracy / options.accuracy : 0;
  const double paths = std::max(least, (daylit ? tuning::DiffuseGlances::kDaylitPaths
                                               : tuning::DiffuseGlances::kPathsPerDirection) *
                                           options.baseDirections) *
                       std::max(1., finer * finer);
  return static_cast<size_t>(
      std::min(paths, static_cast<double>(tuning::DiffuseGlances::kMost / poolsFor(options))));
}

SharedError sharedError(const VertexLight::Record& record) {
  return {std::vector(record.batches.begin(), record.batches.end()),
          {record.squares, record.squaredBrightness}};
}

}  // namespace

// Chooses the light vertices that are connected to a point by joins. The probability of a vertex is
// proportional to an estimate of its unoccluded contribution, and at most 1. It is a function of position
// alone, so that multiple importance sampling can evaluate it where a glance hits.
class DiffuseGlances::Joins {
 public:
  Joins(const VertexLight& light, const V3d& point, double expected, double glances)
      : light_(light), vertices_(light.vertices()), point_(point), density_(glances / (4 * kPi)) {
    const double radius = tuning::LightVertices::kWidth * vertices_.nearLight().meanLength;
    radius2_ = radius * radius;
    const auto& visible = vertices_.visible().all();
    shown_.resize(visible.size());
    double sum = 0;
    vertices_.visible().from(point, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) {
        shown_[i] = static_cast<float>(shownBy(visible[i]));
        sum += shown_[i];
      }
    });
    factor_ = sum > 0 ? expected / sum : 0;
  }

  // The expected number of joins from each batch of light paths.
  std::array<double, LightVertex::kBatches> expected() const {
    std::array<double, LightVertex::kBatches> sums{};
    const auto& visible = vertices_.visible().all();
    for (size_t i = 0; i < shown_.size(); ++i)
      if (shown_[i] > 0) sums[visible[i].vertex.batch] += shareOf(shown_[i]);
    return sums;
  }

  double shareOf(double shown) const { return std::min(1., factor_ * shown); }
  // A surface point that a glance hits, with the densities of glances and joins there.
  VertexLight::Seen seen(const PlainPlace& at, const V3d& direction, double distance) const {
    const double cosine = -at.normal.dot(direction), square = distance * distance;
    return {direction, density_ * cosine / square, factor_ * cosine / (square + radius2_)};
  }

  // Calls each(vertex, share, direction, distance) for the chosen vertices; share: the vertex's probability.
  template <class Each>
  void draw(Random& random, const Each& each) const {
    double due = random.uniform();
    for (size_t i = 0; i < shown_.size(); ++i) {
      if (!(shown_[i] > 0)) continue;
      const double share = shareOf(shown_[i]);
      if ((due += share) < 1) continue;
      due -= 1;
      const VisibleVertex& v = vertices_.visible().all()[i];
      const V3d to = v.vertex.point() - point_;
      const double distance = to.length();
      each(v, share, to / distance, distance);
    }
  }

  // The contribution of a chosen vertex, or 0 if it faces away from the point or is hidden.
  Irradiance partOf(const VisibleVertex& v, double share, const V3d& direction, double distance) const {
    const double cosine = -direction.dot(v.vertex.normal()), square = distance * distance;
    if (!(cosine > 0)) return {};
    if (v.vertex.way != LightVertex::direct)
      return v.power * (diffuseShare(*v.material, cosine) * cosine / (kPi * square) *
                        v.joinedShare(vertices_.nearLight(), distance) / share);
    PlainPlace at;
    at.normal = v.vertex.normal();
    at.material = v.material;
    at.flat = v.flat;
    at.pattern = v.pattern;
    const double arriving = -v.direction.dot(at.normal);
    SourceSample sample;
    sample.direction = -v.direction;
    sample.source = v.source;
    const double others = vertices_.shadowRaysTo(v) + light_.lobesOver(at, direction, sample);
    const double weight = 1 / (density_ * cosine / square * others + share);
    return v.power * shownOfSource(at, direction, -v.direction, 1) * (cosine / square * weight / arriving);
  }

 private:
  double shownBy(const VisibleVertex& v) const {
    const V3d to = point_ - v.vertex.point();
    const double square = to.length2(), facing = to.dot(v.vertex.normal());
    if (!(facing > 0)) return 0;
    const double distance = std::sqrt(square);
    const double reflected =
        v.vertex.way == LightVertex::direct
            ? joinedReflectance(*v.material, v.vertex.normal(), -to / distance, -v.direction)
            : v.joinedShare(vertices_.nearLight(), distance) * v.vertex.power / vertices_.pathPower();
    return reflected * facing / distance / (square + radius2_);
  }

  const VertexLight& light_;
  const LightVertices& vertices_;
  V3d point_;
  double density_;  // of glances, per sr
  double radius2_ = 0, factor_ = 0;
  std::vector<float> shown_;  // of vertices_.visible().all()
};

std::unique_ptr<const DiffuseGlances> DiffuseGlances::make(const PreparedScene& prepared,
                                                           const SphereOptions& options,
                                                           const BaseSet& base) {
  PlainSurfaces surfaces(prepared);
  if (surfaces.obstacle()) return nullptr;
  return std::make_unique<const DiffuseGlances>(prepared, std::move(surfaces), options, base);
}

std::optional<PlainSurfaces> daylitSurfaces(const SphereTracing& tracing) {
  const PreparedScene& prepared = tracing.prepared;
  if (!tracing.aims.of<Openings>() || prepared.options().ambientAccuracy > 0) return {};
  const V3d size = prepared.tracer().bounds().size();
  Portals portals(*tracing.aims.of<Openings>(), std::max({size.x, size.y, size.z}),
                  tracing.prepared.scene().samePlace);
  if (portals.empty()) return {};
  PlainSurfaces surfaces(prepared, std::move(portals));
  if (surfaces.obstacle()) return {};
  return surfaces;
}

std::unique_ptr<const DiffuseGlances> DiffuseGlances::makeDaylit(const SphereTracing& tracing,
                                                                 const PlainSurfaces& surfaces,
                                                                 const SphereOptions& options,
                                                                 const BaseSet& base) {
  const PreparedScene& prepared = tracing.prepared;
  const Aims& aims = tracing.aims;
  return std::make_unique<const DiffuseGlances>(prepared, surfaces, options, base, [&prepared, aims] {
    static const Caches none;
    return PathTracer(prepared, none, aims);
  });
}

DiffuseGlances::DiffuseGlances(const PreparedScene& prepared, PlainSurfaces surfaces,
                               const SphereOptions& options, const BaseSet& base, LightPools::Tracers tracers)
    : prepared_(prepared),
      surfaces_(std::move(surfaces)),
      lights_(prepared, surfaces_, poolsFor(options), pathsFor(options, bool(tracers)),
              mixBits(options.rotation), tracers),
      glances_(rotatedDirections(baseDirections(glancesFor(options)), options.rotation)),
      kernels_(base.kernels),
      joins_(tuning::DiffuseGlances::kJoinsPerDirection * options.baseDirections) {
  if (!base.neighbours) return;
  VoronoiWorkspace workspace;
  cellSolidAngles(glances_, workspace);
  neighbours_ = neighboursOf(workspace);
}

DiffuseGlances::Found DiffuseGlances::at(const SetAtPoint& set, PathTracer& tracer) const {
  const std::shared_ptr<const VertexLight> own = light(set);
  const VertexLight& both = *own;
  const auto n = static_cast<double>(glances_.size());
  const Joins joins(both, set.point(), joins_, n);
  const SpectralSampling* const sampling = prepared_.options().sampling;
  VertexLight::Record record;  // of all joins and, where only the mean has an error, of all glances
  record.sampling = sampling;
  Found found(kernels_, set.gaze());
  addJoins(set, joins, record, found);

  Glancing glancing{both, randomOf(set, GlanceStream::glances), &joins, nullptr, 4 * kPi / n};
  const Outdoors beyond{tracer};
  const OutdoorRadiance outdoors(beyond);
  glancing.outdoors = &outdoors;
  const bool apart = neighbours_ && kernels_.count() > 0;
  std::vector<DirectionSample> seen;
  for (const V3d& direction : set.turned(glances_)) {
    VertexLight::Record own;
    own.sampling = sampling;
    if (neighbours_) glancing.record = apart ? &own : &record;
    const Radiance radiance = glance(set.point(), direction, glancing);
    if (maxChannel(radiance) > 0) ++found.lit;
    found.moments.add(direction, irradianceFrom(radiance, glancing.cell), sampling, glancing.cell);
    if (neighbours_) seen.push_back({direction, glancing.cell, radiance});
    if (!apart) continue;
    const SharedError error = sharedError(own);
    found.shared.add(error, 1);
    kernels_.weigh(direction, [&](size_t i, double weight) { found.sharedByKernel[i].add(error, weight); });
  }
  if (!neighbours_) return found;
  found.variance += evenVariance(seen, *neighbours_, sampling, &found.ofKernels);
  found.ofKernels.addQuantities([&](size_t quantity) {
    return evenVariance(weighted(seen, kernels_, quantity), *neighbours_, sampling);
  });
  found.shared.add(sharedError(record), 1);
  return found;
}

void DiffuseGlances::addJoins(const SetAtPoint& set, const Joins& joins, VertexLight::Record& record,
                              Found& found) const {
  std::optional<Irradiance> last;
  std::vector<Joined> all;
  Random random = randomOf(set, GlanceStream::joins);
  const SpectralSampling* const sampling = prepared_.options().sampling;
  joins.draw(random, [&](const VisibleVertex& v, double share, const V3d& direction, double distance) {
    const Coefficient passed = surfaces_.passing(set.point(), v.vertex.point(), kInSpace);
    const Irradiance part = joins.partOf(v, share, direction, distance) * passed;
    found.moments.add(direction, part, sampling);
    if (!neighbours_) return;
    record.add(v.vertex.batch, part, 1 - share);
    all.push_back({direction, part, v.vertex.batch, 1 - share});
    // Successive vertices are close together, so that the difference of their contributions estimates the
    // variance due to choosing vertices at random.
    if (last) {
      const Variance variance = Variance::of(part - *last, sampling) * (.5 * (1 - share));
      found.variance += variance;
      found.ofKernels.add(direction, variance);
    }
    last = part;
  });
  if (!neighbours_) return;
  found.shared = evened(joins, all);
  found.sharedByKernel = sharedByKernel(joins, all);
}

std::vector<SharedError> DiffuseGlances::sharedByKernel(const Joins& joins,
                                                        std::span<const Joined> all) const {
  VertexLight::Record none;
  none.sampling = prepared_.options().sampling;
  std::vector<VertexLight::Record> records(kernels_.count(), none);
  const size_t zones = kernels_.zoneCount();
  std::vector<Joined> dark(all.begin(), all.end());
  for (Joined& one : dark) one.part = Irradiance();
  std::vector<std::vector<Joined>> ofQuantities(kernels_.quantities.any() ? size_t{Kernels::kQuantities} : 0);
  for (size_t i = 0; i < ofQuantities.size(); ++i)
    if (kernels_.quantities[i]) ofQuantities[i] = dark;
  for (size_t i = 0; i < all.size(); ++i)
    kernels_.weigh(all[i].direction, [&](size_t kernel, double weight) {
      const Irradiance part = all[i].part * weight;
      records[kernel].add(all[i].batch, part, all[i].notChosen);
      if (kernel >= zones) ofQuantities[kernel - zones][i].part = part;
    });
  std::vector<SharedError> errors;
  for (size_t i = 0; i < records.size(); ++i) {
    errors.push_back(sharedError(records[i]));
    if (i >= zones) errors[i].add(evened(joins, ofQuantities[i - zones]), 1);
  }
  return errors;
}

// Corrects the shared error of all joins to the error with the expected number of joins in each batch. The
// number in a batch is random, although the total number is not. Because joins contribute nearly equal
// amounts, the random numbers would hide how the batches differ.
SharedError DiffuseGlances::evened(const Joins& joins, std::span<const Joined> all) const {
  if (all.empty()) return {};
  const SpectralSampling* const sampling = prepared_.options().sampling;
  std::array<double, LightVertex::kBatches> more{};
  Irradiance sum;
  for (const Joined& one : all) {
    sum += one.part;
    ++more[one.batch];
  }
  const Irradiance mean = sum / static_cast<double>(all.size());
  const auto expected = joins.expected();
  SharedError change{std::vector<Irradiance>(more.size()), {}};
  for (size_t b = 0; b < more.size(); ++b) change.batches[b] = mean * (expected[b] - more[b]);
  for (const Joined& one : all) {
    change.chosen += Variance::of(one.part - mean, sampling) * one.notChosen;
    change.chosen += Variance::of(one.part, sampling) * -one.notChosen;
  }
  return change;
}

Radiance DiffuseGlances::glance(const V3d& point, const V3d& direction, Glancing& by) const {
  const Sight sight = surfaces_.look(point, direction, kFarAway, kInSpace);
  const PlainPlace at = surfaces_.placeOf(point, direction, sight, by.scratch.functions);
  if (!at.material) return {};
  const Coefficient color(sight.passed.color * at.color() *
                          diffuseShare(*at.material, -at.normal.dot(direction)));
  const VertexLight::Seen seen =
      by.joins ? by.joins->seen(at, direction, sight.distance) : VertexLight::Seen{direction};
  Radiance radiance = sight.passed * by.both.directOf(at, seen, by.random, by.scratch);
  if (isBlack(color)) return radiance;
  const VertexLight::Indirect how{prepared_.options().ambientBounces, by.joins ? sight.distance : 0,
                                  by.record, color * by.cell, by.outdoors};
  return radiance + color * by.both.indirectAt(at, how, by.random, by.scratch);
}

bool suitsDaylight(const V3d& point, const PlainSurfaces& surfaces, int bounces) {
  Random random(seedOf(std::array{point.x, point.y, point.z}));
  FunctionScratch scratch;
  size_t past = 0;
  for (size_t i = 0; i < tuning::DiffuseGlances::kWalks; ++i) {
    V3d origin = point, direction = uniformDirection(random);
    SurfaceId start;
    for (int hits = 0; hits <= bounces; ++hits) {
      const Sight sight = surfaces.look(origin, direction, kFarAway, start);
      if (sight.leaves) break;
      const PlainPlace at = surfaces.placeOf(origin, direction, sight, scratch);
      // Black smooth metal acts like a mirror without virtual sources: it shows the light of portals.
      past += !at.material && !(sight.hit.surface != kNone && surfaces.finishOf(sight.hit.surface).mirror);
      if (!at.material || random.uniform() >= brightness(Radiance(at.color()))) break;
      origin = at.point;
      start = at.surface;
      const double u1 = random.uniform(), u2 = random.uniform();
      direction = diffuseDirection(at.normal, u1, u2);
    }
  }
  return static_cast<double>(past) <=
         tuning::DiffuseGlances::kMostPast * static_cast<double>(tuning::DiffuseGlances::kWalks);
}

Radiance DiffuseGlances::along(const SetAtPoint& set, const V3d& direction, size_t number,
                               PathTracer& tracer) const {
  const std::shared_ptr<const VertexLight> own = light(set);
  Glancing alone{*own, randomOf(set, GlanceStream::single, number)};
  const Outdoors beyond{tracer};
  const OutdoorRadiance outdoors(beyond);
  alone.outdoors = &outdoors;
  return glance(set.point(), direction, alone);
}

}  // namespace rsphere
