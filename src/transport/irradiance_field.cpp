#include "transport/irradiance_field.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>

#include "scene/random.h"
#include "shade/scattering.h"

namespace rsphere {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kNormalStep = 1e-9;  // planes whose normals differ by less are one

// What the tables and the allocation add to what they hold (bytes, about).
constexpr size_t kBlock = 16, kNode = 96;

constexpr size_t kNoBound = SIZE_MAX;

constexpr int32_t kSingle = 1;          // in the key of a site that serves a whole surface, as its level
constexpr int32_t kSecond = 1 << 8;     // added to the level in keys of what is of second surfaces
constexpr int32_t kCurved = INT32_MAX;  // in a key, where planes have a component of their normal

// Standard errors that corners may differ by.
constexpr double kChance = .7;

// Where something stands, as a share of the way to a place: nearer than that hides it, even if there is a gap
// below; farther than that does not.
constexpr double kHidden = 1.1, kFree = .5;

constexpr size_t kBetweenSaves = 256;  // values that a process that is killed may lose

constexpr int kBeyondFinest = 2;  // divisions more where corners are hidden

// From level to level, the rays of corners and the error that is allowed: the smaller the squares, the less
// of a picture they are. Found by trial on three rooms. Who asks for more than two bounces wants the last
// percents, and gets more rays.
constexpr double kFewerRays = .82, kFewerRaysOfMore = .9, kMoreError = 1.6;

// The widest square that is asked about a place beside something, in mean distances of what the place sees.
constexpr double kReaches = 6;
constexpr double kBeside = .85;  // what a place is from a corner, in the way to what stands there

// Of a square's side, from each corner: where that corner tells alone if it can.
constexpr double kAlone = .4;

// Where corners are hidden, the others are shifted: what they may be off by, in what their changes per length
// and the distances to what they see tell of it, with two bounces and with more.
constexpr double kShiftError = 2, kShiftErrorOfMore = 4;

// One corner tells alone where so many times its chance, and so many times the square of the way in distances
// to what it sees, stay below the error that is allowed, and its change below so many times that error.
constexpr double kAloneChance = 4, kAloneCurvature = 1.5, kAloneChange = 1.5;

// At second surfaces: how wide squares are at least and how often they are divided; their share of rays, how
// much more error is allowed, how near something may stand, and the least part of the corners that has to be
// free of it.
constexpr int kSecondDivisions = 1;
constexpr double kSecondSpacing = .06;  // of the size of all
constexpr double kSecondRays = .25, kSecondRaysOfMore = .4, kSecondError = 4, kSecondHidden = .7,
                 kSecondServed = .5;

// Of the changes per length, what counts between corners: with a half of them, parabolas are met, but so is
// their noise.
constexpr float kSlopes = .3F;

// The lattice lies askew to what people model in round numbers.
constexpr double kSkew[3] = {.6180339887, .7548776662, .5698402910};

float luminance(const V3f& color) { return static_cast<float>(brightness(Rgb(color.x, color.y, color.z))); }
V3f luminanceOf(const V3f (&change)[3]) {
  return static_cast<float>(kRedWeight) * change[0] + static_cast<float>(kGreenWeight) * change[1] +
         static_cast<float>(kBlueWeight) * change[2];
}

// atan2(y, x) to .004.
double quickAzimuth(double x, double y) {
  const double ax = std::abs(x), ay = std::abs(y);
  const double t = std::min(ax, ay) / std::max(std::max(ax, ay), 1e-300);
  double angle = t * (kPi / 4 + .273 * (1 - t));
  if (ay > ax) angle = kPi / 2 - angle;
  if (x < 0) angle = kPi - angle;
  return y < 0 ? -angle : angle;
}

GatheredLight dark() {
  GatheredLight light;
  for (int k = 0; k < 3; ++k) light.perLength[k] = light.perTilt[k] = V3f(0, 0, 0);
  return light;
}

}  // namespace

uint64_t IrradianceField::Key::hash() const {
  const auto pair = [](int32_t a, int32_t b) {
    return static_cast<uint64_t>(static_cast<uint32_t>(a)) << 32 | static_cast<uint32_t>(b);
  };
  uint64_t h = mixBits(pair(i, j) ^ static_cast<uint64_t>(offset) * 0x9e3779b97f4a7c15u);
  h = mixBits(h ^ pair(normal[0], normal[1]));
  return mixBits(h ^ pair(normal[2], level));
}

