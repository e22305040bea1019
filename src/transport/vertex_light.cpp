#include "transport/vertex_light.h"

#include <algorithm>
#include <cmath>

#include "base/colorimetry.h"
#include "base/constants.h"
#include "shade/scattering.h"
#include "transport/tuning.h"

namespace rsphere {
namespace {

using Tuning = tuning::VertexLight;

// Chooses one of `count` by weight. Returns count if all are 0.
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

// The candidates for joins at one place.
struct Candidates {
  std::array<uint32_t, Tuning::kCandidatesRoom> vertex;
  std::array<double, Tuning::kCandidatesRoom> weight, upTo;
  double sum = 0;
};

// The light of a vertex that would arrive at a place if nothing were in between, but for constants, times 1 /
// d^2: near ones are more often in view. A bound is enough, so single precision is.
double weightOf(const LightVertex& v, const V3d& point, const float* normal, int bounces, double width) {
  const auto x = static_cast<float>(v.place[0] - point.x), y = static_cast<float>(v.place[1] - point.y),
             z = static_cast<float>(v.place[2] - point.z);
  const float here = x * normal[0] + y * normal[1] + z * normal[2];
  const float there = -(x * v.facing[0] + y * v.facing[1] + z * v.facing[2]);
  if (!(here > 0) || !(there > 0) || v.bounces > bounces) return 0;
  const double square = x * x + y * y + z * z;
  const double bound = v.isUnbounded() ? 0 : width * width;
  return static_cast<double>(v.power * here * there) / (square * (square + bound));
}

// REQUIRES that there are vertices.
Candidates candidatesFor(const LightVertices& vertices, const PlainPlace& at, int bounces, Random& random) {
  const auto& all = vertices.all();
  const float normal[] = {static_cast<float>(at.normal.x), static_cast<float>(at.normal.y),
                          static_cast<float>(at.normal.z)};
  const double stride = static_cast<double>(all.size()) / Tuning::kCandidates;
  Candidates candidates;
  for (int i = 0; i < Tuning::kCandidates; ++i) {
    const auto k = static_cast<uint32_t>((i + random.uniform()) * stride);
    candidates.vertex[i] = std::min(k, static_cast<uint32_t>(all.size() - 1));
    candidates.weight[i] = weightOf(all[candidates.vertex[i]], at.point, normal, bounces, vertices.width());
    candidates.upTo[i] = candidates.sum += candidates.weight[i];
  }
  return candidates;
}

}  // namespace

VertexLight::VertexLight(const PreparedScene& prepared, const PlainSurfaces& surfaces, size_t paths,
                         uint64_t seed)
    : prepared_(prepared), surfaces_(surfaces), vertices_(prepared, surfaces, paths, seed) {}

void VertexLight::Record::add(uint8_t batch, const Irradiance& part, double notChosen) {
  batches[batch] += part;
  squares += part.color * part.color * notChosen;
  const double bright = photopicOf(part.color, sampling);
  squaredBrightness += bright * bright * notChosen;
}

// One sample of one source. finest: -ds, of which one part is chosen; 0: the source is not divided.
VertexLight::Chosen VertexLight::chooseSource(const PlainPlace& at, double finest, Random& random,
                                              Scratch& scratch) const {
  auto& weights = scratch.weights;
  const double sum = surfaces_.weigh(at.point, at.normal, weights);
  const size_t source = chooseOne(
      weights.size(), sum, [&](size_t i) { return weights[LightId(i)]; }, random);
  if (source == weights.size()) return {};
  auto& samples = scratch.samples;
  samples.clear();
  prepared_.lights().sample(LightId(source), at.point, {finest, 1, at.normal}, random, samples);
  const auto arrives = [&](size_t i) {
    const double cosine = at.normal.dot(samples[i].direction);
    return samples[i].cosine > 0 && cosine > kNegligible ? cosine * samples[i].solidAngle : 0;
  };
  double all = 0;
  for (size_t i = 0; i < samples.size(); ++i) all += arrives(i);
  const size_t part = chooseOne(samples.size(), all, arrives, random);
  if (part == samples.size()) return {};
  return {samples[part], weights[LightId(source)] / sum * arrives(part) / all};
}

// The share of the light of a sample that arrives.
Coefficient VertexLight::passing(const PlainPlace& at, const SourceSample& sample) const {
  const SurfaceId source = prepared_.lights().all()[sample.source].surface;
  switch (
      prepared_.tracer().shadow(at.point, sample.direction, sample.distance, source, nullptr, at.surface)) {
    case Shadow::clear:
      return Coefficient(1);
    case Shadow::blocked:
      return {};
    default:
      return surfaces_.passing(at.point, at.point + sample.distance * sample.direction, at.surface);
  }
}

// The radiance of a sample that arrives (W/sr/m2).
Radiance VertexLight::arriving(const PlainPlace& at, const SourceSample& sample,
                               FunctionScratch& scratch) const {
  if (prepared_.lights().all()[sample.source].isVirtual()) return arrivingByMirrors(at, sample, scratch);
  const Coefficient passed = passing(at, sample);
  if (isBlack(passed)) return {};
  const V3d point = at.point + sample.distance * sample.direction;
  return surfaces_.radianceOf(sample.source, point, sample.normal, sample.direction, scratch) * passed;
}

// The same of an image, which the mirrors must show.
Radiance VertexLight::arrivingByMirrors(const PlainPlace& at, const SourceSample& sample,
                                        FunctionScratch& scratch) const {
  const auto& lights = prepared_.lights().all();
  V3d origin = at.point, direction = sample.direction;
  SurfaceId start = at.surface;
  Coefficient passed(1);
  for (LightId source = sample.source;; source = lights[source].relayed) {
    const Sight sight = surfaces_.look(origin, direction, kFarAway, start);
    if (sight.hit.surface != lights[source].surface || sight.hit.cosine <= 0) return {};
    origin += sight.distance * direction;
    passed *= sight.passed;
    if (!lights[source].isVirtual())
      return surfaces_.radianceOf(source, origin, sight.hit.normal, direction, scratch) * passed;
    start = sight.hit.surface;
    const Scattering s =
        scatter(*surfaces_.mirrorOf(start), plainInteraction(direction, sight.hit.normal, true));
    passed *= s.sharp.path[0].coefficient;
    direction = s.sharp.path[0].direction;
  }
}

Radiance VertexLight::directOf(const PlainPlace& at, const Seen& seen, Random& random,
                               Scratch& scratch) const {
  // A density is known only for samples of the whole source.
  const double finest = seen.density > 0 ? 0 : prepared_.options().sourceSubstructuring;
  const Chosen to = chooseSource(at, finest, random, scratch);
  if (!(to.probability > 0)) return {};
  const Radiance arrives = arriving(at, to.sample, scratch.functions);
  if (isBlack(arrives)) return {};
  const double over =
      seen.density > 0 ? vertices_.shadowRaysOver(to.sample, at.normal, to.probability) * seen.density : 0;
  const double share = over > 0 ? over / (over + seen.joined) : 1;
  return arrives * shownOfSource(at, seen.view, to.sample.direction, to.sample.solidAngle, seen.shown) *
         (share / to.probability);
}

// The mean radiance that arrives over the hemisphere straight from sources (W/sr/m2).
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
  return ofVertices(at, how, random) + ofNear(at, how, random, scratch);
}

