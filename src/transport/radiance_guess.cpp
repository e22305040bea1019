#include "transport/radiance_guess.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/constants.h"
#include "light/tuning.h"
#include "transport/tuning.h"

namespace rsphere {
namespace {

// Cap on the number of sources that are guessed separately. Those that contribute most are kept; the others
// are included in the ambient light.
const size_t kMostLights = tuning::Caps::kAimed / 2;

// Irradiance from a triangle or parallelogram of radiance 1, clipped at the horizon, by Lambert's formula.
// corners: relative to the place. normal: at the place, unit.
template <size_t N>
double irradianceFrom(const std::array<V3d, N>& corners, const V3d& normal) {
  std::array<V3d, 2 * N> kept;
  size_t n = 0;
  for (size_t i = 0; i < N; ++i) {
    const V3d &a = corners[i], &b = corners[(i + 1) % N];
    const double atA = normal.dot(a), atB = normal.dot(b);
    if (atA > 0) kept[n++] = a;
    if ((atA > 0) != (atB > 0)) kept[n++] = a + (b - a) * (atA / (atA - atB));
  }
  double sum = 0;
  for (size_t i = 0; i < n; ++i) {
    const V3d across = kept[i].cross(kept[(i + 1) % n]);
    const double sine = across.length();
    if (sine > 0) sum += std::atan2(sine, kept[i].dot(kept[(i + 1) % n])) * normal.dot(across) / sine;
  }
  return std::abs(sum) / 2;
}

// The irradiance at a point from a polygon, divided into triangles around its first vertex.
double irradianceFromFan(std::span<const V3d> v, const V3d& point, const V3d& normal) {
  double sum = 0;
  for (size_t i = 2; i < v.size(); ++i)
    sum += irradianceFrom<3>({v[0] - point, v[i - 1] - point, v[i] - point}, normal);
  return sum;
}

double middleOf(std::vector<double>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

RadianceGuess::RadianceGuess(const PreparedScene& prepared, const ById<SurfaceId, bool>& unguessed)
    : prepared_(prepared), unguessed_(unguessed) {
  const Scene& scene = prepared.scene();
  for (const Finish& finish : scene.surfaces.finishes()) {
    Coefficient& reflectance = reflectance_.emplace_back();
    const Material* material = scene.materialAt(finish.material);
    if (!material) continue;
    if (const auto diffuse = diffuseReflection(*material))
      reflectance = Coefficient(diffuse->color * diffuse->share);
  }
  const auto& lights = prepared.lights().all();
  for (const LightId i : lights.ids()) {
    if (lights[i].isVirtual()) continue;
    const Radiance radiance = sourceRadiance(scene, scene.surfaces[lights[i].surface]);
    if (brightness(radiance) > 0) lights_.push_back({i, radiance, 0});
  }
}

RadianceGuess::Place RadianceGuess::placeAlong(const V3d& point, const V3d& direction) const {
  return placeOf(point, direction, prepared_.tracer().nearest(point, direction));
}

RadianceGuess::Place RadianceGuess::placeOf(const V3d& point, const V3d& direction, const Hit& hit) const {
  if (hit.surface == kNone) return {};
  const uint32_t finish = prepared_.scene().surfaces.face(hit.surface).finish;
  return {point + hit.distance * direction, hit.normal.dot(direction) > 0 ? -hit.normal : hit.normal,
          unguessed_[hit.surface] ? Coefficient() : reflectance_[finish]};
}

static_assert(kLightForms == 8, "Does it shine to one side only?");
// Unoccluded irradiance from a source of radiance 1 (sr).
double RadianceGuess::factor(LightId source, const Place& at) const {
  const LightSource& light = prepared_.lights().all()[source];
  if (const auto* cone = light.as<DistantLight>())
    return 2 * kPi * (1 - cone->cosHalfAngle) * std::max(0., at.normal.dot(light.center));
  const V3d to = light.center - at.point;
  if (at.normal.dot(to) <= -light.radius) return 0;
  if (const auto* plane = light.as<PlaneLight>(); plane && !(plane->normal.dot(to) < 0)) return 0;
  const double squared = to.length2(), distance = std::sqrt(squared);
  if (light.reach > 0 && distance - light.radius > light.reach) return 0;
  if (light.spot && outsideSpot(*light.spot, to / distance)) return 0;
  const double cosine = std::max(0., at.normal.dot(to) / distance);
  const auto ofPlane = [&](const PlaneLight& plane) -> double {
    const double front = -plane.normal.dot(to) / distance;
    if (!(front > 0)) return 0;
    const V3d &u = plane.u, &v = plane.v;
    return match(
        plane.map,
        [&](const PlaneLight::Disk&) { return plane.area * cosine * front / (squared + plane.area / kPi); },
        [&](const PlaneLight::Fan& fan) { return irradianceFromFan(fan.vertices, at.point, at.normal); },
        [&](const OneOf<PlaneLight::Parallelogram, PlaneLight::Square> auto&) {
          const double width = 2 * std::max(plane.extentU, plane.extentV);
          if (width <= tuning::SourceParts::kNear * distance) return plane.area * cosine * front / squared;
          return irradianceFrom<4>({to - u - v, to + u - v, to + u + v, to - u + v}, at.normal);
        });
  };
  return match(
      light.shape, ofPlane,
      [&](const BallLight&) {
        return kPi * light.radius * light.radius * cosine / std::max(squared, light.radius * light.radius);
      },
      [&](const TubeLight& tube) { return tube.area * cosine / (squared + tube.area / kPi); },
      [](const DistantLight&) { return 0.; });
}

double RadianceGuess::sent(const Light& light, const Place& at) const {
  return factor(light.source, at) / kPi * brightness(light.radiance * at.reflectance);
}

// Whether the middle of a source is visible from the place.
bool RadianceGuess::isSeen(const Place& at, LightId source) const {
  const LightSource& light = prepared_.lights().all()[source];
  const V3d to = light.isDistant() ? light.center : light.center - at.point;
  const double distance = to.length();
  return at.normal.dot(to) > 0 &&
         prepared_.tracer().shadow(at.point, to / distance, light.isDistant() ? kFarAway : distance,
                                   light.surface) != Shadow::blocked;
}

// The mean visibility of a light from the places, weighted by sent. sent: brightness that each place would
// reflect if the light were not occluded.
double RadianceGuess::shareThatArrives(const Light& light, std::span<const double> sent,
                                       std::span<const Place> places, Random& random) const {
  double sum = 0;
  for (const double s : sent) sum += s;
  const SurfaceId surface = prepared_.lights().all()[light.source].surface;
  std::vector<SourceSample> samples;
  int asked = 0, arrived = 0;
  double due = random.uniform();
  for (size_t i = 0; i < places.size(); ++i) {
    const Place& at = places[i];
    due += sent[i] / sum * tuning::Caps::kProbes;
    if (due < 1) continue;
    due -= std::floor(due);
    samples.clear();
    prepared_.lights().sample(light.source, at.point, {0, 1, at.normal, false, true}, random, samples);
    ++asked;
    if (samples.empty()) continue;
    const SourceSample& s = samples[0];
    arrived += prepared_.tracer().shadow(at.point, s.direction, s.distance, surface) != Shadow::blocked;
  }
  return asked ? static_cast<double>(arrived) / asked : 0;
}

LocalGuess RadianceGuess::fit(const V3d& point, std::span<const V3d> glances, std::span<const Traced> traced,
                              uint64_t seed) const {
  LocalGuess local(*this);
  Random random(seed);
  std::vector<Place> places;
  for (const V3d& direction : glances) {
    const Place at = placeAlong(point, direction);
    if (brightness(at.reflectance) > 0) places.push_back(at);
  }
  std::vector<std::pair<double, size_t>> order;
  std::vector<double> back(lights_.size() * places.size());
  for (size_t i = 0; i < lights_.size(); ++i) {
    double sum = 0;
    for (size_t k = 0; k < places.size(); ++k)
      sum += back[i * places.size() + k] = sent(lights_[i], places[k]);
    if (sum > 0) order.push_back({-sum, i});
  }
  std::sort(order.begin(), order.end());
  if (order.size() > kMostLights) order.resize(kMostLights);
  double arriving = 0;
  for (const auto& [sum, i] : order) {
    Light light = lights_[i];
    light.share =
        shareThatArrives(light, std::span(back).subspan(i * places.size(), places.size()), places, random);
    if (!(light.share > 0)) continue;
    local.lights_.push_back(light);
    arriving += light.share * -sum;
  }
  local.bright_ =
      tuning::RadianceGuess::kBright * arriving / static_cast<double>(std::max<size_t>(1, glances.size()));
  // Uses the median instead of the mean, because a few directions hit something very bright by chance.
  std::vector<double> around[3];
  Color parts;  // light of each contributor; the median is divided among contributors in this proportion
  for (const Traced& t : traced) {
    const Place& at = t.place;
    if (!(brightness(at.reflectance) > 0)) continue;
    const Color rest = (t.radiance - local.direct(at)).color, reflectance = at.reflectance.color;
    for (int c = 0; c < 3; ++c)
      if (reflectance[c] > 0) around[c].push_back(rest[c] / reflectance[c]);
    parts += t.radiance.color;
  }
  for (int c = 0; c < 3; ++c) local.ambient_.color[c] = std::max(0., middleOf(around[c]));
  if (parts.bands()) local.ambient_.color = local.ambient_.color.dividedAs(parts);
  return local;
}

Radiance LocalGuess::direct(const Place& at) const {
  Radiance sum;
  for (const Light& light : lights_) {
    const double irradiance = guess_->factor(light.source, at);
    if (!(irradiance > 0)) continue;
    const Color &arriving = light.radiance.color, &reflectance = at.reflectance.color;
    const double perPi = irradiance / kPi;
    const bool bright = brightness(Color(arriving.rgb() * reflectance.rgb() * perPi)) > bright_;
    sum.color.addProduct(arriving, reflectance, perPi,
                         bright ? guess_->isSeen(at, light.source) : light.share);
  }
  return sum;
}

Radiance LocalGuess::from(const Place& at) const {
  if (!(brightness(at.reflectance) > 0)) return {};
  return direct(at) + ambient_ * at.reflectance;
}

Radiance LocalGuess::along(const V3d& point, const V3d& direction) const {
  return from(guess_->placeAlong(point, direction));
}

}  // namespace rsphere