// How the lattice lies on a surface. Coordinates u, v are world units on it, or nearly so.
struct IrradianceField::Chart {
  enum class Kind : uint8_t { plane, ball, cone } kind = Kind::plane;
  std::array<int32_t, 3> key{};
  int64_t offsetKey = 0;
  double u = 0, v = 0;  // of the place
  double radius = 0;    // of what is curved
  // plane: the largest component of the normal, and the other two, which the lattice lies along. ball: of the
  // direction from the center, with its sign.
  int axis = 2, axisU = 0, axisV = 1;
  double sign = 1;
  V3d normal{0, 0, 1};
  double offset = 0;
  const Sphere* ball = nullptr;
  const Cone* cone = nullptr;
};

struct IrradianceField::Value {
  Key key;
  std::atomic<const GatheredLight*> light{nullptr};
  std::atomic<bool> begun{false};  // somebody gathers it, or has
  Value* nextFresh = nullptr;

  ~Value() { delete light.load(std::memory_order_relaxed); }
};

struct IrradianceField::Site {
  Value value;
  GatherSite at;
  SiteLooker::Surroundings standing{};

  V3d x, y;        // frame of the azimuths
  float most = 0;  // of standing

  // How far a point is, in what lies free in its direction; where nothing stands near enough to matter, at
  // least. Between two azimuths one over the distance is interpolated, as it runs along a wall.
  double nearness(const V3d& point) const {
    constexpr int kAzimuths = SiteLooker::kAzimuths;
    const V3d way = point - at.point;
    const double along = way.dot(x), across = way.dot(y);
    const double distance = std::sqrt(along * along + across * across);
    if (distance * most <= kFree) return distance * most;
    double azimuth = quickAzimuth(along, across) * (kAzimuths / (2 * kPi));
    if (azimuth < 0) azimuth += kAzimuths;
    const int low = static_cast<int>(azimuth) % kAzimuths;
    const double share = azimuth - std::floor(azimuth);
    return distance * ((1 - share) * standing[low] + share * standing[(low + 1) % kAzimuths]);
  }
};

// A square of the lattice, and those that it is divided into.
struct IrradianceField::Cell {
  std::array<Site*, 4> corners{};    // at (0, 0), (1, 0), (0, 1), (1, 1)
  unsigned unsure = 0;               // bits of those that may be hidden from some of the square
  std::atomic<float> roughness{-1};  // with all corners; negative: not known yet
  std::array<std::atomic<Cell*>, 4> parts{};

  ~Cell() {
    for (auto& part : parts) delete part.load(std::memory_order_relaxed);
  }
};

// What is known of one kind of light. Counts what it holds, and what it may.
struct FieldMemory {
  const size_t limit;
  const std::shared_ptr<IrradianceField::Use> use;
  std::atomic<size_t> bytes{0};
  InsertOnce<IrradianceField::Key, IrradianceField::Cell> cells;
  InsertOnce<IrradianceField::Key, IrradianceField::Site> sites;

