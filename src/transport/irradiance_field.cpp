#include "transport/irradiance_field.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "scene/random.h"

namespace rsphere {
namespace {

// What the tables and the allocation add to what they hold (bytes, about).
constexpr size_t kBlock = 16, kNode = 96;

constexpr size_t kNoBound = SIZE_MAX;

// -ar 0 sets no limit. Cells as fine as this resolution see crumbs on a table.
constexpr int kUnlimited = 1 << 16;

constexpr size_t kBetweenSaves = 256;  // values that a process that is killed may lose

// The widest cells, in mean distances of what they see, for each unit of -aa; and in the size of the scene.
constexpr double kWidest = 3;
constexpr double kOpen = .1;

constexpr int kBeyondFinest = 2;  // divisions more where sites are hidden

// Sites differ where their light does by more than so many standard errors.
constexpr double kChance = .7;

// How much more error is allowed from level to level: the smaller the cells, the less of a picture they are.
constexpr double kMoreError = 1.6;

// Of the changes per length, what counts between sites: half of them meets a parabola.
constexpr float kSlopes = .5F;

// What a shift by changes per length may be off by, in what these and the distances to what is seen tell of
// it.
constexpr double kShiftError = 2;

// Where less of the sites around sees the place (by their weights), finer cells are asked.
constexpr double kLeastServed = .05;

// On small surfaces that share the cells of their plane, sites may lie beside all of them, and a room may be
// smaller than a cell: there nearly all must see the place.
constexpr double kLeastServedOfShared = .95;

float luminance(const V3f& color) { return static_cast<float>(brightness(Rgb(color.x, color.y, color.z))); }
V3f luminanceOf(const V3f (&change)[3]) {
  return static_cast<float>(kRedWeight) * change[0] + static_cast<float>(kGreenWeight) * change[1] +
         static_cast<float>(kBlueWeight) * change[2];
}

void blend(GatheredLight& into, const GatheredLight& light, float share) {
  into.mean += share * light.mean;
  into.tilted.add(light.tilted, share);
}

// The share of an answer that a level of cells gives: all below roughness 1, none above 1.5.
double shareOf(double roughness) { return std::clamp(3 - 2 * roughness, 0., 1.); }

}  // namespace

// A cell's site, and its light once that is gathered.
struct IrradianceField::Site {
  CellKey key;
  bool usable = false;
  GatherSite at;
  double reach = 0;
  bool smallObjectNear = false;  // an object that sites as wide apart would miss
  std::atomic<const GatheredLight*> light{nullptr};
  std::atomic<bool> begun{false};  // somebody gathers it, or has
  Site* nextFresh = nullptr;

  ~Site() { delete light.load(std::memory_order_relaxed); }
};

// Counts what it holds, and what it may.
struct FieldMemory {
  const size_t limit;
  const std::shared_ptr<IrradianceField::Use> use;
  std::atomic<size_t> bytes{0};
  InsertOnce<CellKey, IrradianceField::Site> sites;

  FieldMemory(size_t most, std::shared_ptr<IrradianceField::Use> by)
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
    return std::clamp<unsigned>(std::bit_width(most / sizeof(IrradianceField::Site)), 4, 16);
  }
};

// What a question goes by.
struct IrradianceField::Asked {
  FieldMemory& memory;
  SiteLooker& looker;
};

// The four sites around a place at one level, as far as they serve.
struct IrradianceField::Around {
  int count = 0;
  std::array<Site*, 4> site;
  std::array<const GatheredLight*, 4> light;
  std::array<double, 4> weight;
  double served = 0;  // the weights' sum; 1 where all serve

