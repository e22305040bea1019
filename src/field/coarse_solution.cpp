#include "field/coarse_solution.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "base/constants.h"
#include "base/even_sequence.h"
#include "base/random.h"
#include "field/hemisphere.h"
#include "field/tuning.h"

namespace rsphere {

using Imath::V2d;
using OfPatches = tuning::CoarseSolution;

namespace {

// Bounces whose light is computed. The light of all bounces is extrapolated from that of kComputed; so is
// that of a limit above kMostComputed.
constexpr int kComputed = 16, kMostComputed = 40;

// The light of b bounces lacks K^b e, where e is the light of all bounces, and K stands for one reflection by
// the whole room. A sum of the light of different bounces, whose weights w_b add up to 1, lacks P(K) e with
// P(z) = sum of w_b z^b. P is a Chebyshev polynomial that is small where K reflects up to kSlow of the light,
// of either sign, because light alternates between facing surfaces such as louvers. Source: Golub and Varga,
// "Chebyshev semi-iterative methods" (1961). A larger kSlow leaves less in white rooms, but amplifies the
// noise of links: behind louvers, sensors were up to 1.5% too bright with .75, and .1% with .6.
constexpr double kSlow = .6;

// What the sum lacks falls nearly geometrically with each kGroup bounces more. The ratio is bounded by that
// of a closed room that reflects 95%. Without this step, the end of a white corridor was 6% too dark; with it
// alone, the room beside a white light well was twice too bright: at deep places, early bounces bring little.
constexpr int kGroup = 4;
constexpr double kLargestRatio = .8;

// The weights w_b of that sum for the light of up to `bounces` bounces. They are 0 for odd b if `bounces` is
// even.
std::array<double, kComputed + 1> chebyshevWeights(int bounces) {
  std::array<double, kComputed + 1> before{1}, weights{0, 1 / kSlow};
  for (int degree = 1; degree < bounces; ++degree) {
    for (double& coefficient : before) coefficient = -coefficient;
    for (size_t i = 0; i < kComputed; ++i) before[i + 1] += 2 / kSlow * weights[i];
    std::swap(before, weights);
  }
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.);
  for (double& weight : weights) weight /= sum;
  return weights;
}

// The limit of a series of three sums.
double limitOf(double least, double fewer, double most) {
  const double more = most - fewer, ratio = more / (fewer - least);
  // Noise may let the sums grow; such a series cannot be continued.
  const double rest = ratio > 0 && ratio < 1 ? std::min(ratio, kLargestRatio) : 0;
  return std::max(0., most + more * rest / (1 - rest));
}

// Binary logarithms of the numbers of hash buckets; the tables take 2 and 4 MB. A picture of an office looks
// up 190,000 patches and 370,000 divisions. With 65,536 buckets, a third of the time was spent waiting for
// memory in long chains.
constexpr unsigned kLogPatchBuckets = 18, kLogDivisionBuckets = 19;

// Whether a site lies on a ball or a cone, and all surfaces around it are near compared with the radius.
bool isInNarrowShell(const Surroundings& seen, const SurfaceChart& chart) {
  return chart.isCurved() && seen.covered >= 1 && seen.rootMeanSquare < OfPatches::kEnclosed * chart.extent();
}

// Publishes an object that a thread has made, unless another thread was first. Returns whether it was kept.
template <class T>
bool publish(std::atomic<T*>& slot, std::unique_ptr<T> made) {
  T* first = nullptr;
  if (!slot.compare_exchange_strong(first, made.get(), std::memory_order_acq_rel)) return false;
  made.release();
  return true;
}

}  // namespace

// How a part of a surface is divided into patches.
struct CoarseSolution::Division {
  int level = 0;            // of the widest cells that are not wider than `side`, or the finest level
  double side = 0;          // largest side that the surroundings allow (world units)
  int finest = 0;           // level of the finest cells that rays from nearby use
  bool isEnclosed = false;  // whether hidden patches are not replaced by finer ones
};

namespace {

// Places all over a patch.
struct Sites {
  std::vector<PatchSite> all;
  V2f middle{.5, .5};  // their mean, relative to the sides of the patch
};

// Sets the middle and the weights of sites so that they give the linear function that fits their light best
// (least squares); without slopes if they lie nearly on a line. at: their places, relative to the sides of
// the patch.
void fitLinear(const std::vector<V2f>& at, Sites& sites) {
  if (at.empty()) return;
  const auto count = static_cast<float>(at.size());
  sites.middle = std::accumulate(at.begin(), at.end(), V2f(0, 0)) / count;
  V2f squares(0, 0);
  float product = 0;
  for (const V2f& place : at) {
    const V2f d = place - sites.middle;
    squares += d * d / count;
    product += d.x * d.y / count;
  }
  const float determinant = squares.x * squares.y - product * product;
  if (!(determinant > OfPatches::kLeastDeterminant)) return;
  for (size_t i = 0; i < at.size(); ++i) {
    const V2f d = at[i] - sites.middle;
    sites.all[i].weight = V2f(squares.y * d.x - product * d.y, squares.x * d.y - product * d.x) / determinant;
  }
}

}  // namespace