// Chooses some vertices from candidates all over the scene, by the light that they would send.
Radiance VertexLight::ofVertices(const PlainPlace& at, const Indirect& how, Random& random) const {
  Radiance sum;
  if (vertices_.all().empty()) return sum;
  const Candidates candidates = candidatesFor(vertices_, at, how.bounces, random);
  if (!(candidates.sum > 0)) return sum;
  const double shift = random.uniform();
  for (int i = 0, join = 0; join < Tuning::kJoined; ++join) {
    const double where = (join + shift) / Tuning::kJoined * candidates.sum;
    while (i + 1 < Tuning::kCandidates && candidates.upTo[i] <= where) ++i;
    if (!(candidates.weight[i] > 0)) continue;
    // How many vertices each that is joined stands for.
    const double stride = static_cast<double>(vertices_.all().size()) / Tuning::kCandidates;
    const double scale = stride * candidates.sum / (Tuning::kJoined * candidates.weight[i]);
    const Radiance part = ofVertex(at, candidates.vertex[i]) * scale;
    sum += part;
    if (how.record && !isBlack(part))
      how.record->add(vertices_.all()[candidates.vertex[i]].batch, Irradiance(part.color * how.scale.color),
                      1);
  }
  return sum;
}

// What one vertex adds to the mean radiance that arrives.
Radiance VertexLight::ofVertex(const PlainPlace& at, size_t i) const {
  const LightVertex& v = vertices_.all()[i];
  vertices_.powerOf(i).color.prefetch();
  const V3d to = v.point() - at.point;
  const double square = to.length2(), d = std::sqrt(square);
  const double here = to.dot(at.normal) / d, there = -to.dot(v.normal()) / d;
  if (!(here > 0) || !(there > 0)) return {};
  const Coefficient passed = surfaces_.passing(at.point, v.point(), at.surface);
  if (isBlack(passed)) return {};
  const double bounded = v.isUnbounded() ? 1 : 1 - vertices_.nearShare(d);
  const double kernel =
      here * there / (kPi * kPi * square) * bounded * diffuseShare(vertices_.materialOf(i), there);
  return Radiance(vertices_.powerOf(i).color * passed.color * kernel);
}

Radiance VertexLight::ofNear(const PlainPlace& at, const Indirect& how, Random& random,
                             Scratch& scratch) const {
  const V3d direction = [&] {
    const double u1 = random.uniform(), u2 = random.uniform();
    return diffuseDirection(at.normal, u1, u2);
  }();
  // nearShare() is above u up to this distance.
  const double u = random.uniform();
  const double farthest = u > 0 ? std::min(vertices_.width() * std::sqrt((1 - u) / u), kFarAway) : kFarAway;
  if (!(farthest > kSamePlace)) return {};
  const Sight sight = surfaces_.look(at.point, direction, farthest, at.surface);
  if (sight.hit.surface == kNone) return {};
  const PlainPlace there = surfaces_.placeOf(at.point, direction, sight, scratch.functions);
  if (!there.material) return {};
  const double left = how.fromEye > 0 ? 1 - vertices_.closeShare(sight.distance, how.fromEye) : 1;
  const Coefficient share(sight.passed.color * there.color() *
                          (left * diffuseShare(*there.material, -there.normal.dot(direction))));
  Radiance sum = directAt(there, random, scratch);
  if (how.bounces > 1)
    sum += indirectAt(there, {how.bounces - 1, 0, how.record, how.scale * share}, random, scratch);
  sum = sum * share;
  if (how.fromEye > 0 && hasRoughHighlight(*there.material))
    sum += sight.passed * directOf(there, {.view = direction, .shown = Shown::highlight}, random, scratch);
  return sum;
}

}  // namespace rsphere
