#include "light_paths/source_emission.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "light_paths/tuning.h"

namespace rsphere {
namespace {

const Distant& distantOf(const Scene& scene, const LightSource& light) {
  return *scene.surfaces[light.surface].shape.as<Distant>();
}

}  // namespace

SourceEmission::SourceEmission(const PreparedScene& prepared, const PlainSurfaces& surfaces, size_t paths)
    : prepared_(prepared), surfaces_(surfaces), paths_(paths) {
  const Scene& scene = prepared.scene();
  const auto& lights = prepared.lights().all();
  senders_.resize(lights.size());
  for (const LightId i : lights.ids()) {
    Sender& s = senders_[i];
    if (!surfaces.knows(i) || lights[i].isVirtual()) continue;
    if (lights[i].isDistant()) {
      s.even = true;
      s.area = areaTowards(surfaces.portals().all(), -lights[i].center);
      s.power = brightness(*prepared.lights().constantRadiance(i)) * distantOf(scene, lights[i]).solidAngle *
                s.area;
      continue;
    }
    s.area = areaOf(scene.surfaces[lights[i].surface].shape, scene.vertices);
    s.even = prepared.lights().constantRadiance(i) && !lights[i].spot;
    s.power = s.even ? powerOf(scene, lights[i], 0) : triedPower(i);
  }
  share();
}

// Divides the paths among the sources by power and preference.
void SourceEmission::share() {
  double sum = 0, power = 0;
  for (Sender& s : senders_) {
    s.upTo = sum += s.power * s.factor;
    power += s.power;
  }
  if (!(sum > 0)) return;
  const auto paths = static_cast<double>(paths_);
  for (Sender& s : senders_) {
    s.upTo = s.upTo < sum ? s.upTo / sum : 1;
    s.factor *= power / sum;
    if (s.even && s.area > 0) s.density = s.power * s.factor / s.area * paths / power;
  }
  pathPower_ = power / paths;
}

SourceEmission SourceEmission::preferring(std::span<const uint32_t> preferred) const {
  SourceEmission changed = *this;
  ById<LightId, bool> isPreferred(senders_.size(), false);
  for (const uint32_t i : preferred) {
    LightId source(i);
    while (prepared_.lights().all()[source].isVirtual()) source = prepared_.lights().all()[source].relayed;
    isPreferred[source] = true;
  }
  double own = 0, others = 0;
  for (const LightId i : senders_.ids()) (isPreferred[i] ? own : others) += senders_[i].power;
  if (!(own > 0)) return changed;
  // Three of four paths come from preferred sources. The other sources keep at least a quarter of their
  // paths, which at most doubles their noise.
  const double factor = std::max(1., 3 * others / own);
  for (const LightId i : senders_.ids()) changed.senders_[i].factor = isPreferred[i] ? factor : 1;
  changed.share();
  return changed;
}

LightId SourceEmission::sourceAt(double share) const {
  // A value of 1 may lie beyond the last source.
  const auto sender = std::ranges::upper_bound(senders_, share, {}, &Sender::upTo);
  return sender == senders_.end() ? LightId() : LightId(static_cast<size_t>(sender - senders_.begin()));
}

SourceEmission::Leaving SourceEmission::leave(LightId source, ScrambledPoint& random,
                                              FunctionScratch& scratch) const {
  const Sender& sender = senders_[source];
  if (prepared_.lights().all()[source].isDistant()) return leaveDistant(source, random);
  const size_t tries = sender.even ? 1 : tuning::VertexLight::kCandidates;
  Leaving chosen;
  double sum = 0;
  for (size_t i = 0; i < tries; ++i) {
    const Candidate tried = candidate(source, random, scratch);
    const double bright = std::max(0., brightness(tried.radiance)) * tried.weight;
    sum += bright;
    if (!(bright > 0) || (tries > 1 && random.uniform() * sum >= bright)) continue;
    chosen = {tried.from, tried.direction,
              Irradiance(tried.radiance.color * (pathPower_ / (sender.factor * brightness(tried.radiance))))};
  }
  if (!sender.even)
    chosen.power = chosen.power * (kPi * sender.area * sum / (static_cast<double>(tries) * sender.power));
  return chosen;
}

SourceEmission::Leaving SourceEmission::leaveDistant(LightId source, ScrambledPoint& random) const {
  const Sender& sender = senders_[source];
  const LightSource& light = prepared_.lights().all()[source];
  const Portals& portals = surfaces_.portals();
  const V3d towards = withinCone(light.center, distantOf(prepared_.scene(), light).solidAngle, random);
  const double area = areaTowards(portals.all(), -towards);
  Leaving way;
  way.direction = way.from.normal = -towards;
  if (!(area > 0)) return way;
  const double u1 = random.uniform(), u2 = random.uniform(), u3 = random.uniform();
  const V3d at = pointTowards(portals.all(), way.direction, u1, u2, u3);
  way.from.point = at;
  const Radiance& radiance = *prepared_.lights().constantRadiance(source);
  way.power = Irradiance(radiance.color * surfaces_.passingToSource(at, towards, kFarAway, kNone).color *
                         (pathPower_ / (sender.factor * brightness(radiance)) * area / sender.area));
  return way;
}

template <class Numbers>
SourceEmission::Candidate SourceEmission::candidate(LightId source, Numbers& random,
                                                    FunctionScratch& scratch) const {
  const LampWay way = wayFrom(prepared_.scene(), prepared_.lights().all()[source], random);
  return {way, surfaces_.radianceOf(source, way.from.point, way.from.normal, -way.direction, scratch)};
}

// Estimates the power of a source that is not even, from random directions. One more direction is assumed to
// show the source without patterns, so that the result is above 0 even if the random directions miss all of
// its light.
double SourceEmission::triedPower(LightId source) const {
  Random random(mixBits(source.index()));
  FunctionScratch scratch;
  double sum = 0;
  for (size_t i = 0; i < tuning::LightVertices::kMeasured; ++i) {
    const Candidate tried = candidate(source, random, scratch);
    sum += std::max(0., brightness(tried.radiance)) * tried.weight;
  }
  const Scene& scene = prepared_.scene();
  const double plain =
      brightness(sourceRadiance(scene, scene.surfaces[prepared_.lights().all()[source].surface]));
  return kPi * senders_[source].area * (sum + plain) / tuning::LightVertices::kMeasured;
}

double SourceEmission::divergence(LightId source, double distance) const {
  const auto& spot = prepared_.lights().all()[source].spot;
  if (!spot) return 1;
  const double nearer = distance / (distance + spot->focalLength);
  return nearer * nearer;
}

LightId SourceEmission::imageOf(LightId source, SurfaceId mirror) const {
  const auto& lights = prepared_.lights().all();
  for (const LightId i : lights.ids())
    if (lights[i].relayed == source && lights[i].surface == mirror) return i;
  return kNone;
}

double SourceEmission::shadowRaysOver(const SourceSample& sample, const V3d& place, const V3d& normal,
                                      double probability) const {
  if (prepared_.lights().all()[sample.source].isDistant()) {
    const Sender& sender = senders_[sample.source];
    const double lightPaths = sender.density * sender.area * normal.dot(sample.direction);
    return lightPaths > 0
               ? probability * areaTowards(surfaces_.portals().all(), -sample.direction) / lightPaths
               : 0;
  }
  const double cosine = std::abs(sample.cosine), d = sample.distance;
  const double lightPaths =
      senders_[sample.source].density * cosine / kPi * normal.dot(sample.direction) / (d * d);
  return lightPaths > 0 ? probability * prepared_.lights().density(sample, place) / lightPaths : 0;
}

double SourceEmission::lobesOver(const SourceSample& sample, const V3d& normal, double density) const {
  // Both densities have the factor cosine / d^2 at the source.
  const double lightPaths = senders_[sample.source].density * normal.dot(sample.direction) / kPi;
  return lightPaths > 0 ? density / lightPaths : 0;
}

}  // namespace rsphere
