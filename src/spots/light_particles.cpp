#include "spots/light_particles.h"

#include <vector>

#include "spots/tuning.h"

namespace rsphere {

double powerOf(const Scene& scene, const LightSource& light, double reach) {
  const Surface& surface = scene.surfaces[light.surface];
  const auto* distant = surface.shape.as<Distant>();
  return brightness(sourceRadiance(scene, surface)) * kPi *
         (distant ? distant->solidAngle * reach * reach : areaOf(surface.shape, scene.vertices));
}

namespace {

// A source that is not distant.
class Lamp {
 public:
  Lamp(const Scene& scene, const LightSource& light, const SurfaceFunctions& functions)
      : scene_(scene), light_(light), functions_(functions) {
    const Surface surface = scene.surfaces[light.surface];
    if (surface.goal || surface.modifier != surface.material) return;
    const ModifierId first = scene.modifiers[surface.material].next;
    // dependsOnDistance() throws if files of the pattern cannot be read.
    const auto isReadable = [&](ModifierId i) { return functions.dependsOnDistance(i), true; };
    if (arePatterns(scene, first, isReadable)) patterns_ = first;
  }

  struct BrightWay : LampWay {
    double bright = 1;  // radiance relative to that without patterns
  };
  // One of some ways, chosen in proportion to its brightness, which becomes the mean of all.
  BrightWay leave(Random& random) {
    if (patterns_ == kNone) return {wayFrom(scene_, light_, random)};
    BrightWay chosen;
    double sum = 0;
    for (size_t i = 0; i < tuning::LightParticles::kTried; ++i) {
      const BrightWay one = tried(random);
      sum += one.bright;
      if (i == 0 || random.uniform() * sum < one.bright) chosen = one;
    }
    chosen.bright = sum / tuning::LightParticles::kTried;
    return chosen;
  }
  // The mean brightness of all ways; above 0, even if the ways that are tried miss all light.
  double mean() {
    if (patterns_ == kNone) return 1;
    Random random(light_.surface.index());
    double sum = 1;
    for (size_t i = 0; i < tuning::LightParticles::kMeasured; ++i) sum += tried(random).bright;
    return sum / tuning::LightParticles::kMeasured;
  }

 private:
  BrightWay tried(Random& random) {
    const LampWay way = wayFrom(scene_, light_, random);
    const Color pattern =
        patternOfSource(functions_, patterns_, way.from.point, way.from.normal, -way.direction, scratch_);
    return {way, std::max(0., brightness(Radiance(pattern)))};
  }

  const Scene& scene_;
  const LightSource& light_;
  const SurfaceFunctions& functions_;
  ModifierId patterns_;  // kNone: none, or not patterns alone
  FunctionScratch scratch_;
};

}  // namespace

void sendParticles(const Scene& scene, const Tracer& tracer, const LightSources& lights,
                   const SurfaceFunctions& functions, double count, SentParticle each) {
  const V3d middle = tracer.bounds().center();
  const double reach = tracer.bounds().size().length() / 2;
  struct Sender {
    const LightSource* light;
    double power, mean = 1;
  };
  std::vector<Sender> senders;
  double all = 0;
  for (const LightSource& light : lights.all()) {
    if (light.isVirtual()) continue;
    Sender sender{&light, powerOf(scene, light, reach) * (light.spot ? light.spot->solidAngle / kPi : 1)};
    if (!light.isDistant() && sender.power > 0) sender.mean = Lamp(scene, light, functions).mean();
    sender.power *= sender.mean;
    if (!(sender.power > 0)) continue;
    senders.push_back(sender);
    all += sender.power;
  }
  Random random(mixBits(senders.size()));
  const double one = all / count;
  double due = random.uniform();
  for (const Sender& sender : senders) {
    const Surface& surface = scene.surfaces[sender.light->surface];
    if (const auto* distant = surface.shape.as<Distant>()) {
      const V3d direction = -distant->direction;
      const auto [x, y] = frame(direction);
      for (due += sender.power / one; due >= 1; --due) {
        const double radius = reach * std::sqrt(random.uniform()), angle = 2 * kPi * random.uniform();
        each(middle + radius * std::cos(angle) * x + radius * std::sin(angle) * y - 2 * reach * direction,
             direction, one, surface, random);
      }
      continue;
    }
    Lamp lamp(scene, *sender.light, functions);
    for (due += sender.power / one; due >= 1; --due) {
      const auto way = lamp.leave(random);
      each(way.from.point + 2 * scene.samePlace * way.from.normal, way.direction,
           one * way.bright / sender.mean, surface, random);
    }
  }
}

}  // namespace rsphere
