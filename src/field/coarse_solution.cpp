#include "field/coarse_solution.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rsphere {
namespace {

// What follows was chosen in two daylit rooms (a classroom of 10 x 7 m, a cell with a small window), each
// with sun and with an overcast sky, by the error of 40 sensors for the time:
// tests/bench/rtrace/runs/2026-11-22-coarse-solution.txt.

// The side of a patch in mean distances of what it sees, at -aa .1; it grows with the root of -aa, since the
// error of an interpolation grows with the square of the spacing. At 1.2 the errors are twice those at .6, at
// .4 the time.
constexpr double kSpacing = .6, kSpacingAccuracy = .1, kCoarsestAccuracy = .4;

// The side of a patch is at most this share of the distance that it is seen from, and need not be smaller
// than the second share of it: ten rays of a gather of 1000 stand for a solid angle as wide. A third of it
// changes no error by more than a tenth, and makes a tenth more patches.
constexpr double kSeenFrom = .5, kFarPatch = .18;

// A place that is seen from nearer than this many patch sides is not served: the path is followed.
constexpr double kNear = .4;

// No patch is smaller than this share of its surface's extent: patches in a corner, where everything is near,
// would be without end.
constexpr double kLeastPatch = .1;

// Open surroundings count as this share of the scene's size.
constexpr double kOpen = .1;

// Where the ground is wide, rooms are small: the extent of a surface counts up to this share of the scene's
// size.
constexpr double kWidestExtent = .4;

// A surface smaller than this share of a patch's side has no patch of its own.
constexpr double kOwnPatch = .5;

constexpr int kFiner = 2;  // divisions more where a patch is hidden

// Rays of a patch for each that a gather is asked for (-ad and -as), and bounds: fewer than the first tell
// nothing, more than the second are more than other errors need.
constexpr double kRays = .08;
constexpr double kLeastRays = 32, kMostRays = 4096;

}  // namespace

void CoarseSolution::Links::addLight(int bounces, const Rgb& radiance) {
  if (light.size() <= static_cast<size_t>(bounces)) light.resize(bounces + 1, V3f(0, 0, 0));
  light[bounces] += V3f(radiance);
}

void CoarseSolution::Links::addEnd(int bounces, const Rgb& coefficient) {
  if (ends.size() <= static_cast<size_t>(bounces)) ends.resize(bounces + 1, V3f(0, 0, 0));
  ends[bounces] += V3f(coefficient);
}

struct CoarseSolution::Patch {
  bool usable = false;  // it has a site
  GatherSite site;
  double reach = 0;
  uint64_t seed = 0;
  std::atomic<const Links*> links{nullptr};
  struct Light {
    std::atomic<bool> known{false};
    std::array<std::atomic<float>, 3> mean{};
  };
  std::unique_ptr<Light[]> light;  // by bounces - 1

  ~Patch() { delete links.load(std::memory_order_relaxed); }
};

CoarseSolution::CoarseSolution(const Scene& scene, const Box3d& bounds, const FieldOptions& options)
    : scene_(scene),
      grid_(bounds),
      bounces_(std::max(options.bounces, 1)),
      ambient_(options.ambientValue),
      patches_(std::make_unique<InsertOnce<CellKey, Patch>>(18)) {
  spacing_ = kSpacing * std::sqrt(std::min(options.accuracy, kCoarsestAccuracy) / kSpacingAccuracy);
  rays_ = static_cast<int>(std::clamp(kRays * options.rays, kLeastRays, kMostRays));
}

CoarseSolution::~CoarseSolution() = default;

CoarseSolution::Patch& CoarseSolution::patchOf(const SurfaceChart& chart, const CellKey& key,
                                               Looker& looker) {
  return patches_->findOrAdd(key, [&] {
    auto patch = std::make_unique<Patch>();
    made_.fetch_add(1, std::memory_order_relaxed);
    patch->seed = key.hash();
    patch->light = std::make_unique<Patch::Light[]>(static_cast<size_t>(bounces_));
    if (const auto site = chart.site(grid_, key)) {
      patch->usable = true;
      patch->site = *site;
      patch->reach = looker.reach(*site);
    }
    return patch;
  });
}

CoarseSolution::Patch* CoarseSolution::find(const SurfacePlace& place, double u1, double u2, Looker& looker) {
  const auto chart = SurfaceChart::of(scene_, grid_, place);
  if (!chart) return nullptr;
  const double extent = chart->extent(), open = kOpen * grid_.size;
  const double least =
      std::max(kFarPatch * place.distance, kLeastPatch * std::min(extent, kWidestExtent * grid_.size));
  int level = grid_.levelOf(std::min(std::max(extent, least), open));
  // As fine as what surrounds the place asks for.
  for (;; ++level) {
    const double side = grid_.side(level);
    const Patch& patch = patchOf(*chart, chart->cellAt(grid_, level, chart->u(), chart->v()), looker);
    const double wanted = patch.usable ? spacing_ * std::min(patch.reach, open) : 0;
    if (side <= least || side <= wanted) {
      if (extent < kOwnPatch * std::max(wanted, kFarPatch * place.distance)) return nullptr;
      break;
    }
    if (level == CellGrid::kLevels) return nullptr;
  }
  if (place.distance < kNear * grid_.side(level)) return nullptr;
  level = std::max(level, std::min(grid_.levelOf(kSeenFrom * place.distance), grid_.levelOf(least)));
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
  for (int finer = 0; finer <= kFiner && level + finer <= CellGrid::kLevels; ++finer) {
    Patch& patch = patchOf(*chart, chart->cellAt(grid_, level + finer, chart->u(), chart->v()), looker);
    if (serves(patch)) return &patch;
  }
  return nullptr;
}

const CoarseSolution::Links& CoarseSolution::linksOf(Patch& patch, Looker& looker) {
  if (const Links* links = patch.links.load(std::memory_order_acquire)) return *links;
  auto made = std::make_unique<Links>();
  looker.link(patch.site, rays_, patch.seed, *made);
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
