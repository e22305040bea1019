#include "transport/light_vertices.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/constants.h"
#include "shade/scattering.h"
#include "transport/light_particles.h"
#include "transport/tuning.h"
#include "transport/vertex_clusters.h"

namespace rsphere {
namespace {

using Tuning = tuning::LightVertices;

// Every third bit of the result is one of the lowest 10 bits of x.
uint32_t spread(uint32_t x) {
  x = (x | x << 16) & 0x030000ff;
  x = (x | x << 8) & 0x0300f00f;
  x = (x | x << 4) & 0x030c30c3;
  return (x | x << 2) & 0x09249249;
}

// The order of points along Morton's curve through a grid of 1024 cells a side: points that lie near to each
// other mostly follow each other.
template <class PointOf>
std::vector<uint32_t> orderByPlace(size_t count, const PointOf& pointOf) {
  constexpr double kCells = 1024;
  Box3d box;
  for (size_t i = 0; i < count; ++i) box.extendBy(pointOf(i));
  const V3d size = box.size();
  std::vector<std::pair<uint32_t, uint32_t>> keys(count);
  for (size_t i = 0; i < count; ++i) {
    const V3d at = pointOf(i) - box.min;
    uint32_t key = 0;
    for (int k = 0; k < 3; ++k)
      if (size[k] > 0)
        key |= spread(static_cast<uint32_t>(std::min(at[k] / size[k] * kCells, kCells - 1))) << k;
    keys[i] = {key, static_cast<uint32_t>(i)};
  }
  std::sort(keys.begin(), keys.end());
  std::vector<uint32_t> order(count);
  for (size_t i = 0; i < count; ++i) order[i] = keys[i].second;
  return order;
}

template <class T>
void permute(std::vector<T>& all, std::span<const uint32_t> order) {
  std::vector<T> sorted;
  sorted.reserve(all.size());
  for (const uint32_t i : order) sorted.push_back(std::move(all[i]));
  all = std::move(sorted);
}

LightVertex vertexAt(const PlainPlace& at, double power, int bounces, LightVertex::Way way, size_t batch) {
  LightVertex v{};
  for (int k = 0; k < 3; ++k) {
    v.place[k] = at.point[k];
    v.facing[k] = static_cast<float>(at.normal[k]);
  }
  v.power = static_cast<float>(power);
  v.bounces = static_cast<uint8_t>(std::min(bounces, 255));
  v.way = way;
  v.batch = static_cast<uint8_t>(batch);
  return v;
}

}  // namespace

double joinedReflectance(const Opaque& m, const V3d& normal, const V3d& view, const V3d& toSource) {
  const double color = brightness(m.color), diffuse = color * (1 - m.specularity);
  if (!hasRoughHighlight(m)) return diffuse;
  // Ward's lobe about the halfway vector, without its dependence on the cosines.
  const V3d half = toSource - view;
  const double along = half.dot(normal), square = along * along;
  if (!(along > 0)) return diffuse;
  const double a2 = m.roughness * m.roughness;
  return diffuse +
         m.specularity * (m.metal ? color : 1) * std::exp((1 - half.length2() / square) / a2) / (4 * a2);
}

// One light path on its way. It adds vertices to the lists.
class LightVertices::Path {
 public:
  Path(LightVertices& all, size_t number, uint64_t seed)
      : all_(all), random_(mixBits(mixBits(seed) + number)), batch_(number % LightVertex::kBatches) {}

  // where: from 0 to 1, chooses the source by its share of the power of all sources.
  void send(double where);

  double firstLength() const { return firstLength_; }  // 0 if the path met nothing

 private:
  bool leave(double where);
  bool passPane(const Hit& hit);
  bool meetMirror(const Hit& hit);
  void arrive(const PlainPlace& at);
  void addVisible(const PlainPlace& at, double reflected);
  bool reflect(const PlainPlace& at);
  bool reflectSpecularly(const Scattering& s, const Interaction& view, double scale);

