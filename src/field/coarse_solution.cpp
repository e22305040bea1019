#include "field/coarse_solution.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "field/tuning.h"

namespace rsphere {
namespace {

using Tuning = tuning::CoarseSolution;

// The -aa at which Tuning::kSpacing is the side of a patch, and Tuning::kRays its rays.
constexpr double kUsualAccuracy = .1;

// The binary logarithm of the buckets of each table: 512 kB.
constexpr unsigned kLogBuckets = 16;

}  // namespace

void CoarseSolution::Links::addLight(int bounces, const Radiance& radiance) {
  if (light.size() <= static_cast<size_t>(bounces)) light.resize(bounces + 1, V3f(0, 0, 0));
  light[bounces] += V3f(radiance.rgb);
}

void CoarseSolution::Links::addEnd(int bounces, const Coefficient& coefficient) {
  if (ends.size() <= static_cast<size_t>(bounces)) ends.resize(bounces + 1, V3f(0, 0, 0));
  ends[bounces] += V3f(coefficient.rgb);
}

// How a part of a surface is divided into patches.
struct CoarseSolution::Division {
  int level = 0;  // of the widest cells whose side is at most what their surroundings ask for, or the finest
  double side = 0;  // that the surroundings ask for (world units)
};

struct CoarseSolution::Patch {
  bool usable = false;  // it has a site
  GatherSite site;
  double reach = 0;
  double share = 0;  // in the light of the other surfaces of the room (Tuning::kUsualShare)
  uint64_t seed = 0;
  std::atomic<const Links*> links{nullptr};
  struct Light {
    std::atomic<bool> known{false};
    std::array<std::atomic<float>, 3> mean{};
  };
  std::unique_ptr<Light[]> light;  // by bounces - 1