  // How rough the light is between the sites, in what is allowed; below 1 it is smooth enough. tolerance:
  // relative error. Three measures: how much the slopes change (a parabola), what is left of the steps when
  // the slopes are taken off (a shadow edge, which slopes do not show), and the steps themselves.
  double roughness(double tolerance) const {
    double level = 0, error = 0;
    for (int a = 0; a < count; ++a) level += luminance(light[a]->mean) / count;
    for (int a = 0; a < count; ++a)
      for (int b = a + 1; b < count; ++b) {
        const V3f way(site[b]->at.point - site[a]->at.point);
        const double before = luminanceOf(light[a]->perLength).dot(way);
        const double after = luminanceOf(light[b]->perLength).dot(way);
        const double step = luminance(light[b]->mean) - luminance(light[a]->mean);
        const double chance = kChance * std::hypot(light[a]->noise, light[b]->noise);
        const double slopeChance =
            kChance * std::hypot(light[a]->noisePerLength, light[b]->noisePerLength) * way.length();
        error = std::max({error, (std::abs(after - before) - slopeChance) / 8,
                          (std::abs(step - (before + after) / 2) - chance - slopeChance / 2) / 4,
                          (std::abs(step) - chance) / 6});
      }
    return level > 0 ? error / (tolerance * level) : 0;
  }

  // Interpolated, and shifted by the mean change per length where the sites that serve leave the place aside.
  // shift: the relative error to be expected of that.
  GatheredLight at(const V3d& place, double& shift) const {
    GatheredLight result;
    V3d middle(0, 0, 0);
    float inverseReach = 0;
    for (int a = 0; a < count; ++a) {
      const auto w = static_cast<float>(weight[a] / served);
      middle += site[a]->at.point * (weight[a] / served);
      inverseReach += w / light[a]->reach;
      for (int k = 0; k < 3; ++k) result.perLength[k] += light[a]->perLength[k] * w;
    }
    for (int a = 0; a < count; ++a) {
      const auto w = static_cast<float>(weight[a] / served);
      const V3f way(middle - site[a]->at.point);
      blend(result, *light[a], w);
      for (int k = 0; k < 3; ++k) {
        const float there = light[a]->mean[k];
        result.mean[k] += w * kSlopes * std::clamp(light[a]->perLength[k].dot(way), -there, there);
      }
    }
    const V3f aside(place - middle);
    const float level = luminance(result.mean);
    shift = 0;
    if (level > 0) {
      const double linear = std::abs(luminanceOf(result.perLength).dot(aside)) / level;
      shift = std::max(linear, 1.5 * static_cast<double>(aside.length2()) * inverseReach * inverseReach);
    }
    for (int k = 0; k < 3; ++k) {
      const float base = result.mean[k];
      result.mean[k] = std::clamp(base + result.perLength[k].dot(aside), .05f * base, 4 * base);
    }
    return result;
  }
};

IrradianceField::IrradianceField(const Scene& scene, const Box3d& bounds, const RayOptions& options)
    : scene_(scene),
      grid_(bounds),
      accuracy_(options.ambientAccuracy),
      // RADIANCE's own meaning of -ar.
      finest_(grid_.size * std::min(accuracy_, .5) /
              (options.ambientResolution > 0 ? options.ambientResolution : kUnlimited)),
      bound_(options.fieldMemory > 0 ? static_cast<size_t>(options.fieldMemory * 1e6) : kNoBound) {}

IrradianceField::~IrradianceField() { save(true); }

// Sees to it that a thread begins its question in the newest memory, and that this one is not full.
void IrradianceField::enter(FieldReader& memory) {
  if (memory && memory.get() == newest_.load(std::memory_order_relaxed) && !memory->isFull()) return;
  const std::shared_ptr<FieldMemory> left = std::move(memory);
  std::shared_ptr<FieldMemory> full;  // freed outside the lock
  const std::lock_guard lock(replacing_);
  if (!kept_ || kept_->isFull()) {
    full = std::move(kept_);
    // One that is asked and one that others are leaving; less where more than one is left.
    const size_t reserved = use_->reserved.load(std::memory_order_relaxed);
    const size_t limit =
        bound_ == kNoBound ? kNoBound : std::min(bound_ / 2, bound_ - std::min(bound_, reserved));
    kept_ = std::make_shared<FieldMemory>(limit, use_);
    newest_.store(kept_.get(), std::memory_order_relaxed);
  }
  memory = kept_;
}

