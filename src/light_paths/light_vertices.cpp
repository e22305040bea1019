#include "light_paths/light_vertices.h"

#include <utility>

#include "light_paths/tuning.h"
#include "light_paths/vertex_clusters.h"
#include "shade/scattering.h"
#include "spots/light_particles.h"

namespace rsphere {
namespace {

// Moves the lowest 10 bits of x apart, so that each is followed by two zero bits.
uint32_t spread(uint32_t x) {
  x = (x | x << 16) & 0x030000ff;
  x = (x | x << 8) & 0x0300f00f;
  x = (x | x << 4) & 0x030c30c3;
  return (x | x << 2) & 0x09249249;
}

// The order of points along a Morton curve through a grid of 1024 cells a side. Points that are close
// together are usually close in this order, too.
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
  std::ranges::sort(keys);
  std::vector<uint32_t> order(count);
  for (size_t i = 0; i < count; ++i) order[i] = keys[i].second;
  return order;
}

// Moves all[order[i]] to all[i], in place: new memory for millions of bytes takes longer than the moves.
template <class T>
void permute(std::vector<T>& all, std::span<const uint32_t> order) {
  std::vector<bool> moved(all.size());
  for (size_t first = 0; first < all.size(); ++first) {
    if (moved[first]) continue;
    T displaced = std::move(all[first]);
    size_t to = first;
    for (; order[to] != first; to = order[to]) {
      all[to] = std::move(all[order[to]]);
      moved[to] = true;
    }
    all[to] = std::move(displaced);
    moved[to] = true;
  }
}

// Clears a list and reserves memory for as many elements, times a factor.
template <class T>
void clearFor(double times, std::vector<T>& all) {
  const auto expected = static_cast<size_t>(times * static_cast<double>(all.size()));
  all.clear();
  all.reserve(expected);
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
  // Ward's lobe around the halfway vector, without Fresnel's rise at grazing angles.
  const V3d half = toSource - view;
  const double along = half.dot(normal);
  if (!(along > 0)) return diffuse;
  const double a2 = m.roughness * m.roughness, square = along * along, ratio = half.length2() / square;
  return diffuse + m.specularity * (m.metal ? color : 1) * std::exp((1 - ratio) / a2) * ratio / (square * a2);
}

// One light path. It adds its vertices to the lists.
class LightVertices::Path {
 public:
  Path(const PreparedScene& prepared, LightVertices& all, size_t number, uint64_t seed,
       const OutdoorParts* outdoors)
      : prepared_(prepared),
        all_(all),
        outdoors_(outdoors),
        random_(mixBits(mixBits(seed) + number)),
        start_(number, seed, random_) {}

  struct Course {
    double firstLength = 0;          // of the first segment, world units; 0 if the path hit nothing
    size_t met = 0, metUnknown = 0;  // numbers of surfaces that were hit
    bool leftToEye = false;          // ended at a mirror whose image of the source is not known
  };
  // where: number from 0 to 1 that selects the source, with probabilities proportional to power.
  Course send(double where);

 private:
  void follow(Course& course);  // from where it left, or was reflected, to its end
  bool leave(double where);
  bool entersAgain(const Hit& hit) const;
  // Whether sharp reflections of light straight from a source are left out, as rtrace leaves them out.
  // Importance has them: they are the last steps of light that rays from a goal find by the same reflections.
  bool losesCaustics() const { return past_.fromSource && !prepared_.scene().importance; }
  void reflectedSharply() {
    const bool isDiffuse =
        past_.way == LightVertex::diffuse && (!past_.senderIsUnbounded || past_.senderIsMirrored);
    const bool isSky = past_.way == LightVertex::unweighed && !past_.fromSource;
    if (past_.way != LightVertex::mirrored)
      past_.way = isDiffuse || isSky ? LightVertex::mirrored : LightVertex::sharp;
    past_.fromSource = false;
    beam_.length = 0;
  }
  bool passPane(const Hit& hit);
  bool meetMirror(const Hit& hit, Course& course);
  void arrive(const PlainPlace& at);
  void addVisible(const PlainPlace& at, double reflected);
  bool reflect(const PlainPlace& at);
  bool reflectSpecularly(const Scattering& s, const Interaction& view, double scale);