  FieldMemory(size_t most, std::shared_ptr<IrradianceField::Use> by)
      : limit(most), use(std::move(by)), cells(logBuckets(most)), sites(logBuckets(most)) {
    use->reserved.fetch_add(limit, std::memory_order_relaxed);
    add(2 * sizeof(void*) << logBuckets(most));
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
  LightOf of;
};

IrradianceField::IrradianceField(const Scene& scene, const Box3d& bounds, const RayOptions& options)
    : scene_(scene),
      accuracy_(options.ambientAccuracy),
      shiftError_(options.ambientBounces > 2 ? kShiftErrorOfMore : kShiftError),
      fewerRays_(options.ambientBounces > 2 ? kFewerRaysOfMore : kFewerRays),
      secondRays_(options.ambientBounces > 2 ? kSecondRaysOfMore : kSecondRays),
      bound_(options.fieldMemory > 0 ? static_cast<size_t>(options.fieldMemory * 1e6) : kNoBound) {
  double magnitude = 0;
  if (!bounds.isEmpty()) {
    const V3d extent = bounds.size();
    size_ = std::max({extent.x, extent.y, extent.z});
    origin_ = bounds.min;
    for (int c = 0; c < 3; ++c)
      magnitude = std::max({magnitude, std::abs(bounds.min[c]), std::abs(bounds.max[c])});
  }
  if (!(size_ > 0)) size_ = 1;
  planeStep_ = std::max(1e-6 * size_, 1e-12 * magnitude);
  // RADIANCE's own meaning of -ar.
  const double resolution = std::max(options.ambientResolution, 1);
  const double finest = size_ * std::min(accuracy_, .5) / resolution;
  const double coarsest = std::min(32 * finest, .1 * size_);
  spacing_.push_back(coarsest);
  while (spacing_.back() > finest * 1.5 && spacing_.size() < 16) spacing_.push_back(spacing_.back() / 2);
  while (std::ldexp(spacing_[0], -secondLevel_) < kSecondSpacing * size_) --secondLevel_;
  extents_.resize(scene.surfaces.size());
  for (size_t i = 0; i < extents_.size(); ++i) {
    const Shape& shape = scene.surfaces[i].shape;
    if (!planeNormal(shape)) continue;
    const Box3d box = rsphere::bounds(shape, scene.vertices);
    extents_[i] = {V3f(box.center()), static_cast<float>(box.size().length())};
  }
}

IrradianceField::~IrradianceField() { save(true); }

// Sees to it that a thread begins its question in the newest memory, and that this one is not full.
void IrradianceField::enter(LightOf of, std::shared_ptr<FieldMemory>& memory) {
  Newest& newest = newest_[static_cast<size_t>(of)];
  if (memory && memory.get() == newest.memory.load(std::memory_order_relaxed) && !memory->isFull()) return;
  const std::shared_ptr<FieldMemory> left = std::move(memory);
  std::shared_ptr<FieldMemory> full;  // freed outside the lock
  const std::lock_guard lock(newest.replacing);
  if (!newest.kept || newest.kept->isFull()) {
    full = std::move(newest.kept);
    // Of each kind one that is asked and one that others are leaving; less where more than one is left.
    const size_t reserved = use_->reserved.load(std::memory_order_relaxed);
    const size_t limit =
        bound_ == kNoBound ? kNoBound : std::min(bound_ / 4, bound_ - std::min(bound_, reserved));
    newest.kept = std::make_shared<FieldMemory>(limit, use_);
    newest.memory.store(newest.kept.get(), std::memory_order_relaxed);
  }
  memory = newest.kept;
}

// The key, then the numbers of the light, as the machine has them.
AmbientFile::Record IrradianceField::recordOf(const Key& key, const GatheredLight& light) {
  std::array<int32_t, 6> whole{key.normal[0], key.normal[1], key.normal[2], key.i, key.j, key.level};
  std::array<float, 24> numbers;
  size_t n = 0;
  const auto put = [&](const V3f& v) {
    for (int c = 0; c < 3; ++c) numbers[n++] = v[c];
  };
  put(light.mean);
  for (int k = 0; k < 3; ++k) put(light.perLength[k]);
  for (int k = 0; k < 3; ++k) put(light.perTilt[k]);
  for (const float x : {light.noise, light.noisePerLength, light.reach}) numbers[n++] = x;
  AmbientFile::Record record;
  static_assert(sizeof whole + sizeof key.offset + sizeof numbers == sizeof record);
  std::memcpy(record.data(), &whole, sizeof whole);
  std::memcpy(record.data() + sizeof whole, &key.offset, sizeof key.offset);
  std::memcpy(record.data() + sizeof whole + sizeof key.offset, &numbers, sizeof numbers);
  return record;
}

void IrradianceField::fromRecord(const AmbientFile::Record& record, Key& key, GatheredLight& light) {
  std::array<int32_t, 6> whole;
  std::array<float, 24> numbers;
  std::memcpy(&whole, record.data(), sizeof whole);
  std::memcpy(&key.offset, record.data() + sizeof whole, sizeof key.offset);
  std::memcpy(&numbers, record.data() + sizeof whole + sizeof key.offset, sizeof numbers);
  key.normal = {whole[0], whole[1], whole[2]};
  key.i = whole[3];
  key.j = whole[4];
  key.level = whole[5];
  size_t n = 0;
  const auto get = [&](V3f& v) {
    for (int c = 0; c < 3; ++c) v[c] = numbers[n++];
  };
  get(light.mean);
  for (int k = 0; k < 3; ++k) get(light.perLength[k]);
  for (int k = 0; k < 3; ++k) get(light.perTilt[k]);
  for (float* x : {&light.noise, &light.noisePerLength, &light.reach}) *x = numbers[n++];
}

void IrradianceField::keepIn(std::unique_ptr<AmbientFile> file) {
  file_ = std::move(file);
  if (!file_) return;
  for (const AmbientFile::Record& record : file_->take()) {
    Key key;
    GatheredLight light;
    fromRecord(record, key, light);
    known_.emplace(key, light);
  }
}

void IrradianceField::addFresh(Value* first, Value* last) {
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
  Value* const first = fresh_.exchange(nullptr, std::memory_order_acquire);
  if (!first) return;
  std::vector<AmbientFile::Record> records;
  Value* last = first;
  for (Value* value = first; value; value = value->nextFresh) {
    records.push_back(recordOf(value->key, *value->light.load(std::memory_order_acquire)));
    last = value;
  }
  if (!file_->add(records, wait)) addFresh(first, last);
}

void IrradianceField::setPlane(const FieldPlace& place, Chart& chart) const {
  for (int c = 0; c < 3; ++c) {
    chart.key[c] = static_cast<int32_t>(std::lround(place.normal[c] / kNormalStep));
    chart.normal[c] = chart.key[c] * kNormalStep;
  }
  for (int c = 0; c < 3; ++c)
    if (std::abs(chart.normal[c]) > std::abs(chart.normal[chart.axis])) chart.axis = c;
  chart.normal.normalize();
  const V3d local = place.point - origin_;
  // Three eighths: away from where the offsets of planes in round numbers lie.
  chart.offsetKey = static_cast<int64_t>(std::floor(chart.normal.dot(local) / planeStep_ + .375));
  // In front of all that count as this plane.
  chart.offset = (static_cast<double>(chart.offsetKey) + 1.5) * planeStep_;
  chart.axisU = (chart.axis + 1) % 3;
  chart.axisV = (chart.axis + 2) % 3;
  chart.u = local[chart.axisU];
  chart.v = local[chart.axisV];
}

// False for what has no lattice.
bool IrradianceField::chartOf(const FieldPlace& place, Chart& chart) const {
  if (place.surface == kNone || planeNormal(scene_.surfaces[place.surface].shape)) {
    setPlane(place, chart);
    return true;
  }
  if (place.scale != 0) return false;
  const Shape& shape = scene_.surfaces[place.surface].shape;
  chart.key = {place.surface, 0, kCurved};
  if (const auto* ball = std::get_if<Sphere>(&shape)) {
    const V3d out = place.point - ball->center;
    if (out.dot(place.normal) < 0) return false;
    chart.kind = Chart::Kind::ball;
    chart.ball = ball;
    chart.radius = ball->radius;
    for (int c = 0; c < 3; ++c)
      if (std::abs(out[c]) > std::abs(out[chart.axis])) chart.axis = c;
    chart.axisU = (chart.axis + 1) % 3;
    chart.axisV = (chart.axis + 2) % 3;
    chart.sign = out[chart.axis] < 0 ? -1 : 1;
    chart.key[1] = chart.axis * 2 + (chart.sign < 0);
    const double scale = ball->radius / std::abs(out[chart.axis]);
    chart.u = out[chart.axisU] * scale;
    chart.v = out[chart.axisV] * scale;
    return true;
  }
  const auto* cone = std::get_if<Cone>(&shape);
  if (!cone) return false;
  const V3d out = place.point - cone->base;
  V3d x, y;
  frame(cone->axis, x, y);
  if (out.dot(x) * place.normal.dot(x) + out.dot(y) * place.normal.dot(y) < 0) return false;
  chart.kind = Chart::Kind::cone;
  chart.cone = cone;
  chart.radius = std::max(cone->radius0, cone->radius1);
  chart.u = std::atan2(out.dot(y), out.dot(x)) * chart.radius;
  chart.v = out.dot(cone->axis);
  return true;
}

GatherSite IrradianceField::siteAt(const Chart& chart, double u, double v) const {
  GatherSite site;
  switch (chart.kind) {
    case Chart::Kind::plane: {
      V3d p;
      p[chart.axisU] = u;
      p[chart.axisV] = v;
      p[chart.axis] = (chart.offset - chart.normal[chart.axisU] * u - chart.normal[chart.axisV] * v) /
                      chart.normal[chart.axis];
      site = {origin_ + p, chart.normal};
      break;
    }
    case Chart::Kind::ball: {
      V3d out;
      out[chart.axis] = chart.sign * chart.radius;
      out[chart.axisU] = u;
      out[chart.axisV] = v;
      out.normalize();
      site = {chart.ball->center + (chart.radius + planeStep_) * out, out};
      break;
    }
    case Chart::Kind::cone: {
      const Cone& cone = *chart.cone;
      V3d x, y;
      frame(cone.axis, x, y);
      const double angle = u / chart.radius;
      const V3d out = std::cos(angle) * x + std::sin(angle) * y;
      const double slope = (cone.radius1 - cone.radius0) / cone.length;
      // Beyond the tip the site lies on the axis; the tip hides it.
      const double radius = std::max(0., cone.radius0 + slope * v);
      const V3d normal = (out - slope * cone.axis).normalized();
      site = {cone.base + v * cone.axis + radius * out + planeStep_ * normal, normal};
      break;
    }
  }
  return site;
}

void IrradianceField::leave(FieldReader& reader) const {
  if (bound_ != kNoBound) reader = {};
}

IrradianceField::Site& IrradianceField::site(const Key& key, const GatherSite& at, const Asked& asked) {
  return asked.memory.sites.findOrAdd(key, [&] {
    auto made = std::make_unique<Site>();
    made->value.key = key;
    if (asked.of == LightOf::second) made->value.key.level += kSecond;
    made->at = at;
    made->standing = asked.looker.survey(at, 4 * std::ldexp(spacing_[0], -secondLevel_));
    made->most = *std::max_element(made->standing.begin(), made->standing.end());
    frame(at.normal, made->x, made->y);
    asked.memory.add(sizeof(Site) + kNode);
    made_.fetch_add(1, std::memory_order_relaxed);
    return made;
  });
}

// i, j: in steps of the finest spacing.
IrradianceField::Site& IrradianceField::corner(const Chart& chart, int64_t i, int64_t j, const Asked& asked) {
  const Key key{chart.key, static_cast<int32_t>(i), static_cast<int32_t>(j), 0, chart.offsetKey};
  const double step = spacing_.back() / (1 << kBeyondFinest);
  return site(key,
              siteAt(chart, (static_cast<double>(i) - kSkew[chart.axisU]) * step,
                     (static_cast<double>(j) - kSkew[chart.axisV]) * step),
              asked);
}

// Corners of small squares tell about little, and are many: they get fewer rays, level by level.
double IrradianceField::shareOfRays(const Key& key, LightOf of) const {
  if (of == LightOf::second) return secondRays_;
  if (key.level == kSingle) return 1;
  const int divisions = static_cast<int>(spacing_.size()) - 1 + kBeyondFinest -
                        std::countr_zero(static_cast<uint32_t>(key.i | key.j));
  return std::pow(fewerRays_, std::max(0, divisions));
}

const GatheredLight& IrradianceField::lightOf(Site& site, const Asked& asked) {
  Value& value = site.value;
  if (const GatheredLight* light = value.light.load(std::memory_order_acquire)) return *light;
  value.begun.store(true, std::memory_order_relaxed);
  const auto known = known_.find(value.key);
  auto gathered = std::make_unique<GatheredLight>(
      known != known_.end()
          ? known->second
          : asked.looker.gather(site.at, asked.of, shareOfRays(value.key, asked.of), value.key.hash()));
  const GatheredLight* first = nullptr;
  if (!value.light.compare_exchange_strong(first, gathered.get(), std::memory_order_acq_rel)) return *first;
  const GatheredLight& light = *gathered.release();
  asked.memory.add(sizeof(GatheredLight) + kBlock);
  if (file_ && known == known_.end()) {
    addFresh(&value, &value);
    if ((gathered_.fetch_add(1, std::memory_order_relaxed) + 1) % kBetweenSaves == 0) save(false);
  }
  return light;
}

// Whether nothing hides a place from a site. The ray runs a little above both, for it is no matter what lies
// flat on the surface.
bool IrradianceField::serves(const Site& site, const FieldPlace& place, SiteLooker& looker) const {
  const double nearness = site.nearness(place.point);
  if (nearness > kHidden) return false;
  if (nearness < kFree) return true;
  const double height =
      (place.point - site.at.point).length() * (.03 + .15 * (place.normal - site.at.normal).length());
  return looker.sees(site.at.point + height * site.at.normal, place.point + height * place.normal);
}

// The light at a place near a site by its changes alone; false where they are not to be trusted so far.
bool extrapolate(const GatheredLight& light, const V3d& to, double tolerance, GatheredLight& result) {
  const V3f aside(to);
  const double level = luminance(light.mean), way = aside.length() / light.reach;
  if (!(level > 0) || kAloneChance * light.noise > tolerance * level ||
      kAloneCurvature * way * way > tolerance ||
      std::abs(luminanceOf(light.perLength).dot(aside)) > kAloneChange * tolerance * level)
    return false;
  result = light;
  for (int k = 0; k < 3; ++k)
    result.mean[k] += std::clamp(light.perLength[k].dot(aside), -.5f * light.mean[k], .5f * light.mean[k]);
  return true;
}

// The corners of a square that serve a place, and what they have.
struct IrradianceField::Corners {
  std::array<const GatheredLight*, 4> light{};
  std::array<V3d, 4> point;
  unsigned served = 0;