namespace {

// Calls each(number) for all numbers of a light, in the order of the file.
template <class Light, class Each>
void forNumbers(Light& light, Each each) {
  const auto three = [&](auto& v) {
    for (int c = 0; c < 3; ++c) each(v[c]);
  };
  three(light.mean);
  three(light.tilted.all);
  for (int k = 0; k < 3; ++k) {
    three(light.perLength[k]);
    three(light.tilted.first[k]);
    three(light.tilted.squares[k]);
    three(light.tilted.products[k]);
  }
  each(light.noise);
  each(light.noisePerLength);
  each(light.reach);
}

}  // namespace

// The key, then the numbers of the light, as the machine has them.
AmbientFile::Record IrradianceField::recordOf(const CellKey& key, const GatheredLight& light) {
  std::array<float, 45> numbers;
  size_t n = 0;
  forNumbers(light, [&](const float& x) { numbers[n++] = x; });
  AmbientFile::Record record;
  static_assert(std::is_trivially_copyable_v<CellKey> && sizeof key + sizeof numbers == sizeof record);
  std::memcpy(record.data(), &key, sizeof key);
  std::memcpy(record.data() + sizeof key, &numbers, sizeof numbers);
  return record;
}

void IrradianceField::fromRecord(const AmbientFile::Record& record, CellKey& key, GatheredLight& light) {
  std::array<float, 45> numbers;
  std::memcpy(&key, record.data(), sizeof key);
  std::memcpy(&numbers, record.data() + sizeof key, sizeof numbers);
  size_t n = 0;
  forNumbers(light, [&](float& x) { x = numbers[n++]; });
}

void IrradianceField::keepIn(std::unique_ptr<AmbientFile> file) {
  file_ = std::move(file);
  if (!file_) return;
  for (const AmbientFile::Record& record : file_->take()) {
    CellKey key;
    GatheredLight light;
    fromRecord(record, key, light);
    known_.emplace(key, light);
  }
}

void IrradianceField::addFresh(Site* first, Site* last) {
  last->nextFresh = fresh_.load(std::memory_order_relaxed);
  while (!fresh_.compare_exchange_weak(last->nextFresh, first, std::memory_order_release,
                                       std::memory_order_relaxed)) {
  }
}

// Writes to the file what is new. wait: for other processes that write to it, too.
void IrradianceField::save(bool wait) {
  if (!file_) return;
  const std::unique_lock lock(writing_, std::try_to_lock);
  if (!lock.owns_lock()) return;
  Site* const first = fresh_.exchange(nullptr, std::memory_order_acquire);
  if (!first) return;
  std::vector<AmbientFile::Record> records;
  Site* last = first;
  for (Site* site = first; site; site = site->nextFresh) {
    records.push_back(recordOf(site->key, *site->light.load(std::memory_order_acquire)));
    last = site;
  }
  if (!file_->add(records, wait)) addFresh(first, last);
}

void IrradianceField::leave(FieldReader& reader) const {
  if (bound_ != kNoBound) reader = {};
}

IrradianceField::Site& IrradianceField::siteOf(const SurfaceChart& chart, const CellKey& key,
                                               const Asked& asked) {
  return asked.memory.sites.findOrAdd(key, [&] {
    auto made = std::make_unique<Site>();
    made->key = key;
    if (const auto at = chart.site(grid_, key)) {
      made->usable = true;
      made->at = *at;
      made->reach = asked.looker.reach(*at);
      made->smallObjectNear = grid_.side(key.level) > finest_ &&
                              asked.looker.smallObjectNear(*at, grid_.side(key.level), grid_.lift);
    }
    asked.memory.add(sizeof(Site) + kNode);
    made_.fetch_add(1, std::memory_order_relaxed);
    return made;
  });
}

const GatheredLight& IrradianceField::lightOf(Site& site, const Asked& asked) {
  if (const GatheredLight* light = site.light.load(std::memory_order_acquire)) return *light;
  site.begun.store(true, std::memory_order_relaxed);
  const auto known = known_.find(site.key);
  auto gathered = std::make_unique<GatheredLight>(
      known != known_.end() ? known->second : asked.looker.gather(site.at, site.key.hash()));
  const GatheredLight* first = nullptr;
  if (!site.light.compare_exchange_strong(first, gathered.get(), std::memory_order_acq_rel)) return *first;
  const GatheredLight& light = *gathered.release();
  asked.memory.add(sizeof(GatheredLight) + kBlock);
  const size_t count = gathered_.fetch_add(1, std::memory_order_relaxed) + 1;
  if (file_ && known == known_.end()) {
    addFresh(&site, &site);
    if (count % kBetweenSaves == 0) save(false);
  }
  return light;
}