// The light of a patch in one solution.
struct Patch {
  uint64_t seed = 0;
  double rays = 0;                           // that it sends
  std::atomic<const Sites*> sites{nullptr};  // set by spread()
  std::atomic<const PatchLinks*> links{nullptr};
  struct Light {
    std::atomic<bool> known{false};
    std::array<std::array<std::atomic<float>, 3>, 3> color{};  // mean and slopes, by channel
    std::atomic<const Bands*> bands{nullptr};

    ~Light() { delete bands.load(std::memory_order_relaxed); }
    LinearColor load() const;
    void store(const LinearColor& from);
  };
  std::unique_ptr<Light[]> light;  // index: bounces - 1; after those that are computed, all

  ~Patch() {
    delete sites.load(std::memory_order_relaxed);
    delete links.load(std::memory_order_relaxed);
  }
};

// Where a patch lies; the same in all solutions.
struct CoarseSolution::Frame {
  bool usable = false;  // it has a gather site
  GatherSite site;
  double reach = 0;         // harmonic mean distance of its surroundings
  double share = 0;         // of the light on the room's other surfaces: tuning.h: kUsualShare
  bool isEnclosed = false;  // isInNarrowShell()
  uint64_t seed = 0;
  std::array<std::atomic<Patch*>, kMostSolutions> patches{};  // by solution; null before the first use

  ~Frame() {
    for (const auto& patch : patches) delete patch.load(std::memory_order_relaxed);
  }
};

LinearColor Patch::Light::load() const {
  LinearColor of;
  for (int c = 0; c < 3; ++c) {
    of.mean[c] = color[0][c].load(std::memory_order_relaxed);
    for (size_t k = 0; k < 2; ++k) of.slopes[k][c] = color[k + 1][c].load(std::memory_order_relaxed);
  }
  return of;
}

void Patch::Light::store(const LinearColor& from) {
  for (int c = 0; c < 3; ++c) {
    color[0][c].store(from.mean[c], std::memory_order_relaxed);
    for (size_t k = 0; k < 2; ++k) color[k + 1][c].store(from.slopes[k][c], std::memory_order_relaxed);
  }
}

CoarseSolution::CoarseSolution(const Scene& scene, const Box3d& bounds, const FieldOptions& options,
                               double room)
    : scene_(scene),
      grid_(bounds),
      room_(room),
      effort_(effortFor(options, room > 0)),
      rotation_(options.rotation),
      bounces_(options.bounces > kMostComputed ? kComputed : std::max(options.bounces, 1)),
      last_(options.bounces > kMostComputed ? kComputed + 1 : bounces_),
      coarserLinks_(std::max(options.coarserLinks,
                             room > 0 || options.patchesAtFirst ? 0 : OfPatches::kCoarserLinksByLamps)),
      hasBands_(options.spectral || !scene.contributors.empty()),
      ambient_(V3d(V3f(options.ambientValue.color.rgb()))),  // single precision, like all light stored here
      divisions_(std::make_unique<InsertOnce<CellKey, Division>>(kLogDivisionBuckets)),
      frames_(std::make_unique<InsertOnce<CellKey, Frame>>(kLogPatchBuckets)),
      enclosed_(std::make_unique<InsertOnce<CellKey, bool>>(kLogDivisionBuckets)) {}

CoarseSolution::~CoarseSolution() = default;