  ~Patch() { delete links.load(std::memory_order_relaxed); }
};

CoarseSolution::CoarseSolution(const Scene& scene, const Box3d& bounds, const FieldOptions& options,
                               double room)
    : scene_(scene),
      grid_(bounds),
      room_(room),
      effort_(effortFor(options, room > 0)),
      bounces_(std::max(options.bounces, 1)),
      ambient_(options.ambientValue.rgb),
      divisions_(std::make_unique<InsertOnce<CellKey, Division>>(kLogBuckets)),
      patches_(std::make_unique<InsertOnce<CellKey, Patch>>(kLogBuckets)) {}

CoarseSolution::~CoarseSolution() = default;

CoarseSolution::Effort CoarseSolution::effortFor(const FieldOptions& options, bool daylit) {
  const double accuracy =
      std::clamp(options.accuracy, Tuning::kFinestAccuracy, Tuning::kCoarsestAccuracy) / kUsualAccuracy;
  const double finer = std::min(accuracy, std::sqrt(accuracy));
  if (!daylit)
    return {Tuning::kSpacingByLamps * finer,
            Tuning::kLeastPatchByLamps,
            Tuning::kFarPatchByLamps,
            Tuning::kRaysByLamps * options.rays,
            1,
            1,
            Tuning::kLeastRaysByLamps};
  return {Tuning::kSpacing * finer, Tuning::kLeastPatch,
          Tuning::kFarPatch,        Tuning::kRays * options.rays * std::max(1., 1 / accuracy),
          Tuning::kFewerRays,       Tuning::kMoreRays,
          Tuning::kLeastRays};
}

CoarseSolution::Patch& CoarseSolution::patchOf(const SurfaceChart& chart, const CellKey& key,
                                               Looker& looker) {
  return patches_->findOrAdd(key, [&](Patch& patch) {
    made_.fetch_add(1, std::memory_order_relaxed);
    patch.seed = key.hash();
    patch.light = std::make_unique<Patch::Light[]>(static_cast<size_t>(bounces_));
    if (const auto site = chart.site(grid_, key)) {
      patch.usable = true;
      patch.site = *site;
      const Surroundings seen = looker.surroundings(*site);
      patch.reach = seen.harmonicMean;
      const double far = std::max(room_, seen.rootMeanSquare);
      patch.share =
          chart.stepU(grid_, key.level) * chart.stepV(grid_, key.level) * seen.covered / (far * far);
    }
  });
}

// The level of the smallest patches of a surface.
int CoarseSolution::finestLevel(const SurfaceChart& chart) const {
  return grid_.levelOf(effort_.leastSide * std::min(chart.extent(), Tuning::kWidestExtent * grid_.size));
}

// The widest patches that the surroundings of a place allow, regardless of the distance that it is seen from. All
// places in a cell of the finest level have the answer for its middle.
const CoarseSolution::Division& CoarseSolution::divisionAt(const SurfaceChart& chart, int finest,
                                                           Looker& looker) {
  const double open = Tuning::kOpen * grid_.size;
  const CellKey key = chart.cellAt(grid_, finest, chart.u(), chart.v());
  return divisions_->findOrAdd(key, [&](Division& found) {
    const double u = (static_cast<double>(key.i) + .5) * chart.stepU(grid_, finest),
                 v = (static_cast<double>(key.j) + .5) * chart.stepV(grid_, finest);
    for (int level = std::min(grid_.levelOf(std::min(chart.extent(), open)), finest); level <= finest;
         ++level) {
      const Patch& patch = patchOf(chart, chart.cellAt(grid_, level, u, v), looker);
      found = {level, patch.usable ? effort_.spacing * std::min(patch.reach, open) : 0};
      if (grid_.side(level) <= found.side) break;
    }
  });
}

CoarseSolution::Patch* CoarseSolution::find(const SurfacePlace& place, double u1, double u2, Looker& looker) {
  auto chart = SurfaceChart::of(scene_, grid_, place);
  if (!chart) return nullptr;
  const int finest = finestLevel(*chart);
  const Division& division = divisionAt(*chart, finest, looker);
  const double suffices = effort_.farSide * place.distance;
  if (chart->extent() < Tuning::kOwnPatch * std::max(division.side, suffices)) return nullptr;
  const int enough = grid_.levelOf(std::min(suffices, Tuning::kOpen * grid_.size));
  int level = std::min(division.level, enough);
  if (place.distance < Tuning::kNear * grid_.side(level)) return nullptr;
  level =
      std::max(level, std::min(grid_.levelOf(Tuning::kSeenFrom * place.distance), std::min(enough, finest)));
  // Light changes across slats and other strips that are near to each other, and others hide a part of each.
  if (chart->shorterSide() < grid_.side(level) && division.side < chart->shorterSide())
    chart->divideAcross(Tuning::kPartsAcross);
  const V3d above = place.point + grid_.lift * place.normal;
  const auto serves = [&](const Patch& patch) {
    return patch.usable && looker.sees(patch.site.point, above);
  };
  {
    const double u = chart->u() + (u1 - .5) * chart->stepU(grid_, level),
                 v = chart->v() + (u2 - .5) * chart->stepV(grid_, level);
    Patch& patch = patchOf(*chart, chart->cellAt(grid_, level, u, v), looker);
    if (serves(patch)) return &patch;
  }
  for (int finer = 0; finer <= Tuning::kFiner && level + finer <= CellGrid::kLevels; ++finer) {
    Patch& patch = patchOf(*chart, chart->cellAt(grid_, level + finer, chart->u(), chart->v()), looker);
    if (serves(patch)) return &patch;
  }
  return nullptr;
}

const CoarseSolution::Links& CoarseSolution::linksOf(Patch& patch, Looker& looker) {
  if (const Links* links = patch.links.load(std::memory_order_acquire)) return *links;
  auto made = std::make_unique<Links>();
  // The rays go where their noise matters: a patch that is large where it is seen from matters most.
  const double part = std::clamp(patch.share / Tuning::kUsualShare, effort_.fewer, effort_.more);
  const double rays = std::clamp(effort_.usual * part, effort_.least, Tuning::kMostRays);
  looker.link(patch.site, static_cast<int>(rays), patch.seed, *made);
  const Links* first = nullptr;
  if (!patch.links.compare_exchange_strong(first, made.get(), std::memory_order_acq_rel)) return *first;
  return *made.release();
}

V3f CoarseSolution::light(Patch& patch, int bounces, Looker& looker) {
  if (bounces <= 0) return ambient_;
  bounces = std::min(bounces, bounces_);
  Patch::Light& kept = patch.light[bounces - 1];
  if (kept.known.load(std::memory_order_acquire))
    return {kept.mean[0].load(std::memory_order_relaxed), kept.mean[1].load(std::memory_order_relaxed),
            kept.mean[2].load(std::memory_order_relaxed)};
  const Links& links = linksOf(patch, looker);
  V3f sum(0, 0, 0);
  for (size_t i = 0; i < std::min<size_t>(links.light.size(), bounces); ++i) sum += links.light[i];
  if (static_cast<size_t>(bounces) <= links.ends.size()) sum += links.ends[bounces - 1] * ambient_;
  for (const Links::Link& link : links.links)
    if (link.bounces < bounces)
      sum += link.coefficient * light(*link.patch, bounces - 1 - link.bounces, looker);
  for (int c = 0; c < 3; ++c) kept.mean[c].store(sum[c], std::memory_order_relaxed);
  kept.known.store(true, std::memory_order_release);
  return sum;
}

}  // namespace rsphere
