#include "transport/direct_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "rays/ray_functions.h"
#include "rays/ray_hit.h"
#include "transport/ray_limits.h"
#include "transport/tuning.h"

namespace rsphere {
namespace {

// Number of the brightest contributions that are always tested for shadows, whatever -dt is, as in RADIANCE.
constexpr size_t kAlwaysTested = 2;

// Up to this number, contributions are ranked by comparing all pairs without branches. The n^2 / 2
// comparisons take less time than n log n comparisons of a sort, half of which are mispredicted (measured).
constexpr uint32_t kFew = 24;

// Kinds of sources. The visibility of each kind is estimated separately, because their causes of occlusion
// differ.
constexpr int kSourceKinds = 3;
int kindOf(const LightSource& light) { return light.isVirtual() ? 2 : light.isDistant() ? 1 : 0; }

// The kind of a shadow ray that leaves a surface in a direction (unit).
RayKind kindOfShadow(const SurfaceHit& hit, const V3d& direction) {
  const bool through = (hit.cosine > 0) != (hit.normal.dot(direction) > 0);
  return through ? kTransmittedShadow : kReflectedShadow;
}

// The number of sources of a kind that were tested for shadows, and the number of those that are visible.
struct Tests {
  int tested = 0, visible = 0;

  void add(bool isVisible) {
    ++tested;
    visible += isVisible;
  }
  double share() const { return static_cast<double>(visible) / tested; }
};

}  // namespace

// The radiance of a source along an unoccluded shadow ray.
Radiance DirectLight::sourceValue(Receiver at, const SourceSample& sample) {
  const LightSource& light = t_.lights().all()[sample.source];
  if (light.isVirtual()) {
    NextRay next(at.end, kReflectedShadow, Coefficient(1));
    if (!goesOnAlong(next, t_, state_)) return {};
    next.context.known = Known::no;
    next.query = {.origin = at.point,
                  .direction = sample.direction,
                  .from = at.end.hit.surface,
                  .aimedAt = sample.source,
                  .unobstructed = true};
    return follower_.follow(next.query, next.context).value;
  }
  if (sample.cosine < 0) return {};
  const Medium& medium = at.end.medium();
  const Coefficient passed = passing(medium.extinction * (Color(1, 1, 1) - medium.albedo), sample.distance);
  if (const Radiance* radiance = t_.lights().constantRadiance(sample.source)) return *radiance * passed;
  const RayQuery query{.origin = at.point, .direction = sample.direction, .aimedAt = sample.source};
  const PathContext context{.kind = kReflectedShadow,
                            .kinds = at.end.context.kinds | kReflectedShadow,
                            .pathLength = at.end.context.pathLength + at.end.hit.length};
  RayEnd end(query, context);
  putAtSource(end, light, sample);
  RayResult result;
  follower_.shade(end, t_.scene().surfaces[light.surface].modifier, result);
  return result.value * passed;
}

// Whether a sample is the only one of its source in scratch_.samples.
bool DirectLight::isWhole(const SourceSample& sample) const {
  const size_t i = static_cast<size_t>(&sample - scratch_.samples.data());
  return (i == 0 || scratch_.samples[i - 1].source != sample.source) &&
         (i + 1 == scratch_.samples.size() || scratch_.samples[i + 1].source != sample.source);
}

// Sets `value` to the radiance of a source sample that arrives at the receiver; false if none arrives.
// to.value: the radiance without occlusion. If the shadow ray has to be followed through surfaces that may
// transmit light, samples of a lobe do not estimate this light, so that their part is added back to
// to.coefficient.
bool DirectLight::arrives(Receiver at, Contribution& to, Radiance& value) {
  const SourceSample& sample = *to.sample;
  const LightSource& light = t_.lights().all()[sample.source];
  const bool toSurface = !light.isDistant() || light.isVirtual();
  const SurfaceId from = at.end.hit.surface;
  Shadow shadow =
      t_.tracer().shadow(at.point, sample.direction, sample.distance, toSurface ? light.surface : kNone,
                         &blockerOf(from, sample.source), from);
  if (shadow == Shadow::refracted)
    shadow = isWhole(sample) && t_.lights().presumedShadows().hide(sample.source, at.point, sample.direction,
                                                                   sample.distance)
                 ? Shadow::blocked
                 : Shadow::unsure;
  const ShownShadows shown = state_.request.shadows;
  const bool follow =
      shadow == Shadow::unsure ||
      (shadow == Shadow::clear &&
       (light.isVirtual() || (shown == ShownShadows::thatArrive && isMedium(at.end.medium().extinction))));
  if (follow && !scratch_.ofLobe.empty())
    to.coefficient += scratch_.ofLobe[static_cast<size_t>(&to - scratch_.contributions.data())];
  if (follow || shown == ShownShadows::all)
    value = valueFromSource(at, to);  // even if blocked, when the observer sees all shadow rays
  if (shadow == Shadow::blocked || (!follow && isLeftOut(at, sample))) return false;
  if (!follow) value = to.value;
  if (!follow && shown == ShownShadows::thatArrive) show(at, to);
  return !follow || maxChannel(value) > kNegligible;
}

// Turns `next` into the shadow ray of a contribution; false if the path ends here.
bool DirectLight::aim(NextRay& next, Receiver at, const Contribution& to) {
  if (!goesOnAlong(next, t_, state_)) return false;
  next.context.known = isLeftOut(at, *to.sample) ? Known::joined : Known::no;
  next.context.contribution *= to.coefficient;
  next.query.origin = at.point;
  next.query.aimedAt = to.sample->source;
  next.query.direction = to.sample->direction;
  return true;
}

// The radiance that arrives along a shadow ray through surfaces that may transmit light.
Radiance DirectLight::valueFromSource(Receiver at, const Contribution& to) {
  NextRay next(at.end, kindOfShadow(at.end.hit, to.sample->direction), Coefficient(1));
  return aim(next, at, to) ? follower_.follow(next.query, next.context).value : Radiance();
}

// Shows the observer an unoccluded shadow ray at the source that it has reached.
void DirectLight::show(Receiver at, const Contribution& to) {
  const SourceSample& sample = *to.sample;
  NextRay next(at.end, kindOfShadow(at.end.hit, sample.direction), Coefficient(1));
  if (!aim(next, at, to)) return;
  RayEnd end(next.query, next.context);
  putAtSource(end, t_.lights().all()[sample.source], sample);
  RayResult result;
  result.value = to.value;
  result.unmirroredLength = sample.distance;
  (*state_.request.observer)(end, result);
}

// count to the power of -dc. Uses a table, because computing a power takes as long as sampling a source.
size_t DirectLight::lookAheadOf(size_t count) {
  for (size_t n = lookAheads_.size(); n <= count; ++n)
    lookAheads_.push_back(
        static_cast<size_t>(std::pow(static_cast<double>(n), t_.options().directCertainty) + .5));
  return lookAheads_[count];
}

// Sorts the contributions by brightness, brightest first. Equal contributions keep their order.
void DirectLight::rankByBrightness(uint32_t count) {
  if (count > kFew) {
    std::iota(scratch_.order.begin(), scratch_.order.begin() + count, 0);
    std::sort(scratch_.order.begin(), scratch_.order.begin() + count, [&](uint32_t a, uint32_t b) {
      return scratch_.brightness[a] != scratch_.brightness[b]
                 ? scratch_.brightness[a] > scratch_.brightness[b]
                 : a < b;
    });
    return;
  }
  // All pairs are compared, without branches; std::sort would mispredict half of its branches.
  std::array<int64_t, kFew> before;
  const double* const all = scratch_.brightness.data();
  for (uint32_t i = 0; i < count; ++i) {
    const double bright = all[i];
    int64_t darker = 0;
    for (uint32_t j = 0; j < i; ++j) {
      const int64_t isDarker = all[j] < bright;
      darker += isDarker;
      before[j] += isDarker;
    }
    before[i] = i - darker;
  }
  for (uint32_t i = 0; i < count; ++i) scratch_.order[before[i]] = i;
}

// The sources that may light a place. Glimpses seldom see a place twice. Sampling a few hidden sources there
// takes less time than dividing regions until no hidden source is left (HiddenBoxes).
std::span<const uint32_t> DirectLight::notHiddenFrom(const V3d& point, const V3d& front) const {
  const HiddenBoxes& hidden = t_.lights().hidden();
  if (!state_.glimpses) return hidden.notHiddenFrom(point, front);
  const size_t most =
      tuning::DirectLight::kManyOfGlimpse * tuning::DirectLight::kManyOfGlimpse * hidden.all().size();
  return hidden.widestWhere(point, [&](auto some) {
    return some.size() <= tuning::DirectLight::kFewOfGlimpse || some.size() * some.size() <= most;
  });
}

// Fills the scratch memory with the unoccluded contributions of all source samples, except black ones.
// Returns the number of contributions.
uint32_t DirectLight::findContributions(Receiver at, DirectCoefficient coefficientOf, const V3d& front,
                                        const PartOfLobe* partOfLobe) {
  const RayOptions& o = t_.options();
  scratch_.samples.clear();
  const PathContext& ray = at.end.context;
  const bool divides = o.sourceSubstructuring > kNegligible &&
                       !(isOfGather(settings_, ray) && o.directJitter > tuning::DirectLight::kWideJitter);
  // Not needed after indirect bounces and in sphere mode, where the noise averages out.
  const bool splitsBalls = isRayMode(settings_.mode) && ray.ambientLevel == 0;
  const SourceSampling how{divides ? o.sourceSubstructuring / ray.weight : 0, o.directJitter, front,
                           splitsBalls};
  // If paths from both ends estimate all direct light of known sources, no shadow rays are sent to them.
  // Otherwise shadow rays estimate the part of their light that passes unknown surfaces.
  const PlainSurfaces* const leftOut =
      at.leftToBothEnds && !at.leftToBothEnds->coverage().passUnknown ? at.leftToBothEnds : nullptr;
  // If the observer sees all shadow rays, those to hidden sources are traced, too.
  const std::span<const uint32_t> sources = state_.request.shadows == ShownShadows::all
                                                ? t_.lights().hidden().all()
                                                : notHiddenFrom(at.point, front);
  const std::vector<bool>* const sampled = state_.request.sampledLights;
  for (const uint32_t i : sources)
    if ((!sampled || (*sampled)[i]) && (!leftOut || !leftOut->knows(LightId(i))))
      t_.lights().sample(LightId(i), at.point, how, state_.random, scratch_.samples);
  if (scratch_.contributions.size() < scratch_.samples.size()) {
    scratch_.contributions.resize(scratch_.samples.size());
    scratch_.brightness.resize(scratch_.samples.size());
    scratch_.order.resize(scratch_.samples.size());
    scratch_.remaining.resize(scratch_.samples.size() + 1);
  }
  scratch_.ofLobe.clear();
  const bool clear = !isMedium(at.end.medium().extinction);
  uint32_t count = 0;
  for (const SourceSample& sample : scratch_.samples) {
    Coefficient coefficient = coefficientOf(sample.direction, sample.solidAngle);
    if (isBlack(coefficient)) continue;
    Contribution& c = scratch_.contributions[count];
    if (const Radiance* constant =
            clear && sample.cosine >= 0 ? t_.lights().constantRadiance(sample.source) : nullptr)
      c.value = *constant;
    else
      c.value = sourceValue(at, sample);
    const double bright = brightnessOfProduct(c.value.color, coefficient.color);
    if (!(bright > 0)) continue;
    c.sample = &sample;
    c.coefficient = std::move(coefficient);
    if (partOfLobe) {
      scratch_.ofLobe.push_back((*partOfLobe)(sample));
      c.coefficient -= scratch_.ofLobe.back();
    }
    scratch_.brightness[count++] = bright;
  }
  return count;
}

// Estimates the sum of the contributions with ranks from `first` on. Samples one of them with a probability
// proportional to its unoccluded brightness.
void DirectLight::addOneOf(Receiver at, size_t first, uint32_t count, Radiance& value) {
  double rest = state_.random.uniform() * scratch_.remaining[first];
  size_t chosen = first;
  while (chosen + 1 < count && (rest -= rankedBrightness(chosen)) >= 0) ++chosen;
  Contribution& c = ranked(chosen);
  // In the coefficient, so that an observer of contributions gets it, too.
  const double factor = scratch_.remaining[first] / rankedBrightness(chosen);
  c.coefficient *= factor;
  if (!scratch_.ofLobe.empty()) scratch_.ofLobe[scratch_.order[chosen]] *= factor;
  Radiance arriving;
  if (arrives(at, c, arriving)) value += arriving * c.coefficient;
}

void DirectLight::add(Receiver at, DirectCoefficient coefficientOf, const V3d& front,
                      const PartOfLobe* partOfLobe, Radiance& value) {
  const PathContext& ray = at.end.context;
  const uint32_t count = findContributions(at, coefficientOf, front, partOfLobe);
  if (count == 0) return;
  const double threshold = t_.options().directThreshold / ray.weight;

  // Testing continues while the sum of this number of the next contributions is large enough (-dc).
  size_t lookAhead = count;
  if (threshold > 0) {
    rankByBrightness(count);
    scratch_.remaining[count] = 0;
    for (size_t i = count; i-- > 0;) scratch_.remaining[i] = scratch_.remaining[i + 1] + rankedBrightness(i);
    lookAhead = lookAheadOf(count);
  } else {
    std::iota(scratch_.order.begin(), scratch_.order.begin() + count, 0);
  }
  Tests ofKind[kSourceKinds];
  const auto test = [&](Contribution& c, Tests& tests) {
    Radiance arriving;
    const bool visible = arrives(at, c, arriving);
    tests.add(visible);
    if (visible) value.color.addProduct(arriving.color, c.coefficient.color);
  };
  size_t tested = 0;
  for (; tested < count; ++tested) {
    if (threshold > 0 && tested >= kAlwaysTested) {
      const double ahead =
          scratch_.remaining[tested] - scratch_.remaining[std::min<size_t>(tested + lookAhead, count)];
      if (ahead < threshold * brightness(value)) break;
    }
    Contribution& c = ranked(tested);
    test(c, ofKind[kindOf(t_.lights().all()[c.sample->source])]);
  }
  // After an indirect bounce, the remaining contributions are estimated without bias: noise averages out
  // there, but bias would not.
  if (tested < count && ray.ambientLevel > 0) return addOneOf(at, tested, count, value);
  // Sources too weak to be tested are assumed to be visible as often as the tested sources of their kind.
  // Kinds are distinguished because the visibility of lamps does not predict that of the sun, and vice versa.
  // Therefore the brightest source of each kind is always tested.
  for (; tested < count; ++tested) {
    Contribution& c = ranked(tested);
    Tests& tests = ofKind[kindOf(t_.lights().all()[c.sample->source])];
    if (tests.tested == 0)
      test(c, tests);
    else
      value += c.value * c.coefficient * tests.share();
  }
}

// Estimates the sum over all sources from -Ss sources, sampled in proportion to their weights. If there are
// at most -Ss sources, each is sampled once.
void DirectLight::addOfChosen(Receiver at, DirectCoefficient coefficientOf, const V3d& front,
                              Radiance& value) {
  const std::span<const uint32_t> sources = t_.lights().hidden().notHiddenFrom(at.point, front);
  const double sum = t_.lights().choice().weigh(at.point, front, sources, scratch_.sourceWeights);
  if (!(sum > 0)) return;
  const int draws = std::max(1, static_cast<int>(t_.options().chosenSources * at.end.context.weight + .5));
  const bool each = static_cast<size_t>(draws) >= sources.size();
  const double step = sum / draws;
  double next = state_.random.uniform() * step, passed = 0;
  for (size_t i = 0; i < sources.size(); ++i) {
    const double weight = scratch_.sourceWeights[i];
    const auto add = [&](double factor) {
      addSamples(at, LightId(sources[i]), {0, 1, front}, coefficientOf, factor, value);
    };
    if (each && weight > 0) add(1);
    if (each) continue;
    for (passed += weight; next < passed; next += step) add(step / weight);
  }
}

void DirectLight::addFromSource(const RayEnd& end, LightId source, DirectCoefficient coefficientOf,
                                Radiance& value) {
  const SourceSampling how{0, t_.options().directJitter, {0, 0, 0}};
  addSamples({end, end.hit.point}, source, how, coefficientOf, 1, value);
}

// Adds the light of all samples of one source, multiplied by `factor`.
void DirectLight::addSamples(Receiver at, LightId source, const SourceSampling& how,
                             DirectCoefficient coefficientOf, double factor, Radiance& value) {
  scratch_.samples.clear();
  scratch_.ofLobe.clear();
  t_.lights().sample(source, at.point, how, state_.random, scratch_.samples);
  for (const SourceSample& sample : scratch_.samples) {
    const Coefficient coefficient = coefficientOf(sample.direction, sample.solidAngle) * factor;
    if (isBlack(coefficient)) continue;
    Contribution c{&sample, coefficient, sourceValue(at, sample)};
    Radiance arriving;
    if (maxChannel(c.value) > 0 && arrives(at, c, arriving)) value += arriving * c.coefficient;
  }
}

}  // namespace rsphere