CoarseSolution::Effort CoarseSolution::effortFor(const FieldOptions& options, bool daylit) {
  const bool first = options.patchesAtFirst, several = options.solutions > 1;
  const double accuracy = std::max(options.accuracy / OfPatches::kUsualAccuracy, 1 / OfPatches::kMoreRays);
  Effort of{};
  of.spacing = OfPatches::kSpacing * std::min(accuracy, std::sqrt(accuracy));
  of.leastSide = OfPatches::kLeastPatch;
  of.farSide = first ? OfPatches::kFarPatchAtFirst : OfPatches::kFarPatch;
  of.nearSide = first ? OfPatches::kNearAtFirst : OfPatches::kNear;
  of.asked = options.rays / options.solutions;
  of.usual = OfPatches::kRays * of.asked * std::max(1., 1 / accuracy);
  of.more = OfPatches::kMoreRays;
  of.least = several ? OfPatches::kLeastRaysOfSolutions : OfPatches::kLeastRays;
  of.usualShare = first ? OfPatches::kUsualShareAtFirst : OfPatches::kUsualShare;
  of.forSlopes = of.forLinks = several ? OfPatches::kFewestOfSolutions : OfPatches::kFewestForSlopes;
  if (daylit) return of;
  const double coarser = OfPatches::kCoarserByLamps;
  const double fewer = first ? 1 : OfPatches::kFewerByLamps;
  for (double* const side : {&of.spacing, &of.leastSide, &of.farSide}) *side *= coarser;
  of.usual = fewer * OfPatches::kRays * of.asked;
  of.fewer = first ? 1 : 0;
  of.more = 1;
  of.least = (first ? coarser * coarser : several ? 1 : fewer) * OfPatches::kLeastRays;
  // Several solutions have few rays each. By noisy slopes of links, light can grow from bounce to bounce.
  // Gathers need slopes: without them, sensors below a cove are 6 to 8% too bright.
  of.forSlopes = 0;
  if (!several) of.forLinks = 0;
  return of;
}

CoarseSolution::Frame& CoarseSolution::frameOf(const SurfaceChart& chart, const CellKey& key,
                                               FieldRays& rays) {
  return frames_->findOrAdd(key, [&](Frame& frame) {
    made_.fetch_add(1, std::memory_order_relaxed);
    frame.seed = key.hash();
    if (const auto site = chart.site(grid_, key)) {
      frame.usable = true;
      frame.site = *site;
      const Surroundings seen = rays.surroundings(*site);
      frame.reach = seen.harmonicMean;
      frame.isEnclosed = isInNarrowShell(seen, chart);
      const double far = std::max(room_, seen.rootMeanSquare);
      frame.share =
          chart.stepU(grid_, key.level) * chart.stepV(grid_, key.level) * seen.covered / (far * far);
    }
  });
}

Patch& CoarseSolution::patchOf(Frame& frame, int solution) const {
  std::atomic<Patch*>& slot = frame.patches[static_cast<size_t>(solution)];
  if (Patch* patch = slot.load(std::memory_order_acquire)) return *patch;
  auto made = std::make_unique<Patch>();
  made->seed = solution == 0 ? frame.seed : mixBits(frame.seed ^ static_cast<uint64_t>(solution));
  made->rays = raysOf(frame);
  made->light = std::make_unique<Patch::Light[]>(static_cast<size_t>(last_));
  publish<Patch>(slot, std::move(made));
  return *slot.load(std::memory_order_acquire);
}

// The level of the smallest patches of a surface. leastSide: their side relative to the surface's extent.
int CoarseSolution::finestLevel(const SurfaceChart& chart, double leastSide) const {
  return grid_.levelOf(leastSide * std::min(chart.extent(), OfPatches::kWidestExtent * grid_.size));
}

// Whether an entire side of a surface lies in a narrow gap, as between nested shells. A surface that another
// object approaches only in places is not enclosed.
bool CoarseSolution::isEnclosed(const SurfaceChart& chart, FieldRays& rays) {
  return enclosed_->findOrAdd(chart.cell(grid_, 0, 0, 0), [&](bool& enclosed) {
    for (size_t i = 0; i < OfPatches::kEnclosedPlaces; ++i) {
      const auto site = chart.siteWithin(grid_, evenly(i, .5, .5));
      if (!site) continue;
      enclosed = isInNarrowShell(rays.surroundings(*site), chart);
      if (!enclosed) return;
    }
  });
}

// The widest patches that the surroundings of a place allow, regardless of the viewing distance. All places
// in a cell of the finest level get the result for the cell's middle.
const CoarseSolution::Division& CoarseSolution::divisionAt(const SurfaceChart& chart, int finest,
                                                           FieldRays& rays) {
  const double open = tuning::Fields::kOpen * grid_.size;
  const int finestEnclosed = std::min(finest, finestLevel(chart, OfPatches::kLeastPatchEnclosed));
  const CellKey key = chart.cellAt(grid_, finest, chart.u(), chart.v());
  return divisions_->findOrAdd(key, [&](Division& found) {
    const double u = (static_cast<double>(key.i) + .5) * chart.stepU(grid_, finest),
                 v = (static_cast<double>(key.j) + .5) * chart.stepV(grid_, finest);
    found.finest = finest;
    for (int level = std::min(grid_.levelOf(std::min(chart.extent(), open)), finest); level <= found.finest;
         ++level) {
      const Frame& frame = frameOf(chart, chart.cellAt(grid_, level, u, v), rays);
      found.level = level;
      found.side = frame.usable ? effort_.spacing * std::min(frame.reach, open) : 0;
      if (frame.isEnclosed && isEnclosed(chart, rays)) {
        found.isEnclosed = true;
        found.finest = std::max(level, finestEnclosed);
      }
      if (grid_.side(level) <= found.side) break;
    }
  });
}