  // The batch of the path, and the numbers that place its start. Each batch has a separate sequence, so that
  // the differences between batches show the error.
  struct Start {
    Start(size_t number, uint64_t seed, Random& random)
        : batch(number % LightVertex::kBatches),
          numbers(static_cast<uint32_t>(number / LightVertex::kBatches), mixBits(~mixBits(seed) + batch),
                  random) {}
    size_t batch;
    ScrambledPoint numbers;
  };
  // The current segment of the path.
  struct Beam {
    V3d origin, direction;
    SurfaceId start;
    Irradiance power;
    double length = 0;  // since the last reflection, or since the light left its source
  };
  // The history of the path.
  struct Past {
    LightId source;  // kNone: the sky
    double cosineAtSource = 0;
    LightVertex::Way way = LightVertex::direct;
    // isUnbounded() of the vertex that sent the light, and whether its light was mirrored.
    bool senderIsUnbounded = false, senderIsMirrored = false;
    bool fromSource = true;  // no surface has reflected the light yet; false for light of the sky
    int bounces = 0;
  };

  const PreparedScene& prepared_;
  LightVertices& all_;
  const OutdoorParts* outdoors_;
  Random random_;
  Start start_;
  Beam beam_;
  Past past_;
  FunctionScratch scratch_;
};

LightVertices::Path::Course LightVertices::Path::send(double where) {
  Course course;
  if (leave(where)) follow(course);
  return course;
}

void LightVertices::Path::follow(Course& course) {
  for (size_t hits = 0; hits < tuning::LightVertices::kMostHits && brightness(beam_.power) > 0; ++hits) {
    const Hit hit = prepared_.tracer().nearest(beam_.origin, beam_.direction, kFarAway, beam_.start);
    if (hit.surface == kNone || entersAgain(hit)) break;
    beam_.length += hit.distance;
    if (hit.perturbation != V3d(0, 0, 0)) break;
    const PlainFinish& finish = all_.surfaces_.finishOf(hit.surface);
    beam_.start = hit.surface;
    if (finish.pane || finish.mirror) {
      beam_.origin += hit.distance * beam_.direction;
      if (finish.pane ? passPane(hit) : meetMirror(hit, course)) continue;
      break;
    }
    const PlainPlace at =
        all_.surfaces_.placeOf(beam_.origin, beam_.direction, {hit, hit.distance, Coefficient(1)}, scratch_);
    if (course.met == 0) course.firstLength = beam_.length;
    if (past_.fromSource)
      beam_.power = beam_.power * all_.starts_.onSources.divergence(past_.source, beam_.length);
    ++course.met;
    if (!at.material) {
      course.metUnknown += prepared_.lights().of(at.surface) == kNone;
      break;
    }
    arrive(at);
    beam_.length = 0;
    beam_.origin = at.point;
    // Splitting: a path from a portal with more light than most, as of the sun through a frosted pane, goes
    // on as several. A single one that a glossy floor reflects would be a bright spot on the ceiling.
    const bool splits = past_.source == kNone && course.met == 1;
    const double most = splits ? double{tuning::LightVertices::kMostHits} : 1;
    const double parts = std::floor(std::clamp(brightness(beam_.power) / all_.pathPower(), 1., most));
    beam_.power = beam_.power / parts;
    const Beam beam = beam_;
    const Past past = past_;
    for (int i = 1; i < parts; ++i) {
      if (reflect(at)) follow(course);
      beam_ = beam;
      past_ = past;
    }
    if (!reflect(at)) break;
  }
}

// Whether a light path enters the room through a portal. It ends there, because paths that start on the
// portal carry this light.
bool LightVertices::Path::entersAgain(const Hit& hit) const {
  return all_.surfaces_.portals().lineLeaves(beam_.origin + hit.distance * beam_.direction, -beam_.direction,
                                             hit.distance);
}

bool LightVertices::Path::leave(double where) {
  if (where < all_.starts_.shareOfSky) {
    const SkyEmission::Leaving way = all_.starts_.onPortals.leave(
        where / all_.starts_.shareOfSky, prepared_.options().ambientBounces, random_, *outdoors_);
    beam_.origin = way.origin;
    beam_.direction = way.direction;
    beam_.power = way.power;
    past_.way = LightVertex::unweighed;  // places in view sample portals for this light
    past_.fromSource = false;
    past_.bounces = way.bounces;
    return true;
  }
  past_.source =
      all_.starts_.onSources.sourceAt((where - all_.starts_.shareOfSky) / (1 - all_.starts_.shareOfSky));
  if (past_.source == kNone) return false;
  if (!prepared_.lights().all()[past_.source].isDistant())
    beam_.start = prepared_.lights().all()[past_.source].surface;
  const SourceEmission::Leaving way = all_.starts_.onSources.leave(past_.source, start_.numbers, scratch_);
  beam_.origin = way.from.point + 2 * prepared_.scene().samePlace * way.from.normal;
  beam_.direction = way.direction;
  past_.cosineAtSource = way.from.normal.dot(beam_.direction);
  beam_.power = way.power;
  past_.way = all_.starts_.onSources.isEven(past_.source) ? LightVertex::direct : LightVertex::unweighed;
  return true;
}

// Continues the path through a pane, or reflects it there. Returns false if the path ends.
bool LightVertices::Path::passPane(const Hit& hit) {
  Interaction view = plainInteraction(beam_.direction, hit.normal, true);
  if (losesCaustics()) view.kinds = kShadow;  // no reflection
  const Scattering s = scatter(*all_.surfaces_.finishOf(hit.surface).pane, view);
  double left = random_.uniform() * brightness(beam_.power);
  for (const SharpPath& next : s.sharp) {
    const double share = brightness(beam_.power * next.coefficient);
    if ((left -= share) >= 0) continue;
    beam_.power = beam_.power * next.coefficient * (brightness(beam_.power) / share);
    if (next.kind == kReflected) {
      beam_.direction = next.direction;
      reflectedSharply();
    }
    return true;
  }
  return false;
}

// Reflects the path at a mirror; returns false if it ends. It ends at the black back of a mirror. A path that
// comes directly from its source also ends at curved mirrors, which make no images of sources, and at mirrors
// whose image of the source is left to paths from the eye.
bool LightVertices::Path::meetMirror(const Hit& hit, Course& course) {
  if (hit.cosine <= 0) return false;
  const LightId image =
      past_.fromSource ? all_.starts_.onSources.imageOf(past_.source, hit.surface) : LightId();
  course.leftToEye = image != kNone && !all_.surfaces_.knows(image);
  if (course.leftToEye || (losesCaustics() && image == kNone)) return false;
  const Scattering s = scatter(*all_.surfaces_.finishOf(hit.surface).mirror,
                               plainInteraction(beam_.direction, hit.normal, false));
  const SharpPath& next = s.sharp.path[0];
  const double share = brightness(beam_.power * next.coefficient) / brightness(beam_.power);
  if (random_.uniform() >= share) return false;
  beam_.power = beam_.power * next.coefficient / share;
  beam_.direction = next.direction;
  if (image != kNone) {
    past_.source = image;
    past_.way = LightVertex::unweighed;
    return true;
  }
  reflectedSharply();
  return true;
}

void LightVertices::Path::arrive(const PlainPlace& at) {
  const Opaque& m = *at.material;
  Irradiance arriving(beam_.power.color * at.color());
  if (past_.fromSource) arriving *= enteringShare(m, -at.normal.dot(beam_.direction));
  const double reflected = std::abs(brightness(arriving)) * (1 - m.specularity);
  addVisible(at, reflected);
  if (!(reflected > 0) || past_.bounces + 1 > prepared_.options().ambientBounces) return;
  all_.all_.push_back(vertexAt(at, reflected, past_.bounces + 1, past_.way, start_.batch));
  all_.arriving_.push_back({std::move(arriving), at.material});
}

void LightVertices::Path::addVisible(const PlainPlace& at, double reflected) {
  if (past_.bounces > prepared_.options().ambientBounces) return;
  const bool direct = past_.way == LightVertex::direct;
  const bool diffuse = past_.way == LightVertex::diffuse;
  if (past_.way == LightVertex::unweighed) return;
  if (diffuse &&
      (past_.senderIsUnbounded || !(all_.near_.closeShare(beam_.length, all_.near_.meanLength) > 0)))
    return;
  if (!(reflected > 0) && !(direct && hasRoughHighlight(*at.material))) return;
  const Irradiance power = direct ? beam_.power : Irradiance(beam_.power.color * at.color());
  all_.visible_.add({vertexAt(at, reflected, past_.bounces + 1, past_.way, start_.batch), power,
                     beam_.direction, at.material, at.pattern, at.flat, beam_.length, at.normal, past_.source,
                     past_.cosineAtSource});
}

// Selects diffuse reflection, specular reflection or the end of the path, with probabilities proportional to
// power. Returns false if the path ends.
bool LightVertices::Path::reflect(const PlainPlace& at) {
  const Opaque& m = *at.material;
  const Interaction view = plainInteraction(beam_.direction, at.normal, at.flat, at.pattern);
  const Scattering s = scatter(m, view, 0);
  const bool isSharp = s.sharp.count > 0;
  const auto strength = [&](const Color& share) {
    return std::abs(brightness(Irradiance(beam_.power.color * share)));
  };
  const double all = std::abs(brightness(beam_.power));
  const double diffuse =
      past_.bounces < prepared_.options().ambientBounces ? strength(s.diffuseReflection) : 0;
  const Color& gloss = isSharp ? s.sharp.path[0].coefficient.color : s.specularReflection;
  const double specular = isSharp && losesCaustics() ? 0 : strength(gloss);
  const double chosen = random_.uniform() * std::max(all, diffuse + specular);
  if (chosen >= diffuse + specular) return false;
  // The power is divided by the probability of the choice.
  if (chosen >= diffuse) return reflectSpecularly(s, view, std::max(all, diffuse + specular) / specular);
  double scale = std::max(all, diffuse + specular) / diffuse;
  if (past_.fromSource) scale *= enteringShare(m, view.cosine);
  beam_.direction = sentFrom(at.normal, random_);
  beam_.power =
      Irradiance(beam_.power.color * at.color() * (diffuseShare(m, at.normal.dot(beam_.direction)) * scale));
  past_.senderIsMirrored = past_.way == LightVertex::mirrored;
  past_.senderIsUnbounded = LightVertex::isUnbounded(past_.way);
  past_.way = LightVertex::diffuse;
  past_.fromSource = false;
  ++past_.bounces;
  return std::abs(brightness(beam_.power)) > 0;
}

bool LightVertices::Path::reflectSpecularly(const Scattering& s, const Interaction& view, double scale) {
  if (s.sharp.count > 0) {
    beam_.direction = s.sharp.path[0].direction;
    beam_.power = beam_.power * s.sharp.path[0].coefficient * scale;
    reflectedSharply();
  } else {
    past_.way = past_.fromSource ? LightVertex::highlight : LightVertex::sharp;
    past_.bounces += past_.fromSource;  // a highlight is indirect light at the next surface
    past_.fromSource = false;
    const double u1 = random_.uniform(), u2 = random_.uniform();
    // The lobe is reciprocal, so that it can be sampled from this side.
    const double weight = sampleReflection(s, view, 1, u1, u2, beam_.direction);
    beam_.power = Irradiance(beam_.power.color * s.specularReflection * (weight * scale));
  }
  return std::abs(brightness(beam_.power)) > 0;
}

double LightVertices::shadowRaysTo(const VisibleVertex& v) const {
  std::atomic<double>& known = visible_.shadowRaysTo(v);
  if (const double rays = known.load(std::memory_order_relaxed); rays > 0) return rays;
  std::vector<double> weights;
  const double chance = chanceOf(v.source, surfaces_, v.vertex.point(), v.normal, weights);
  SourceSample same;
  same.direction = -v.direction;
  same.distance = v.length;
  same.cosine = v.cosineAtSource;
  same.source = v.source;
  const double rays = starts_.onSources.shadowRaysOver(same, v.vertex.point(), v.normal, chance);
  known.store(rays, std::memory_order_relaxed);
  return rays;
}

double LightVertices::shareOfSky(const PlainSurfaces& surfaces) {
  if (surfaces.portals().empty()) return 0;
  return surfaces.coverage().anySource ? .5 : 1;
}

LightVertices::Starts::Starts(SourceEmission emission, const Portals& portals, double share, size_t paths)
    : onSources(std::move(emission)),
      shareOfSky(share),
      onPortals(portals, share * static_cast<double>(paths)),
      pathPower(share * onPortals.pathPower() + (1 - share) * onSources.pathPower()) {}

LightVertices::LightVertices(const PreparedScene& prepared, const PlainSurfaces& surfaces,
                             SourceEmission emission, size_t paths, uint64_t seed,
                             const OutdoorParts* outdoors)
    : surfaces_(surfaces), starts_(std::move(emission), surfaces.portals(), shareOfSky(surfaces), paths) {
  near_ = measured(prepared, paths, seed, outdoors);
  const auto count = static_cast<double>(paths);
  size_t met = 0, metUnknown = 0;
  bool leftToEye = surfaces.portals().empty() && !surfaces.coverage().allSources;
  for (size_t i = 0; i < paths; ++i) {
    // Stratified, so that batches have nearly equal numbers of paths from each source.
    const double where = (static_cast<double>(i) + Random(mixBits(seed ^ i)).uniform()) / count;
    const Path::Course course = Path(prepared, *this, i, seed, outdoors).send(where);
    met += course.met;
    metUnknown += course.metUnknown;
    leftToEye = leftToEye || course.leftToEye;
  }
  sort();
  visible_.sort(prepared);
  if (met > 0 && !leftToEye)
    shareOfRest_ = std::clamp(
        static_cast<double>(metUnknown) / static_cast<double>(met) / tuning::VertexLight::kFollowed,
        tuning::VertexLight::kFollowed / 2, 1.);
}

// The distances depend on the size of the room, which is estimated by the mean length of first segments.
NearLight LightVertices::measured(const PreparedScene& prepared, size_t paths, uint64_t seed,
                                  const OutdoorParts* outdoors) {
  const size_t tried = std::min(paths, tuning::LightVertices::kMeasured);
  double sum = 0;
  size_t met = 0;
  for (size_t i = 0; i < tried; ++i) {
    const double where = (static_cast<double>(i) + .5) / static_cast<double>(tried);
    const double length = Path(prepared, *this, i, ~seed, outdoors).send(where).firstLength;
    sum += length;
    met += length > 0;
  }
  // A twentieth more than expected, so that hardly any list grows while all paths are sent.
  const double times = 1.05 * static_cast<double>(paths) / static_cast<double>(std::max(tried, size_t(1)));
  const double mirrored =
      times * static_cast<double>(std::ranges::count(visible_.all(), LightVertex::mirrored,
                                                     [](const VisibleVertex& v) { return v.vertex.way; }));
  clearFor(times, all_);
  clearFor(times, arriving_);
  visible_.clearFor(times);
  const double meanLength = met > 0 ? sum / static_cast<double>(met) : 1;
  const double width = tuning::LightVertices::kWidth * meanLength;
  // The mean distance between the vertices of mirrored light, if they lay on a sphere of the mean length.
  const double apart = meanLength * std::sqrt(4 * kPi / mirrored);
  return {width, meanLength, std::min(width, apart)};
}

void LightVertices::sort() {
  VertexClusters::Order clustered = VertexClusters::orderOf(all_, !surfaces_.portals().empty());
  permute(all_, clustered.vertices);
  permute(arriving_, clustered.vertices);
  ends_ = std::move(clustered.ends);
}

void VisibleVertices::clearFor(double times) { rsphere::clearFor(times, all_); }

void VisibleVertices::sort(const PreparedScene& prepared) {
  permute(all_, orderByPlace(all_.size(), [&](size_t i) { return all_[i].vertex.point(); }));
  shadowRays_ = std::vector<std::atomic<double>>(all_.size());
  // Boxes are only made if light sources are hidden from some regions. In other scenes, few regions are
  // hidden from each other.
  if (!prepared.lights().hidden().divides()) return;
  std::vector<Box3d> boxes((all_.size() + kBlock - 1) / kBlock);
  for (size_t i = 0; i < all_.size(); ++i) boxes[i / kBlock].extendBy(all_[i].vertex.point());
  hidden_.emplace(prepared.lights().hidden().blockers(), std::move(boxes), 0);
}

void VisibleVertices::from(const V3d& point, FunctionRef<void(size_t begin, size_t end)> use) const {
  if (!hidden_) return use(0, all_.size());
  for (const uint32_t block : hidden_->notHiddenFrom(point))
    use(block * kBlock, std::min((block + 1) * kBlock, all_.size()));
}

double NearLight::closeShare(double distance, double fromEye) const {
  const double close = tuning::LightVertices::kWidth * std::min(meanLength, fromEye);
  const double share = close * close / (distance * distance + close * close);
  // The light of places next to the eye is left to rays. Glances are dense there, but light vertices are a
  // few centimeters apart: without a vertex nearby, most answers would miss this light.
  return std::max(0., (share - tuning::LightVertices::kRest) / (1 - tuning::LightVertices::kRest)) *
         (1 - this->share(fromEye));
}

}  // namespace rsphere