  bool has(int corner) const { return served >> corner & 1; }

  // How much the light between the corners differs from what interpolation says, in the error allowed: the
  // change of the gradients tells of curvature, what the gradients do not explain of edges. What may be
  // chance does not count: more corners would not help.
  double roughness(double tolerance) const {
    constexpr int kEdges[4][2] = {{0, 1}, {2, 3}, {0, 2}, {1, 3}};
    double level = 0, error = 0;
    for (int c = 0; c < 4; ++c)
      if (has(c)) level += luminance(light[c]->mean) / std::popcount(served);
    for (const auto& [a, b] : kEdges) {
      if (!has(a) || !has(b)) continue;
      const V3f way(point[b] - point[a]);
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

  // The same, kept where all four serve. cell: whose corners they are.
  float roughness(Cell& cell, double tolerance) const {
    if (served != 15) return static_cast<float>(roughness(tolerance));
    float kept = cell.roughness.load(std::memory_order_relaxed);
    if (kept < 0) {
      kept = static_cast<float>(roughness(tolerance));
      cell.roughness.store(kept, std::memory_order_relaxed);
    }
    return kept;
  }

  // Interpolated with these weights, which sum up to 1. middle: the place that they are of.
  V3f mean(const std::array<double, 4>& weights, V3d& middle) const {
    middle = V3d(0, 0, 0);
    V3f result(0, 0, 0);
    for (int c = 0; c < 4; ++c)
      if (has(c)) middle += point[c] * weights[c];
    for (int c = 0; c < 4; ++c) {
      if (!has(c)) continue;
      const V3f way(middle - point[c]);
      const auto w = static_cast<float>(weights[c]);
      for (int k = 0; k < 3; ++k) {
        const float there = light[c]->mean[k];
        result[k] += w * (there + kSlopes * std::clamp(light[c]->perLength[k].dot(way), -there, there));
      }
    }
    return result;
  }

  // Interpolated with these weights, which need not sum up to 1, and shifted by the mean change per length
  // where those that are hidden leave the place aside. shift: the relative error to be expected of that.
  GatheredLight at(const V3d& place, std::array<double, 4> weights, double& shift) const {
    double sum = 0;
    for (int c = 0; c < 4; ++c)
      if (has(c)) sum += weights[c];
    GatheredLight result = dark();
    float inverseReach = 0;
    for (int c = 0; c < 4; ++c) {
      weights[c] /= sum;
      if (!has(c)) continue;
      const auto w = static_cast<float>(weights[c]);
      inverseReach += w / light[c]->reach;
      for (int k = 0; k < 3; ++k) {
        result.perLength[k] += light[c]->perLength[k] * w;
        result.perTilt[k] += light[c]->perTilt[k] * w;
      }
    }
    V3d middle;
    result.mean = mean(weights, middle);
    shift = 0;
    if (served == 15) return result;
    const V3f aside(place - middle);
    const float level = luminance(result.mean);
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

namespace {

void blend(GatheredLight& into, const GatheredLight& light, float share) {
  into.mean += share * light.mean;
  for (int k = 0; k < 3; ++k) into.perTilt[k] += share * light.perTilt[k];
}

// The share of an answer that a square gives: all below roughness 1, none above 1.5.
double shareOf(double roughness) { return std::clamp(3 - 2 * roughness, 0., 1.); }

}  // namespace

std::unique_ptr<IrradianceField::Cell> IrradianceField::makeCell(const Chart& chart, int64_t i, int64_t j,
                                                                 int64_t size, const Asked& asked) {
  auto made = std::make_unique<Cell>();
  asked.memory.add(sizeof(Cell) + kNode);
  for (int c = 0; c < 4; ++c)
    made->corners[c] = &corner(chart, i + (c & 1) * size, j + (c >> 1) * size, asked);
  for (int c = 0; c < 4; ++c)
    for (int step = 0; step <= 8; ++step) {
      // From one neighbouring corner past the opposite one to the other.
      const double far = std::min(step, 4) / 4., near = std::min(8 - step, 4) / 4.;
      const double a = (c & 1) ? 1 - near : near, b = (c >> 1) ? 1 - far : far;
      const V3d there = (1 - b) * ((1 - a) * made->corners[0]->at.point + a * made->corners[1]->at.point) +
                        b * ((1 - a) * made->corners[2]->at.point + a * made->corners[3]->at.point);
      if (made->corners[c]->nearness(there) > kFree) made->unsure |= 1u << c;
    }
  return made;
}

// The light of those corners that serve. What another thread is at comes last: it may be there by then.
void IrradianceField::lookUp(const Cell& cell, const Asked& asked, Corners& corners) {
  for (int c = 0; c < 4; ++c) {
    if (!corners.has(c)) continue;
    Site& site = *cell.corners[c];
    corners.point[c] = site.at.point;
    const Value& value = site.value;
    if (!value.begun.load(std::memory_order_relaxed) || value.light.load(std::memory_order_relaxed))
      corners.light[c] = &lightOf(site, asked);
  }
  for (int c = 0; c < 4; ++c)
    if (corners.has(c) && !corners.light[c]) corners.light[c] = &lightOf(*cell.corners[c], asked);
}

// Where a place lies in the lattice.
struct IrradianceField::Square {
  Cell* cell = nullptr;
  int64_t i = 0, j = 0, size = 0;  // in steps of the least spacing there is
  double stepU = 0, stepV = 0;     // of the place

  // Of the place within the square, from 0 to 1.
  double across() const {
    return std::clamp((stepU - static_cast<double>(i)) / static_cast<double>(size), 0., 1.);
  }
  double along() const {
    return std::clamp((stepV - static_cast<double>(j)) / static_cast<double>(size), 0., 1.);
  }
  std::array<double, 4> weights() const {
    const double a = across(), b = along();
    return {(1 - a) * (1 - b), a * (1 - b), (1 - a) * b, a * b};
  }
};

// False where the place is beyond all numbers.
bool IrradianceField::begin(const Chart& chart, int level, const Asked& asked, Square& square) {
  const int last = static_cast<int>(spacing_.size()) - 1 + kBeyondFinest;
  const double least = spacing_.back() / (1 << kBeyondFinest);
  square.stepU = chart.u / least + kSkew[chart.axisU];
  square.stepV = chart.v / least + kSkew[chart.axisV];
  if (std::max(std::abs(square.stepU), std::abs(square.stepV)) > INT32_MAX / 2) return false;
  square.size = int64_t{1} << (last - level);
  const auto floorTo = [](double x, int64_t n) {
    return static_cast<int64_t>(std::floor(x / static_cast<double>(n))) * n;
  };
  square.i = floorTo(square.stepU, square.size);
  square.j = floorTo(square.stepV, square.size);
  const Key key{chart.key, static_cast<int32_t>(square.i), static_cast<int32_t>(square.j), level,
                chart.offsetKey};
  square.cell = &asked.memory.cells.findOrAdd(
      key, [&] { return makeCell(chart, square.i, square.j, square.size, asked); });
  return true;
}

// To the quarter of the square that the place lies in.
void IrradianceField::descend(const Chart& chart, const Asked& asked, Square& square) {
  square.size /= 2;
  const int right = square.stepU >= static_cast<double>(square.i + square.size),
            up = square.stepV >= static_cast<double>(square.j + square.size);
  square.i += right * square.size;
  square.j += up * square.size;
  std::atomic<Cell*>& part = square.cell->parts[2 * up + right];
  Cell* next = part.load(std::memory_order_acquire);
  if (!next) {
    auto made = makeCell(chart, square.i, square.j, square.size, asked);
    if (part.compare_exchange_strong(next, made.get(), std::memory_order_acq_rel)) next = made.release();
  }
  square.cell = next;
}

// What the nearest corners alone tell of a place: one of them, and within a strip half way to the next two,
// or four. False where any of these does not tell enough.
bool IrradianceField::nearby(const Square& square, const V3d& point, double tolerance, const Asked& asked,
                             GatheredLight& light) {
  const auto sharpen = [](double x) { return std::clamp((x - kAlone) / (1 - 2 * kAlone), 0., 1.); };
  const double a = sharpen(square.across()), b = sharpen(square.along());
  const double weights[4] = {(1 - a) * (1 - b), a * (1 - b), (1 - a) * b, a * b};
  light = dark();
  for (int c = 0; c < 4; ++c) {
    GatheredLight there;
    if (weights[c] == 0) continue;
    Site& site = *square.cell->corners[c];
    if (!extrapolate(lightOf(site, asked), point - site.at.point, tolerance, there)) return false;
    blend(light, there, static_cast<float>(weights[c]));
  }
  return true;
}

bool IrradianceField::find(const FieldPlace& place, FieldReader& reader, SiteLooker& looker,
                           GatheredLight& light) {
  Chart chart;
  if (!chartOf(place, chart)) return false;
  enter(LightOf::first, reader[0]);
  const Asked asked{*reader[0], looker, LightOf::first};
  const double tolerance = accuracy_ / 3;
  const int finest = static_cast<int>(spacing_.size()) - 1;
  const int last = finest + kBeyondFinest;
  int level = 0;
  if (chart.kind != Chart::Kind::plane) {
    while (level < finest && spacing_[level] > chart.radius) ++level;
    if (spacing_[level] > chart.radius) return false;
  } else if (place.surface != kNone) {
    const double extent = extents_[place.surface].size * (place.scale != 0 ? place.scale : 1);
    // As many values as there are questions help nobody.
    if (extent < spacing_[finest]) return false;
    if (extent < spacing_[0]) {
      if (place.scale == 0 && single(place, chart, tolerance, asked, light)) return true;
      while (level < finest && spacing_[level] > extent) ++level;
    }
  }

  Square square;
  if (!begin(chart, level, asked, square)) return false;
  const double least = spacing_.back() / (1 << kBeyondFinest);

  light = dark();
  GatheredLight near;
  double missing = 1, allowed = std::pow(kMoreError, level);
  double widest = 0;  // of the squares that can tell about a place with so much around it; 0: not known yet
  for (;; ++level, allowed *= kMoreError) {
    Cell* const cell = square.cell;
    const double side = static_cast<double>(square.size);
    if (!cell->unsure && nearby(square, place.point, tolerance * allowed, asked, near)) {
      blend(light, near, static_cast<float>(missing));
      return true;
    }
    bool beside = false;
    for (int c = 0; c < 4; ++c)
      beside |= (cell->unsure >> c & 1) && cell->corners[c]->nearness(place.point) > kBeside;
    if (beside && widest == 0)
      widest = kReaches * looker.reach({place.point + planeStep_ * place.normal, place.normal}, least / 4);
    if (!beside || side * least <= widest) {
      Corners corners;
      for (int c = 0; c < 4; ++c) {
        if ((cell->unsure >> c & 1) && !serves(*cell->corners[c], place, looker)) continue;
        corners.served |= 1u << c;
      }
      lookUp(*cell, asked, corners);
      const std::array<double, 4> weights = square.weights();
      double served = 0;
      for (int c = 0; c < 4; ++c)
        if (corners.has(c)) served += weights[c];
      if (served > 1e-6) {
        double shift = 0;
        const GatheredLight here = corners.at(place.point, weights, shift);
        const double roughness =
            std::max<double>(corners.roughness(*cell, tolerance), shift * shiftError_ / tolerance) / allowed;
        const bool accept = level >= (corners.served == 15 ? finest : last);
        const double share = accept ? 1 : shareOf(roughness);
        blend(light, here, static_cast<float>(missing * share));
        missing *= 1 - share;
        if (missing <= 0) return true;
      }
    }
    if (level == last) break;
    descend(chart, asked, square);
  }
  if (missing >= 1) return false;
  const GatheredLight found = light;
  light = dark();
  blend(light, found, static_cast<float>(1 / (1 - missing)));
  return true;
}

bool IrradianceField::findSecond(const FieldPlace& place, FieldReader& reader, SiteLooker& looker,
                                 V3f& mean) {
  Chart chart;
  if (!chartOf(place, chart)) return false;
  // Single paths are as good where few of them arrive.
  const bool flat = chart.kind == Chart::Kind::plane;
  const double scale = place.scale != 0 ? place.scale : 1;
  const double widest = std::ldexp(spacing_[0], -secondLevel_);
  const double extent = !flat                    ? chart.radius
                        : place.surface == kNone ? widest
                                                 : extents_[place.surface].size * scale;
  if (extent < widest) return false;
  enter(LightOf::second, reader[1]);
  const Asked asked{*reader[1], looker, LightOf::second};
  Square square;
  if (!begin(chart, secondLevel_, asked, square)) return false;
  const double tolerance = kSecondError * accuracy_ / 3;
  const int last = secondLevel_ + kSecondDivisions;
  for (int level = secondLevel_;; ++level) {
    Cell& cell = *square.cell;
    const std::array<double, 4> weights = square.weights();
    Corners corners;
    double served = 0;
    for (int c = 0; c < 4; ++c) {
      if ((cell.unsure >> c & 1) && cell.corners[c]->nearness(place.point) > kSecondHidden) continue;
      corners.served |= 1u << c;
      served += weights[c];
    }
    if (served >= kSecondServed) {
      lookUp(cell, asked, corners);
      if (level == last || corners.roughness(cell, tolerance) < 1) {
        V3d middle;
        double shift = 0;
        mean = corners.served == 15 ? corners.mean(weights, middle)
                                    : corners.at(place.point, weights, shift).mean;
        return true;
      }
    }
    if (level == last) return false;
    descend(chart, asked, square);
  }
}

// One value serves a surface that is small enough.
bool IrradianceField::single(const FieldPlace& place, const Chart& chart, double tolerance,
                             const Asked& asked, GatheredLight& light) {
  const Extent& extent = extents_[place.surface];
  V3d center = V3d(extent.center);
  center += (chart.offset - chart.normal.dot(center - origin_)) * chart.normal;
  const Key key{chart.key, place.surface, 0, kSingle, chart.offsetKey};
  Site& middle = site(key, {center, chart.normal}, asked);
  if (middle.nearness(place.point) > kFree && !serves(middle, place, asked.looker)) return false;
  const GatheredLight& there = lightOf(middle, asked);
  const double change = luminanceOf(there.perLength).length() * extent.size / 2;
  if (change > 2 * tolerance * luminance(there.mean)) return false;
  Corners corners;
  corners.light[0] = &there;
  corners.point[0] = center;
  corners.served = 1;
  double shift = 0;
  light = corners.at(place.point, {1, 0, 0, 0}, shift);
  return true;
}

}  // namespace rsphere