// Chooses the sites of a patch: places on it that its first site sees, so that none lies below or behind an
// object on the surface.
void CoarseSolution::spread(Patch& patch, const Frame& frame, const SurfaceChart& chart, const CellKey& key,
                            FieldRays& rays) {
  if (patch.sites.load(std::memory_order_acquire)) return;
  auto sites = std::make_unique<Sites>();
  std::vector<V2f> at;
  const auto add = [&](const V2d& place) {
    const auto site = chart.siteIn(grid_, key, place);
    if (!site || !rays.sees(frame.site.point, site->point)) return;
    sites->all.emplace_back().site = *site;
    at.emplace_back(place);
  };
  Random random(mixBits(patch.seed ^ rotation_));
  // The patch is divided into squares, with one place in each. Places in opposite squares are symmetric about
  // the middle of the patch, so that their mean is exact where light varies linearly.
  const int across = patch.rays < OfPatches::kManyRays ? 2 : 4;
  for (int i = 0; i < across; ++i) {
    for (int j = 0; j < across / 2; ++j) {
      const V2d place = V2d(i + random.uniform(), j + random.uniform()) / across;
      add(place);
      add(V2d(1, 1) - place);
    }
  }
  if (sites->all.empty()) sites->all.emplace_back().site = frame.site;
  if (patch.rays >= effort_.forSlopes) fitLinear(at, *sites);
  publish<const Sites>(patch.sites, std::move(sites));
}

PatchPlace CoarseSolution::find(const SurfacePlace& place, FieldRays& rays, Asker asker, int solution) {
  auto chart = SurfaceChart::of(scene_, grid_, place);
  if (!chart) return {};
  const Division& division = divisionAt(*chart, finestLevel(*chart, effort_.leastSide), rays);
  const double suffices = effort_.farSide * place.distance;
  if (chart->extent() < OfPatches::kSidesForPaths * std::max(division.side, suffices)) return {};
  const int enough = grid_.levelOf(std::min(suffices, tuning::Fields::kOpen * grid_.size));
  int level = std::min(division.level, enough);
  if (place.distance < OfPatches::kSidesForPaths * grid_.side(level)) return {};
  level = std::max(
      level, std::min(grid_.levelOf(effort_.nearSide * place.distance), std::min(enough, division.finest)));
  if (asker == Asker::patch) level = std::max(0, level - coarserLinks_);
  // Light varies across closely spaced strips such as slats, because neighbouring strips hide a part of each.
  if (chart->shorterSide() < grid_.side(level) && division.side < chart->shorterSide())
    chart->divideAcross(OfPatches::kPartsAcross);
  const V3d above = place.point + grid_.lift * place.normal;
  const int most = std::min(level + tuning::Fields::kFinerWhereHidden,
                            division.isEnclosed ? std::max(level, division.finest) : CellGrid::kLevels);
  for (int tried = level; tried <= most; ++tried) {
    const CellKey key = chart->cellAt(grid_, tried, chart->u(), chart->v());
    Frame& frame = frameOf(*chart, key, rays);
    if (!frame.usable || !rays.sees(frame.site.point, above)) continue;
    // All rays of a gather that hit a patch share its noise. If they outnumber the rays of the patch,
    // following them is less noisy.
    const double sideU = chart->stepU(grid_, tried), sideV = chart->stepV(grid_, tried);
    const double hits = effort_.asked * sideU * sideV / (kPi * place.distance * place.distance);
    if (asker == Asker::path && hits > raysOf(frame)) return {};
    Patch& patch = patchOf(frame, solution);
    spread(patch, frame, *chart, key, rays);
    if (asker == Asker::patch && patch.rays < effort_.forLinks) return {&patch, V2f(0, 0)};
    const V2d at(chart->u() / sideU - static_cast<double>(key.i),
                 chart->v() / sideV - static_cast<double>(key.j));
    return {&patch, V2f(at) - patch.sites.load(std::memory_order_acquire)->middle};
  }
  return {};
}