// Fills in the sites of a level that see the place, and their light. False where too few do.
bool IrradianceField::look(const SurfaceChart& chart, const SurfacePlace& place, int level,
                           const Asked& asked, Around& around) {
  // In steps from the middles of the cells.
  const double a = chart.u() / chart.stepU(grid_, level) - .5, b = chart.v() / chart.stepV(grid_, level) - .5;
  const auto i = static_cast<int64_t>(std::floor(a)), j = static_cast<int64_t>(std::floor(b));
  const double across = a - std::floor(a), along = b - std::floor(b);
  around = {};
  for (int c = 0; c < 4; ++c) {
    const double weight = ((c & 1) ? across : 1 - across) * ((c >> 1) ? along : 1 - along);
    if (!(weight > 1e-6)) continue;
    Site* const site = &siteOf(chart, chart.cell(grid_, level, i + (c & 1), j + (c >> 1)), asked);
    // At the surface's edge neighbours are the same.
    int k = 0;
    while (k < around.count && around.site[k] != site) ++k;
    if (k == around.count) {
      if (!site->usable) continue;
      const V3d way = place.point - site->at.point;
      // Over the bulge of what is curved.
      const double height =
          grid_.lift +
          (chart.isCurved() ? .15 * way.length() * (place.normal - site->at.normal).length() : 0);
      if (!asked.looker.sees(site->at.point + (height - grid_.lift) * site->at.normal,
                             place.point + height * place.normal))
        continue;
      around.site[around.count] = site;
      around.weight[around.count++] = 0;
    }
    around.weight[k] += weight;
    around.served += weight;
  }
  if (around.served < (chart.isShared() ? kLeastServedOfShared : kLeastServed)) return false;
  // What another thread is at comes last: it may be there by then.
  for (int k = 0; k < around.count; ++k) {
    Site& site = *around.site[k];
    const bool busy =
        site.begun.load(std::memory_order_relaxed) && !site.light.load(std::memory_order_relaxed);
    around.light[k] = busy ? nullptr : &lightOf(site, asked);
  }
  for (int k = 0; k < around.count; ++k)
    if (!around.light[k]) around.light[k] = &lightOf(*around.site[k], asked);
  return true;
}

bool IrradianceField::find(const SurfacePlace& place, FieldReader& reader, SiteLooker& looker,
                           GatheredLight& light) {
  auto chart = SurfaceChart::of(scene_, grid_, place);
  if (!chart) return false;
  if (chart->extent() < finest_) {
    if (chart->isCurved()) return false;
    chart = SurfaceChart::ofPlane(grid_, place);
  }
  enter(reader);
  const Asked asked{*reader, looker};
  const int finest = grid_.levelOf(finest_), last = std::min(finest + kBeyondFinest, CellGrid::kLevels);
  // As wide as what surrounds the place allows.
  int level = std::min(grid_.levelOf(std::min(chart->extent(), kOpen * grid_.size)), finest);
  for (; level < finest; ++level) {
    const Site& site = siteOf(*chart, chart->cellAt(grid_, level, chart->u(), chart->v()), asked);
    if (site.usable && !site.smallObjectNear && grid_.side(level) <= kWidest * accuracy_ * site.reach) break;
  }
  const double tolerance = accuracy_ / 3;
  light = {};
  double missing = 1, allowed = 1;
  for (; level <= last; ++level, allowed *= kMoreError) {
    Around around;
    if (!look(*chart, place, level, asked, around)) continue;
    double shift = 0;
    const GatheredLight here = around.at(place.point, shift);
    const double roughness = std::max(around.roughness(tolerance), shift * kShiftError / tolerance) / allowed;
    const double share = level >= finest ? 1 : shareOf(roughness);
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

}  // namespace rsphere
