#include "field/irradiance_field.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <mutex>
#include <optional>

#include "base/band_scheme.h"
#include "base/constants.h"
#include "field/insert_once.h"
#include "field/site_interpolation.h"
#include "field/stored_sites.h"
#include "field/tuning.h"

namespace rsphere {
namespace {

// Substitute for -ar if it is 0 (no limit). Cells of this resolution resolve crumbs on a table: .15 mm in a
// room of 10 m, at -aa .15.
constexpr int kUnlimited = 65536;

// On curved surfaces, the visibility between two points is tested above them, at a height of this constant
// times their distance times the angle (rad) between their normals. An arc rises above its chord by 1/8 of
// that product; the constant has a margin.
constexpr double kBulge = .15;

// Approximate memory overhead of an allocation and of a table entry (bytes).
constexpr size_t kBlock = 16, kNode = 96;

constexpr size_t kNoBound = SIZE_MAX;

// On small surfaces that share the cells of their plane, finer cells are tried unless the weights of the
// sites that see the place add up to this: a room may be smaller than a cell, and a site may lie on none of
// the surfaces. The value is 1 minus a margin for rounding.
constexpr double kAllServed = 1 - 1e-9;

// Weight of a level of cells in an answer: 1 if roughness is below 1, and 0 above kNoneAbove.
double shareOf(double roughness) {
  return std::clamp(
      (tuning::IrradianceField::kNoneAbove - roughness) / (tuning::IrradianceField::kNoneAbove - 1), 0., 1.);
}

// The gather site of a cell, and its light after it has been gathered.
struct Site {
  CellKey key;
  bool usable = false;
  GatherSite at;
  double reach = 0;              // harmonic mean distance of its surroundings
  double finest = 0;             // finest spacing that its surroundings require (world units)
  bool smallObjectNear = false;  // an object smaller than the cell, whose effect interpolation would miss
  std::atomic<const GatheredLight*> light{nullptr};
  std::atomic<bool> begun{false};  // a thread is gathering it or has gathered it

  ~Site() { delete light.load(std::memory_order_relaxed); }
};

// Bytes used by all memories of a field.
struct Use {
  std::atomic<size_t> bytes{0};     // allocated
  std::atomic<size_t> reserved{0};  // sum of the limits of the memories
};

}  // namespace

// The sites of a field. It is replaced when they fill its limit.
struct FieldMemory {
  const size_t limit;
  const std::shared_ptr<Use> use;
  std::atomic<size_t> bytes{0};
  InsertOnce<CellKey, Site> sites;

  FieldMemory(size_t most, std::shared_ptr<Use> by)
      : limit(most), use(std::move(by)), sites(logBuckets(most)) {
    use->reserved.fetch_add(limit, std::memory_order_relaxed);
    add(sizeof(void*) << logBuckets(most));
  }
  ~FieldMemory() {
    use->reserved.fetch_sub(limit, std::memory_order_relaxed);
    use->bytes.fetch_sub(bytes.load(std::memory_order_relaxed), std::memory_order_relaxed);
  }
  void add(size_t more) {
    bytes.fetch_add(more, std::memory_order_relaxed);
    use->bytes.fetch_add(more, std::memory_order_relaxed);
  }
  bool isFull() const { return bytes.load(std::memory_order_relaxed) > limit; }

  static unsigned logBuckets(size_t most) {
    return std::clamp<unsigned>(std::bit_width(most / sizeof(Site)), 4, 16);
  }
};

class IrradianceField::Cache {
 public:
  Cache(const Scene& scene, const Box3d& bounds, const FieldOptions& options)
      : scene_(scene),
        grid_(bounds),
        accuracy_(options.accuracy),
        finestShare_(std::min(accuracy_, .5) / (options.resolution > 0 ? options.resolution : kUnlimited)),
        bound_(options.memory > 0 ? static_cast<size_t>(options.memory * 1e6) : kNoBound) {}

  bool find(const SurfacePlace& place, FieldReader& reader, FieldRays& rays, GatheredLight& light) {
    auto chart = SurfaceChart::of(scene_, grid_, place);
    if (!chart) return false;
    enter(reader);
    const Asked asked{*reader, rays};
    if (!hasOwnCells(*chart, asked)) {
      if (chart->isCurved()) return false;
      chart = SurfaceChart::ofPlane(grid_, place);
    }
    const double tolerance = accuracy_ / tuning::IrradianceField::kAllowed;
    light = {};
    double missing = 1, allowed = 1;
    int beyond = 0;
    double gap = 0;
    for (int level = firstLevel(*chart, place, asked, gap); beyond <= tuning::Fields::kFinerWhereHidden;
         ++level, allowed *= tuning::IrradianceField::kNoneAbove) {
      const bool finest =
          grid_.side(level) <= tuning::IrradianceField::kFinestInGap * gap && isFinest(*chart, level, asked);
      beyond += finest;
      SitesAround around;
      if (!look(*chart, place, level, asked, around)) continue;
      double extrapolationError = 0;
      const GatheredLight here = around.at(place.point, extrapolationError);
      const double roughness =
          std::max(around.roughness(tolerance), extrapolationError / tolerance) / allowed;
      const double share = finest ? 1 : shareOf(roughness);
      blend(light, here, static_cast<float>(missing * share));
      missing *= 1 - share;
      if (missing <= 0) return true;
    }
    if (missing >= 1) return false;
    const GatheredLight found = light;
    light = {};
    blend(light, found, static_cast<float>(1 / (1 - missing)));
    return true;
  }

