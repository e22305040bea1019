#include "light_paths/vertex_light.h"

#include <algorithm>
#include <cmath>

#include "base/colorimetry.h"
#include "base/constants.h"
#include "light_paths/tuning.h"
#include "rays/shared_highlights.h"
#include "shade/scattering.h"
#include "spots/light_particles.h"

namespace rsphere {
namespace {

// Selects one of `count` with probabilities proportional to weights. Returns count if all weights are 0.
template <class WeightOf>
size_t chooseOne(size_t count, double sum, const WeightOf& weightOf, Random& random) {
  double left = random.uniform() * sum;
  size_t chosen = count;
  for (size_t i = 0; i < count; ++i) {
    const double weight = weightOf(i);
    if (!(weight > 0)) continue;
    chosen = i;
    if ((left -= weight) < 0) break;
  }
  return chosen;
}

// Only made if light sources are hidden from some regions. In other scenes, few regions are hidden from each
// other.
std::optional<HiddenBoxes> hiddenClusters(const PreparedScene& prepared, const LightVertices& vertices) {
  if (!prepared.lights().hidden().divides()) return {};
  return HiddenBoxes(prepared.lights().hidden().blockers(),
                     VertexClusters::boxesOf(vertices.all(), vertices.clusterEnds()), 0);
}

// The next hit along a line that panes and mirrors may reflect.
struct Meeting {
  Hit hit;
  double distance = 0;  // of the hit, or of the portal
  bool leaves = false;  // through a portal, at this distance
  bool goesOn = false;  // from a pane or a mirror, in the direction `next` (unit)
  bool isReflected = false;
  V3d next{0, 0, 0};
  Coefficient passed{1};  // fraction of the light, divided by the probability of this direction
};

// Follows a line to its next hit, up to a portal. At a pane, it is reflected or transmitted at random.
// mirrored: whether it has been reflected before; if not, it is reflected with a probability of at least one
// half.
Meeting meet(const PreparedScene& prepared, const PlainSurfaces& surfaces, const V3d& origin,
             const V3d& direction, SurfaceId start, bool mirrored, Random& random) {
  const double leaving = surfaces.portals().leaving(origin, direction, kFarAway);
  Meeting met;
  met.hit = prepared.tracer().nearest(origin, direction, std::min(leaving, kFarAway), start);
  met.distance = met.hit.surface == kNone ? leaving : met.hit.distance;
  met.leaves = met.hit.surface == kNone && leaving < kFarAway;
  if (met.hit.surface == kNone || met.hit.perturbation != V3d(0, 0, 0)) return met;
  const PlainFinish& finish = surfaces.finishOf(met.hit.surface);
  if (!finish.pane && !(finish.mirror && met.hit.cosine > 0)) return met;
  const Interaction view = plainInteraction(direction, met.hit.normal, finish.pane != nullptr);
  const Scattering s = finish.pane ? scatter(*finish.pane, view) : scatter(*finish.mirror, view);
  double reflected = 0;  // probability
  for (const SharpPath& path : s.sharp)
    if (path.kind == kReflected) reflected = maxChannel(path.coefficient);
  if (reflected > 0 && !mirrored) reflected = std::max(reflected, .5);
  double left = random.uniform();
  for (const SharpPath& path : s.sharp) {
    const bool isReflected = path.kind == kReflected;
    const double probability =
        isReflected ? reflected : std::min(maxChannel(path.coefficient), 1 - reflected);
    if ((left -= probability) >= 0) continue;
    met.goesOn = true;
    met.isReflected = isReflected;
    met.next = isReflected ? path.direction : direction;
    met.passed = path.coefficient * (1 / probability);
    break;
  }
  return met;
}

}  // namespace

VertexLight::VertexLight(const PreparedScene& prepared, const PlainSurfaces& surfaces,
                         SourceEmission emission, size_t paths, uint64_t seed, const OutdoorParts* outdoors)
    : prepared_(prepared),
      surfaces_(surfaces),
      vertices_(prepared, surfaces, std::move(emission), paths, seed, outdoors),
      clusters_(vertices_.all(), vertices_.clusterEnds(), vertices_.nearLight().width,
                !surfaces.portals().empty(), hiddenClusters(prepared, vertices_)) {}

void VertexLight::Record::add(uint8_t batch, const Irradiance& part, double notChosen) {
  batches[batch] += part;
  squares += part.color * part.color * notChosen;
  const double bright = photopicOf(part.color, sampling);
  squaredBrightness += bright * bright * notChosen;
}

// Selects one source and a sample of it. finest: -ds, where one of the parts is selected; 0: not divided.
VertexLight::Chosen VertexLight::chooseSource(const PlainPlace& at, double finest, Random& random,
                                              Scratch& scratch) const {
  auto& weights = scratch.weights;
  std::span<const uint32_t> sources;
  const double sum = surfaces_.weigh(at.point, at.normal, sources, weights);
  const size_t source = chooseOne(
      weights.size(), sum, [&](size_t i) { return weights[i]; }, random);
  if (source == weights.size()) return {};
  auto& samples = scratch.samples;
  samples.clear();
  prepared_.lights().sample(LightId(sources[source]), at.point, {finest, 1, at.normal}, random, samples);
  const auto arrives = [&](size_t i) {
    const double cosine = at.normal.dot(samples[i].direction);
    return samples[i].cosine > 0 && cosine > kNegligible ? cosine * samples[i].solidAngle : 0;
  };
  double all = 0;
  for (size_t i = 0; i < samples.size(); ++i) all += arrives(i);
  const size_t part = chooseOne(samples.size(), all, arrives, random);
  if (part == samples.size()) return {};
  return {samples[part], weights[source] / sum * arrives(part) / all};
}

// The transmittance between the place and a source sample; black if occluded.
Coefficient VertexLight::passing(const PlainPlace& at, const SourceSample& sample) const {
  if (!bringLightOf(sample.source, prepared_, surfaces_, at.point, sample.direction)) return {};
  const LightSource& light = prepared_.lights().all()[sample.source];
  const SurfaceId source = light.isDistant() ? SurfaceId() : light.surface;
  switch (
      prepared_.tracer().shadow(at.point, sample.direction, sample.distance, source, nullptr, at.surface)) {
    case Shadow::clear: return Coefficient(1);
    case Shadow::blocked: return {};
    default:
      return light.isDistant()
                 ? surfaces_.passingToSource(at.point, sample.direction, sample.distance, at.surface)
                 : surfaces_.passing(at.point, at.point + sample.distance * sample.direction, at.surface);
  }
}

// The radiance of a source sample that arrives (W/sr/m2).
Radiance VertexLight::arriving(const PlainPlace& at, const SourceSample& sample,
                               FunctionScratch& scratch) const {
  if (prepared_.lights().all()[sample.source].isVirtual()) return arrivingByMirrors(at, sample, scratch);
  const Coefficient passed = passing(at, sample);
  if (isBlack(passed)) return {};
  const V3d point = at.point + sample.distance * sample.direction;
  return surfaces_.radianceOf(sample.source, point, sample.normal, sample.direction, scratch) * passed;
}

// arriving() for a virtual source. Black unless the path hits each mirror, and leaves through a portal to a
// distant source.
Radiance VertexLight::arrivingByMirrors(const PlainPlace& at, const SourceSample& sample,
                                        FunctionScratch& scratch) const {
  const auto& lights = prepared_.lights().all();
  V3d origin = at.point, direction = sample.direction;
  SurfaceId start = at.surface;
  Coefficient passed(1);
  for (LightId source = sample.source;; source = lights[source].relayed) {
    if (lights[source].isDistant() && !lights[source].isVirtual())
      return bringLightOf(source, prepared_, surfaces_, origin, direction)
                 ? *prepared_.lights().constantRadiance(source) * passed *
                       surfaces_.passingToSource(origin, direction, kFarAway, start)
                 : Radiance();
    const Sight sight = surfaces_.look(origin, direction, kFarAway, start);
    if (sight.hit.surface != lights[source].surface || sight.hit.cosine <= 0) return {};
    origin += sight.distance * direction;
    passed *= sight.passed;
    if (!lights[source].isVirtual())
      return surfaces_.radianceOf(source, origin, sight.hit.normal, direction, scratch) * passed;
    start = sight.hit.surface;
    const Scattering s =
        scatter(*surfaces_.finishOf(start).mirror, plainInteraction(direction, sight.hit.normal, true));
    passed *= s.sharp.path[0].coefficient;
    direction = s.sharp.path[0].direction;
  }
}

// Whether samples of the lobe estimate direct light, too. Shadow rays suffice for weak highlights.
bool VertexLight::samplesLobe(const PlainPlace& at) const {
  return surfaces_.portals().empty() && hasRoughHighlight(*at.material) &&
         at.material->specularity >= tuning::VertexLight::kStrong;
}

// Whether samples of lobes that hit a source estimate its light.
bool VertexLight::isFoundByLobes(LightId source) const {
  return sharesHighlights(prepared_, source) && vertices_.emission().isEven(source);
}

double VertexLight::lobesOver(const PlainPlace& at, const V3d& view, const SourceSample& sample) const {
  if (!samplesLobe(at) || !isFoundByLobes(sample.source)) return 0;
  const Interaction seen = plainInteraction(view, at.normal, at.flat, at.pattern);
  const double density = reflectedDensity(scatter(*at.material, seen, 0), seen, sample.direction);
  return vertices_.emission().lobesOver(sample, at.normal, density);
}

// The weight of a direct estimate by the balance heuristic, for light from one direction. shadowRays, lobes:
// densities of the two direct estimates, divided by the density of light paths; the result is the weight of
// the first.
double VertexLight::shareOf(const PlainPlace& at, const Seen& seen, const SourceSample& sample,
                            double shadowRays, double lobes) const {
  if (!(shadowRays > 0)) return 0;
  const double joined = seen.density > 0
                            ? std::min(1., seen.joins * joinedReflectance(*at.material, at.normal, seen.view,
                                                                          sample.direction)) /
                                  seen.density
                            : 0;
  return shadowRays / (shadowRays + lobes + joined);
}

Radiance VertexLight::directOf(const PlainPlace& at, const Seen& seen, Random& random,
                               Scratch& scratch) const {
  // The density is only known for samples of the whole source.
  const bool bySeveral = seen.density > 0 || samplesLobe(at);
  const double finest = bySeveral ? 0 : prepared_.options().sourceSubstructuring;
  const Radiance lobe = samplesLobe(at) ? ofLobe(at, seen, random, scratch) : Radiance();
  const Chosen to = chooseSource(at, finest, random, scratch);
  if (!(to.probability > 0)) return lobe;
  const Radiance arrives = arriving(at, to.sample, scratch.functions);
  if (isBlack(arrives)) return lobe;
  const double over =
      bySeveral ? vertices_.emission().shadowRaysOver(to.sample, at.point, at.normal, to.probability) : 0;
  const double share = over > 0 ? shareOf(at, seen, to.sample, over, lobesOver(at, seen.view, to.sample)) : 1;
  return lobe + arrives *
                    shownOfSource(at, seen.view, to.sample.direction, to.sample.solidAngle, seen.shown) *
                    (share / to.probability);
}

// The part of directOf() that a sample of the lobe estimates.
Radiance VertexLight::ofLobe(const PlainPlace& at, const Seen& seen, Random& random, Scratch& scratch) const {
  const Interaction view = plainInteraction(seen.view, at.normal, at.flat, at.pattern);
  const Scattering s = scatter(*at.material, view, 0);
  const double u1 = random.uniform(), u2 = random.uniform();
  SourceSample sample;
  if (!(sampleReflection(s, view, 1, u1, u2, sample.direction) > 0)) return {};
  const double density = reflectedDensity(s, view, sample.direction);
  if (!(density > 0)) return {};
  const Sight sight = surfaces_.look(at.point, sample.direction, kFarAway, at.surface);
  if (sight.hit.surface == kNone || !(sight.hit.cosine > 0)) return {};
  sample.source = prepared_.lights().of(sight.hit.surface);
  if (sample.source == kNone || !surfaces_.knows(sample.source) || !isFoundByLobes(sample.source)) return {};
  sample.distance = sight.distance;
  sample.cosine = sight.hit.cosine;
  const double lobes = vertices_.emission().lobesOver(sample, at.normal, density);
  if (!(lobes > 0)) return {};
  const double chance = chanceOf(sample.source, surfaces_, at.point, at.normal, scratch.weights);
  const double shadowRays = vertices_.emission().shadowRaysOver(sample, at.point, at.normal, chance);
  const V3d point = at.point + sample.distance * sample.direction;
  return surfaces_.radianceOf(sample.source, point, sight.hit.normal, sample.direction, scratch.functions) *
         sight.passed * shownOfSource(at, seen.view, sample.direction, 1 / density, seen.shown) *
         shareOf(at, seen, sample, lobes, shadowRays);
}

// The mean radiance that arrives over the hemisphere directly from sources (W/sr/m2).
Radiance VertexLight::directAt(const PlainPlace& at, Random& random, Scratch& scratch) const {
  const Chosen to = chooseSource(at, prepared_.options().sourceSubstructuring, random, scratch);
  if (!(to.probability > 0)) return {};
  const double cosine = at.normal.dot(to.sample.direction);
  return arriving(at, to.sample, scratch.functions) *
         (enteringShare(*at.material, cosine) * cosine * to.sample.solidAngle / (kPi * to.probability));
}

Radiance VertexLight::indirectAt(const PlainPlace& at, const Indirect& how, Random& random,
                                 Scratch& scratch) const {
  if (how.bounces < 1) return {};
  const Radiance far = ofVertices(at, how, random);
  Radiance near = far + ofNear(at, how, random, scratch);
  const bool mayMirror = how.fromEye > 0 && surfaces_.coverage().mirrors;
  if (mayMirror && random.uniform() >= vertices_.nearLight().joinedOfMirrored(how.fromEye))
    near += ofMirrored(at, how, random, scratch);
  return surfaces_.portals().empty() ? near : near + ofPortals(at, how, random);
}

// Light that enters through portals and arrives straight, or through panes.
Radiance VertexLight::ofPortals(const PlainPlace& at, const Indirect& how, Random& random) const {
  const PortalDirections::Sample ray =
      PortalDirections(surfaces_.portals(), at.point, at.normal).draw(random);
  if (!(ray.share > 0)) return {};
  const Sight sight = surfaces_.look(at.point, ray.direction, kFarAway, at.surface);
  if (!sight.leaves) return {};
  const int bounces = prepared_.options().ambientBounces - how.bounces + 1;
  return sight.passed *
         (*how.outdoors)(at.point + sight.distance * ray.direction, ray.direction, bounces, random) *
         ray.share;
}

// Resampled importance sampling: among candidates that are sampled from the clusters, some are selected for a
// shadow ray, with probabilities proportional to their unoccluded light.
Radiance VertexLight::ofVertices(const PlainPlace& at, const Indirect& how, Random& random) const {
  const VertexClusters::Candidates drawn = clusters_.draw({at.point, at.normal, how.bounces}, random);
  // The estimated light of all vertices that a candidate represents.
  const auto light = [&](size_t i) { return drawn.all[i].weight / drawn.all[i].drawn; };
  double all = 0;
  for (size_t i = 0; i < drawn.count; ++i) all += light(i);
  const double each = all / tuning::VertexLight::kJoined;
  double due = random.uniform();
  Radiance sum;
  for (size_t i = 0; i < drawn.count; ++i) {
    due += light(i) / each;
    if (due < 1) continue;
    const double times = std::floor(due);
    due -= times;
    const uint32_t vertex = drawn.all[i].vertex;
    const Radiance part = ofVertex(at, vertex) * (times * each / drawn.all[i].weight);
    sum += part;
    if (how.record && !isBlack(part))
      how.record->add(vertices_.all()[vertex].batch, Irradiance(part.color * how.scale.color), 1);
  }
  return sum;
}

// The contribution of one vertex to the mean radiance that arrives.
Radiance VertexLight::ofVertex(const PlainPlace& at, size_t i) const {
  const LightVertex& v = vertices_.all()[i];
  vertices_.powerOf(i).color.prefetch();
  const V3d to = v.point() - at.point;
  const double square = to.length2(), d = std::sqrt(square);
  const double here = to.dot(at.normal) / d, there = -to.dot(v.normal()) / d;
  // Excludes pairs of places on one wall, whose cosines are rounding errors.
  if (!(here > kNegligible) || !(there > kNegligible)) return {};
  const Coefficient passed = surfaces_.passing(at.point, v.point(), at.surface);
  if (isBlack(passed)) return {};
  const double bounded = v.isUnbounded() ? 1 : 1 - vertices_.nearLight().share(d);
  const double kernel =
      here * there / (kPi * kPi * square) * bounded * diffuseShare(vertices_.materialOf(i), there);
  return Radiance(vertices_.powerOf(i).color * passed.color * kernel);
}

Radiance VertexLight::ofNear(const PlainPlace& at, const Indirect& how, Random& random,
                             Scratch& scratch) const {
  const V3d direction = sentFrom(at.normal, random);
  const double u = random.uniform();
  const double farthest = u > 0 ? std::min(vertices_.nearLight().distanceOf(u), kFarAway) : kFarAway;
  if (!(farthest > prepared_.scene().samePlace)) return {};
  const Sight sight = surfaces_.look(at.point, direction, farthest, at.surface);
  if (sight.hit.surface == kNone) return {};
  const PlainPlace there = surfaces_.placeOf(at.point, direction, sight, scratch.functions);
  if (!there.material) return {};
  const double left = how.fromEye > 0 ? 1 - vertices_.nearLight().closeShare(sight.distance, how.fromEye) : 1;
  const Coefficient share(sight.passed.color * there.color() *
                          (left * diffuseShare(*there.material, -there.normal.dot(direction))));
  Radiance sum = diffusedAt(there, share, how, random, scratch);
  if (how.fromEye > 0 && hasRoughHighlight(*there.material))
    sum += sight.passed * directOf(there, {.view = direction, .shown = Shown::highlight}, random, scratch);
  return sum;
}

// The light that a place `there` reflects diffusely to another place. share: factor on the light that arrives
// there. how: of the other place.
Radiance VertexLight::diffusedAt(const PlainPlace& there, const Coefficient& share, const Indirect& how,
                                 Random& random, Scratch& scratch) const {
  Radiance sum = directAt(there, random, scratch);
  if (how.bounces > 1)
    sum +=
        indirectAt(there, {how.bounces - 1, 0, how.record, how.scale * share, how.outdoors}, random, scratch);
  return sum * share;
}

// The mirrored light (LightVertex::mirrored) that arrives, by one ray that panes, mirrors and polished
// surfaces reflect.
Radiance VertexLight::ofMirrored(const PlainPlace& at, const Indirect& how, Random& random,
                                 Scratch& scratch) const {
  constexpr int kMostHits = 32;  // for mirrors that face each other
  V3d origin = at.point;
  V3d direction = sentFrom(at.normal, random);
  SurfaceId start = at.surface;
  Coefficient passed(1);
  bool isMirrored = false;
  for (int hits = 0; hits < kMostHits; ++hits) {
    const Meeting met = meet(prepared_, surfaces_, origin, direction, start, isMirrored, random);
    origin += met.distance * direction;
    if (met.leaves) {
      const int bounces = prepared_.options().ambientBounces - how.bounces + 1;
      return isMirrored ? passed * (*how.outdoors)(origin, direction, bounces, random) : Radiance();
    }
    if (!met.goesOn) {
      if (met.hit.surface == kNone) return {};
      const Opaque* const material = surfaces_.finishOf(met.hit.surface).opaque;
      if (!material || !(isMirrored || isPolished(*material))) return {};
      const PlainPlace there = surfaces_.placeOf(origin - met.distance * direction, direction,
                                                 {met.hit, met.distance, passed}, scratch.functions);
      if (!there.material) return {};
      const Scattering s =
          scatter(*there.material, plainInteraction(direction, there.normal, there.flat, there.pattern), 0);
      double stays = 1;  // probability
      if (s.sharp.count > 0) {
        const Coefficient& gloss = s.sharp.path[0].coefficient;
        const double reflected = isMirrored ? std::min(maxChannel(gloss), 1.) : 1;
        if (random.uniform() < reflected) {
          passed *= gloss / reflected;
          isMirrored = true;
          direction = s.sharp.path[0].direction;
          start = met.hit.surface;
          continue;
        }
        stays = 1 - reflected;
      }
      if (!isMirrored) return {};
      const Coefficient share(passed.color * there.color() *
                              (diffuseShare(*there.material, -there.normal.dot(direction)) / stays));
      Radiance sum = diffusedAt(there, share, how, random, scratch);
      if (how.bounces > 1)
        sum += ofMirrored(there, {how.bounces - 1, 0, how.record, how.scale * share, how.outdoors}, random,
                          scratch) *
               share;
      return sum;
    }
    passed *= met.passed;
    isMirrored = isMirrored || met.isReflected;
    direction = met.next;
    start = met.hit.surface;
  }
  return {};
}

}  // namespace rsphere