// Patches that contribute more to the light of other surfaces get more rays, because their noise matters
// more.
double CoarseSolution::raysOf(const Frame& frame) const {
  const double part = std::clamp(frame.share / effort_.usualShare, effort_.fewer, effort_.more);
  return std::clamp(effort_.usual * part, effort_.least, OfPatches::kMostRays);
}

const PatchLinks& CoarseSolution::linksOf(Patch& patch, FieldRays& rays) {
  if (const PatchLinks* links = patch.links.load(std::memory_order_acquire)) return *links;
  const std::vector<PatchSite>& sites = patch.sites.load(std::memory_order_acquire)->all;
  const auto each =
      std::max(1, static_cast<int>(std::lround(patch.rays / static_cast<double>(sites.size()))));
  auto made =
      std::make_unique<const PatchLinks>(rays.link(sites, each * static_cast<int>(sites.size()), patch.seed));
  const auto sent = static_cast<size_t>(made->rays);
  if (publish<const PatchLinks>(patch.links, std::move(made))) {
    linked_.fetch_add(1, std::memory_order_relaxed);
    rays_.fetch_add(sent, std::memory_order_relaxed);
  }
  return *patch.links.load(std::memory_order_acquire);
}

Color CoarseSolution::light(const PatchPlace& place, int bounces, FieldRays& rays) {
  if (bounces <= 0) return ambient_;
  bounces = std::min(bounces, last_);
  Patch::Light& kept = place.patch->light[bounces - 1];
  if (!kept.known.load(std::memory_order_acquire)) {
    Color inBands;
    const LinearColor sum = bounces > bounces_ ? ofAllBounces(*place.patch, rays, inBands)
                                               : sumOf(linksOf(*place.patch, rays), bounces, rays, inBands);
    kept.store(sum);
    const Bands bands = bandsBeside(sum.mean, inBands);
    if (bands) publish<const Bands>(kept.bands, std::make_unique<const Bands>(bands));
    kept.known.store(true, std::memory_order_release);
  }
  const LinearColor light = kept.load();
  const V3f here = light.at(place.at);
  const Bands* bands = kept.bands.load(std::memory_order_relaxed);
  return bands ? Color(V3d(here), bandsBeside(here, Color(V3d(light.mean), *bands))) : Color(V3d(here));
}

// The light of a patch after all bounces. inBands: as below.
LinearColor CoarseSolution::ofAllBounces(Patch& patch, FieldRays& rays, Color& inBands) {
  static const std::array weights{chebyshevWeights(kComputed - 2 * kGroup),
                                  chebyshevWeights(kComputed - kGroup), chebyshevWeights(kComputed)};
  std::array<Color, weights.size()> sums;
  LinearColor all;
  for (size_t bounces = 0; bounces <= kComputed; bounces += 2) {
    const Color mean = light({&patch, V2f(0, 0)}, static_cast<int>(bounces), rays);
    for (size_t k = 0; k < sums.size(); ++k) sums[k].addScaled(mean, weights[k][bounces]);
    if (bounces > 0)
      all += patch.light[bounces - 1].load() * V3f(static_cast<float>(weights.back()[bounces]));
  }
  inBands = combined(sums[0], sums[1], sums[2], limitOf);
  all.mean = V3f(inBands.rgb());
  return all;
}

// The light of a patch from its links. inBands: receives the mean with bands, if anything has bands.
LinearColor CoarseSolution::sumOf(const PatchLinks& links, int bounces, FieldRays& rays, Color& inBands) {
  LinearColor sum;
  const auto last = static_cast<size_t>(bounces - 1);
  for (size_t i = 0; i < std::min(links.light.size(), last + 1); ++i) {
    sum += links.light[i];
    if (hasBands_) inBands += colorAt(links.light[i].mean, links.bandsOfLight, i);
  }
  if (last < links.ends.size()) {
    sum += links.ends[last] * V3f(ambient_.rgb());
    if (hasBands_) inBands += colorAt(links.ends[last].mean, links.bandsOfEnds, last) * ambient_;
  }
  for (size_t i = 0; i < links.links.size(); ++i) {
    const PatchLinks::Link& link = links.links[i];
    if (link.bounces >= bounces) continue;
    const Color arriving = light(link.to, bounces - 1 - link.bounces, rays);
    sum.add(link.coefficient * V3f(arriving.rgb()), link.weight);
    if (hasBands_) inBands += colorAt(link.coefficient, links.bandsOfLinks, i) * arriving;
  }
  return sum;
}

}  // namespace rsphere