  void keepIn(std::unique_ptr<AmbientFile> file) { stored_.emplace(std::move(file)); }
  bool isBounded() const { return bound_ != kNoBound; }
  size_t sitesMade() const { return made_.load(std::memory_order_relaxed); }
  size_t bytes() const { return use_->bytes.load(std::memory_order_relaxed); }

 private:
  // A query searches the memory, and traces rays where it lacks a site.
  struct Asked {
    FieldMemory& memory;
    FieldRays& rays;
  };

  // Starts a thread's query in the newest memory. Replaces that memory if it is full.
  void enter(FieldReader& memory) {
    if (memory && memory.get() == newest_.load(std::memory_order_relaxed) && !memory->isFull()) return;
    const std::shared_ptr<FieldMemory> left = std::move(memory);
    std::shared_ptr<FieldMemory> full;  // freed outside the lock
    const std::lock_guard lock(replacing_);
    if (!kept_ || kept_->isFull()) {
      full = std::move(kept_);
      // Half of the bound, since other threads may still read the previous memory; less if several old
      // memories have not been freed.
      const size_t reserved = use_->reserved.load(std::memory_order_relaxed);
      const size_t limit =
          bound_ == kNoBound ? kNoBound : std::min(bound_ / 2, bound_ - std::min(bound_, reserved));
      kept_ = std::make_shared<FieldMemory>(limit, use_);
      newest_.store(kept_.get(), std::memory_order_relaxed);
    }
    memory = kept_;
  }

  Site& siteOf(const SurfaceChart& chart, const CellKey& key, const Asked& asked) {
    return asked.memory.sites.findOrAdd(key, [&](Site& made) {
      made.key = key;
      if (const auto at = chart.site(grid_, key)) {
        made.usable = true;
        made.at = *at;
        const Surroundings seen = asked.rays.surroundings(*at);
        made.reach = seen.harmonicMean;
        made.finest =
            finestShare_ * std::min(grid_.size, tuning::IrradianceField::kRoom * seen.rootMeanSquare);
        made.smallObjectNear = grid_.side(key.level) > made.finest &&
                               asked.rays.smallObjectNear(*at, grid_.side(key.level), grid_.lift);
      }
      asked.memory.add(sizeof(Site) + kNode);
      made_.fetch_add(1, std::memory_order_relaxed);
    });
  }

  const GatheredLight& lightOf(Site& site, const Asked& asked) {
    if (const GatheredLight* light = site.light.load(std::memory_order_acquire)) return *light;
    site.begun.store(true, std::memory_order_relaxed);
    const GatheredLight* const known = stored_ ? stored_->find(site.key) : nullptr;
    auto gathered = std::make_unique<GatheredLight>(
        known ? *known
              : asked.rays.gather(site.at, std::min(site.finest / 2, site.reach / 4), site.key.hash()));
    const GatheredLight* first = nullptr;
    if (!site.light.compare_exchange_strong(first, gathered.get(), std::memory_order_acq_rel)) return *first;
    const GatheredLight& light = *gathered.release();
    const size_t bands = light.bands ? light.bands.scheme().count() * sizeof(double) : 0;
    asked.memory.add(sizeof(GatheredLight) + bands + kBlock);
    if (stored_ && !known) stored_->add(site.key, light);
    return light;
  }