  LightVertices& all_;
  Random random_;
  size_t batch_;
  LightId light_;
  V3d origin_, direction_;
  SurfaceId start_;
  double cosineAtSource_ = 0;
  Irradiance power_;
  LightVertex::Way way_ = LightVertex::direct;
  bool senderIsUnbounded_ = false;  // isUnbounded() of the vertex that sent the light
  bool fromSource_ = true;          // nothing has reflected it yet
  int bounces_ = 0;
  double length_ = 0, firstLength_ = 0;  // since the last reflection; and of the first segment
  std::vector<double> weights_;
  FunctionScratch scratch_;
};

void LightVertices::Path::send(double where) {
  if (!leave(where)) return;
  for (size_t hits = 0; hits < tuning::Caps::kAsked && brightness(power_) > 0; ++hits) {
    const Hit hit = all_.prepared_.tracer().nearest(origin_, direction_, kFarAway, start_);
    if (hit.surface == kNone) return;
    length_ += hit.distance;
    if (hit.perturbation != V3d(0, 0, 0)) return;
    if (all_.surfaces_.paneOf(hit.surface)) {
      if (!passPane(hit)) return;
      continue;
    }
    if (all_.surfaces_.mirrorOf(hit.surface)) {
      if (!meetMirror(hit)) return;
      continue;
    }
    const PlainPlace at =
        all_.surfaces_.placeOf(origin_, direction_, {hit, hit.distance, Coefficient(1)}, scratch_);
    if (fromSource_) {
      firstLength_ = length_;
      power_ = power_ * all_.emission_.divergence(light_, length_);
    }
    ++all_.met_;
    if (!at.material) {
      if (all_.prepared_.lights().of(at.surface) == kNone) ++all_.metUnknown_;
      return;
    }
    arrive(at);
    if (!reflect(at)) return;
    fromSource_ = false;
    length_ = 0;
    origin_ = at.point;
    start_ = at.surface;
  }
}

bool LightVertices::Path::leave(double where) {
  light_ = all_.emission_.sourceAt(where);
  if (light_ == kNone) return false;
  start_ = all_.prepared_.lights().all()[light_].surface;
  const SourceEmission::Leaving way = all_.emission_.leave(light_, random_, scratch_);
  origin_ = way.from.point + 2 * kSamePlace * way.from.normal;
  direction_ = way.direction;
  cosineAtSource_ = way.from.normal.dot(direction_);
  power_ = way.power;
  const bool weighed = all_.emission_.isEven(light_) && all_.aimedDensity(light_, 1, 1) > 0;
  way_ = weighed ? LightVertex::direct : LightVertex::unweighed;
  return true;
}

// Continues the path through a pane or mirrors it there. Returns false if the path ends.
bool LightVertices::Path::passPane(const Hit& hit) {
  Interaction view = plainInteraction(direction_, hit.normal, true);
  if (fromSource_) view.kinds = kShadow;  // no reflection
  const Scattering s = scatter(*all_.surfaces_.paneOf(hit.surface), view);
  double left = random_.uniform() * brightness(power_);
  for (const SharpPath& next : s.sharp) {
    const double share = brightness(power_ * next.coefficient);
    if ((left -= share) >= 0) continue;
    origin_ += hit.distance * direction_;
    start_ = hit.surface;
    power_ = power_ * next.coefficient * (brightness(power_) / share);
    if (next.kind == kReflected) {
      direction_ = next.direction;
      way_ = LightVertex::sharp;
      length_ = 0;
    }
    return true;
  }
  return false;
}

// Mirrors the path; returns false if it ends. It ends at the back of a mirror, which is black. Straight from
// the source it also ends at curved mirrors, because they make no images that light other surfaces.
bool LightVertices::Path::meetMirror(const Hit& hit) {
  if (hit.cosine <= 0 || (fromSource_ && all_.emission_.imageOf(light_, hit.surface) == kNone)) return false;
  const Scattering s =
      scatter(*all_.surfaces_.mirrorOf(hit.surface), plainInteraction(direction_, hit.normal, false));
  const SharpPath& next = s.sharp.path[0];
  const double share = brightness(power_ * next.coefficient) / brightness(power_);
  if (random_.uniform() >= share) return false;
  power_ = power_ * next.coefficient / share;
  origin_ += hit.distance * direction_;
  start_ = hit.surface;
  direction_ = next.direction;
  if (fromSource_) {
    light_ = all_.emission_.imageOf(light_, hit.surface);
    way_ = LightVertex::unweighed;
    return true;
  }
  way_ = LightVertex::sharp;
  length_ = 0;
  return true;
}

void LightVertices::Path::arrive(const PlainPlace& at) {
  const Opaque& m = *at.material;
  Irradiance arriving(power_.color * at.color());
  if (fromSource_) arriving *= enteringShare(m, -at.normal.dot(direction_));
  const double reflected = std::abs(brightness(arriving)) * (1 - m.specularity);
  addVisible(at, reflected);
  if (!(reflected > 0) || bounces_ + 1 > all_.prepared_.options().ambientBounces) return;
  all_.all_.push_back(vertexAt(at, reflected, bounces_ + 1, way_, batch_));
  all_.powers_.push_back(std::move(arriving));
  all_.hits_.push_back(at.surface);
}

void LightVertices::Path::addVisible(const PlainPlace& at, double reflected) {
  if (bounces_ > all_.prepared_.options().ambientBounces) return;
  const bool direct = way_ == LightVertex::direct;
  const bool diffuse = way_ == LightVertex::diffuse;
  if (way_ == LightVertex::unweighed) return;
  if (diffuse && (senderIsUnbounded_ || !(all_.closeShare(length_, all_.meanLength_) > 0))) return;
  if (!(reflected > 0) && !(direct && hasRoughHighlight(*at.material))) return;
  double shadowRays = 0;
  if (direct) {
    std::span<const uint32_t> sources;
    const double sum = all_.surfaces_.weigh(at.point, at.normal, sources, weights_);
    const auto own = std::lower_bound(sources.begin(), sources.end(), light_.index()) - sources.begin();
    SourceSample same;
    same.direction = -direction_;
    same.distance = length_;
    same.cosine = cosineAtSource_;
    same.source = light_;
    shadowRays = sum > 0 ? all_.shadowRaysOver(same, at.normal, weights_[static_cast<size_t>(own)] / sum) : 0;
  }
  const Irradiance power = direct ? power_ : Irradiance(power_.color * at.color());
  all_.visible_.push_back({vertexAt(at, reflected, bounces_ + 1, way_, batch_), power, direction_,
                           at.material, at.pattern, at.flat, length_, shadowRays});
}

// Chooses between diffuse reflection, specular reflection and the end of the path, by power. Returns false if
// the path ends.
bool LightVertices::Path::reflect(const PlainPlace& at) {
  const Opaque& m = *at.material;
  const Interaction view = plainInteraction(direction_, at.normal, at.flat, at.pattern);
  const Scattering s = scatter(m, view, 0);
  const bool isSharp = s.sharp.count > 0;
  const auto strength = [&](const Color& share) {
    return std::abs(brightness(Irradiance(power_.color * share)));
  };
  const double all = std::abs(brightness(power_));
  const double diffuse =
      bounces_ < all_.prepared_.options().ambientBounces ? strength(s.diffuseReflection) : 0;
  const Color& gloss = isSharp ? s.sharp.path[0].coefficient.color : s.specularReflection;
  const double specular = isSharp && fromSource_ ? 0 : strength(gloss);
  const double chosen = random_.uniform() * std::max(all, diffuse + specular);
  if (chosen >= diffuse + specular) return false;
  // The power is divided by the probability of the choice.
  if (chosen >= diffuse) return reflectSpecularly(s, view, std::max(all, diffuse + specular) / specular);
  double scale = std::max(all, diffuse + specular) / diffuse;
  if (fromSource_) scale *= enteringShare(m, view.cosine);
  direction_ = sentFrom(at.normal, random_);
  power_ = Irradiance(power_.color * at.color() * (diffuseShare(m, at.normal.dot(direction_)) * scale));
  senderIsUnbounded_ = way_ == LightVertex::sharp || way_ == LightVertex::highlight;
  way_ = LightVertex::diffuse;
  ++bounces_;
  return std::abs(brightness(power_)) > 0;
}

bool LightVertices::Path::reflectSpecularly(const Scattering& s, const Interaction& view, double scale) {
  way_ = fromSource_ ? LightVertex::highlight : LightVertex::sharp;
  if (fromSource_) ++bounces_;  // for the next surface, the light of the highlight is indirect
  if (s.sharp.count > 0) {
    direction_ = s.sharp.path[0].direction;
    power_ = power_ * s.sharp.path[0].coefficient * scale;
  } else {
    const double u1 = random_.uniform(), u2 = random_.uniform();
    V3d next;
    // The lobe is the same for both directions of the light.
    const double weight = sampleReflection(s, view, 1, u1, u2, next);
    direction_ = next;
    power_ = Irradiance(power_.color * s.specularReflection * (weight * scale));
  }
  return std::abs(brightness(power_)) > 0;
}

LightVertices::LightVertices(const PreparedScene& prepared, const PlainSurfaces& surfaces,
                             SourceEmission emission, size_t paths, uint64_t seed)
    : prepared_(prepared), surfaces_(surfaces), emission_(std::move(emission)) {
  measure(paths, seed);
  const auto count = static_cast<double>(paths);
  for (size_t i = 0; i < paths; ++i) {
    // Stratified, so that each batch has about the same number of paths from each source.
    const double where = (static_cast<double>(i) + Random(mixBits(seed ^ i)).uniform()) / count;
    Path(*this, i, seed).send(where);
  }
  sort();
  findHidden();
  if (met_ > 0 && surfaces_.knowAllSources())
    shareOfRest_ = std::clamp(Tuning::kRest * static_cast<double>(metUnknown_) / static_cast<double>(met_),
                              Tuning::kLeastRest, 1.);
}

// The widths depend on the size of the room, which is measured by the mean length of first segments.
void LightVertices::measure(size_t paths, uint64_t seed) {
  const size_t tried = std::min(paths, tuning::Caps::kAsked);
  double sum = 0;
  size_t met = 0;
  for (size_t i = 0; i < tried; ++i) {
    Path path(*this, i, ~seed);
    path.send((static_cast<double>(i) + .5) / static_cast<double>(tried));
    sum += path.firstLength();
    met += path.firstLength() > 0;
  }
  if (met > 0) meanLength_ = sum / static_cast<double>(met);
  width_ = Tuning::kWidth * meanLength_;
  all_.clear();
  powers_.clear();
  hits_.clear();
  visible_.clear();
}

void LightVertices::sort() {
  VertexClusters::Order clustered = VertexClusters::orderOf(all_);
  const auto& order = clustered.vertices;
  permute(all_, order);
  permute(powers_, order);
  permute(hits_, order);
  ends_ = std::move(clustered.ends);
  permute(visible_, orderByPlace(visible_.size(), [&](size_t i) { return visible_[i].vertex.point(); }));
}

// This is done only in scenes where light sources are hidden from some regions. In other scenes, few regions
// are hidden from each other.
void LightVertices::findHidden() {
  if (!prepared_.lights().hidden().divides()) return;
  std::vector<Box3d> boxes((visible_.size() + kBlock - 1) / kBlock);
  for (size_t i = 0; i < visible_.size(); ++i) boxes[i / kBlock].extendBy(visible_[i].vertex.point());
  hidden_.emplace(prepared_.scene(), prepared_.tracer(), std::move(boxes), 0);
}

void LightVertices::visibleFrom(const V3d& point, FunctionRef<void(size_t begin, size_t end)> use) const {
  if (!hidden_) return use(0, visible_.size());
  for (const uint32_t block : hidden_->notHiddenFrom(point))
    use(block * kBlock, std::min((block + 1) * kBlock, visible_.size()));
}

double LightVertices::closeShare(double distance, double fromEye) const {
  // The share is cut off to 0 beyond ten times the width, so that few vertices have any.
  constexpr double kRest = 1. / 101;
  const double width = Tuning::kClose * std::min(meanLength_, fromEye);
  const double share = width * width / (distance * distance + width * width);
  return std::max(0., (share - kRest) / (1 - kRest));
}

static_assert(kLightForms == 8, "Where are shadow rays aimed?");
// The density of the points on a source at which shadow rays from a place are aimed (1/m2); 0 if it is not
// known. distance: of the source's point. cosine: there, between the ray and the normal.
double LightVertices::aimedDensity(LightId light, double distance, double cosine) const {
  const LightSource& source = prepared_.lights().all()[light];
  if (const auto* plane = source.as<PlaneLight>()) return 1 / plane->area;
  if (!source.as<BallLight>()) return 0;
  // Shadow rays are uniform in the cone that the ball subtends. The distance of its center follows from the
  // law of cosines.
  const double r = source.radius, square = distance * distance + r * r + 2 * distance * r * cosine;
  const double sine2 = r * r / square;
  const double solidAngle = 2 * kPi * sine2 / (1 + std::sqrt(std::max(0., 1 - sine2)));
  return cosine / (distance * distance * solidAngle);
}

double LightVertices::shadowRaysOver(const SourceSample& sample, const V3d& normal,
                                     double probability) const {
  const double cosine = std::abs(sample.cosine), d = sample.distance;
  const double lightPaths =
      emission_.density(sample.source) * cosine / kPi * normal.dot(sample.direction) / (d * d);
  return lightPaths > 0 ? probability * aimedDensity(sample.source, d, cosine) / lightPaths : 0;
}

}  // namespace rsphere