  // Finds the sites of a level that see the place, and their light. False if there are none or, on a chart
  // that several surfaces share, too few.
  bool look(const SurfaceChart& chart, const SurfacePlace& place, int level, const Asked& asked,
            SitesAround& around) {
    // Coordinates in cells, relative to the middle of a cell.
    const double a = chart.u() / chart.stepU(grid_, level) - .5,
                 b = chart.v() / chart.stepV(grid_, level) - .5;
    const auto i = static_cast<int64_t>(std::floor(a)), j = static_cast<int64_t>(std::floor(b));
    const double across = a - std::floor(a), along = b - std::floor(b);
    around = {};
    std::array<Site*, 4> sites;
    for (int c = 0; c < 4; ++c) {
      const double weight = ((c & 1) ? across : 1 - across) * ((c >> 1) ? along : 1 - along);
      if (!(weight > kNegligible)) continue;
      Site* const site = &siteOf(chart, chart.cell(grid_, level, i + (c & 1), j + (c >> 1)), asked);
      // At the edge of a surface, several of the four sites may be the same.
      int k = 0;
      while (k < around.count && sites[k] != site) ++k;
      if (k == around.count) {
        if (!site->usable) continue;
        const V3d way = place.point - site->at.point;
        // High enough that the surface's own curvature does not block the view.
        const double height =
            grid_.lift +
            (chart.isCurved() ? kBulge * way.length() * (place.normal - site->at.normal).length() : 0);
        if (!asked.rays.sees(site->at.point + (height - grid_.lift) * site->at.normal,
                             place.point + height * place.normal))
          continue;
        sites[around.count] = site;
        around.site[around.count] = &site->at;
        around.weight[around.count++] = 0;
      }
      around.weight[k] += weight;
      around.served += weight;
    }
    if (around.count == 0 || (chart.isShared() && around.served < kAllServed)) return false;
    // Sites that another thread is gathering come last, since that thread may finish in the meantime.
    for (int k = 0; k < around.count; ++k) {
      Site& site = *sites[k];
      const bool busy =
          site.begun.load(std::memory_order_relaxed) && !site.light.load(std::memory_order_relaxed);
      around.light[k] = busy ? nullptr : &lightOf(site, asked);
    }
    for (int k = 0; k < around.count; ++k)
      if (!around.light[k]) around.light[k] = &lightOf(*sites[k], asked);
    return true;
  }

  // Whether a surface is large enough for separate cells.
  bool hasOwnCells(const SurfaceChart& chart, const Asked& asked) {
    if (chart.extent() >= finestShare_ * grid_.size) return true;
    const Site& site =
        siteOf(chart, chart.cellAt(grid_, grid_.levelOf(chart.extent()), chart.u(), chart.v()), asked);
    return site.usable && chart.extent() >= site.finest;
  }

  // The widest cells at this level or finer that the surroundings of their sites allow. Returns their level.
  int levelFrom(int level, const SurfaceChart& chart, const Asked& asked) {
    for (; !isFinest(chart, level, asked); ++level) {
      const Site& site = siteOf(chart, chart.cellAt(grid_, level, chart.u(), chart.v()), asked);
      if (site.usable && !site.smallObjectNear &&
          grid_.side(level) <= tuning::IrradianceField::kRoom * accuracy_ * site.reach)
        break;
    }
    return level;
  }

  // The level of the widest cells that the surroundings of the place allow. gap: set to the height of the gap
  // that contains the place, because sites of wide cells may lie outside of the gap.
  int firstLevel(const SurfaceChart& chart, const SurfacePlace& place, const Asked& asked, double& gap) {
    const int level =
        levelFrom(grid_.levelOf(std::min(chart.extent(), tuning::Fields::kOpen * grid_.size)), chart, asked);
    gap = asked.rays.clearance({place.point + grid_.lift * place.normal, place.normal},
                               grid_.side(level) / tuning::IrradianceField::kFinestInGap);
    // If cells are wider than a gap is high, as below a narrow shelf, all their sites may lie outside of it.
    const int resolving = grid_.levelOf(gap);
    return resolving > level ? levelFrom(resolving, chart, asked) : level;
  }

  // Whether the cells of a level are as fine as the surroundings of the place require.
  bool isFinest(const SurfaceChart& chart, int level, const Asked& asked) {
    if (level >= CellGrid::kLevels) return true;
    const Site& site = siteOf(chart, chart.cellAt(grid_, level, chart.u(), chart.v()), asked);
    return grid_.side(level) <= (site.usable ? site.finest : finestShare_ * grid_.size);
  }

  const Scene& scene_;
  CellGrid grid_;
  double accuracy_;
  double finestShare_;  // finest spacing, relative to the size of the surrounding room
  size_t bound_;        // limit on the bytes of all memories
  std::shared_ptr<Use> use_ = std::make_shared<Use>();
  // The memory that new queries use.
  std::atomic<const FieldMemory*> newest_{nullptr};
  std::shared_ptr<FieldMemory> kept_;
  std::mutex replacing_;  // held only while a pointer is copied
  std::atomic<size_t> made_{0};
  std::optional<StoredSites> stored_;
};

IrradianceField::IrradianceField(const Scene& scene, const Box3d& bounds, const FieldOptions& options)
    : cache_(std::make_unique<Cache>(scene, bounds, options)) {}
IrradianceField::~IrradianceField() = default;

void IrradianceField::keepIn(std::unique_ptr<AmbientFile> file) { cache_->keepIn(std::move(file)); }
bool IrradianceField::find(const SurfacePlace& place, FieldReader& reader, FieldRays& rays,
                           GatheredLight& light) {
  return cache_->find(place, reader, rays, light);
}
void IrradianceField::leave(FieldReader& reader) const {
  if (cache_->isBounded()) reader = {};
}
size_t IrradianceField::sitesMade() const { return cache_->sitesMade(); }
size_t IrradianceField::bytes() const { return cache_->bytes(); }

}  // namespace rsphere
