#include "spots/light_particles.h"

#include <cmath>
#include <vector>

#include "base/constants.h"
#include "light/surface_point.h"
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
      : scene_(scene), light_(light), functions_(functions), shape_(scene.surfaces[light.surface].shape) {
    const Surface surface = scene.surfaces[light.surface];
    if (surface.goal || surface.modifier != surface.material) return;
    const ModifierId first = scene.modifiers[surface.material].next;
    for (ModifierId i = first; i != kNone; i = scene.modifiers[i].next)
      if (!std::holds_alternative<Pattern>(scene.modifiers[i].content) || !isReadable(i)) return;
    patterns_ = first;
  }

  // A place and a direction in which light leaves, and its radiance there, relative to that without patterns.
  struct Way {
    SurfacePoint from;
    V3d direction;
    double bright = 1;
  };
  // The brightest of some ways, each chosen in proportion to its brightness (as source_emission.h does). The
  // brightness of the result is their mean.
  Way leave(Random& random) {
    if (patterns_ == kNone) return tried(random);
    Way chosen;
    double sum = 0;
    for (size_t i = 0; i < tuning::LightParticles::kTried; ++i) {
      const Way one = tried(random);
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
  // Whether the files of a pattern can be read. If not, rays that show the source say so.
  bool isReadable(ModifierId pattern) const {
    try {
      functions_.dependsOnDistance(pattern);
    } catch (const rad::Error&) {
      return false;
    }
    return true;
  }
  Way tried(Random& random) {
    Way way{samplePoint(shape_, scene_.vertices, random), {}};
    way.direction = light_.spot ? withinCone(light_.spot->aim, light_.spot->solidAngle, random)
                                : sentFrom(way.from.normal, random);
    FunctionPoint here;
    here.direction = -way.direction;
    here.normal = way.from.normal;
    here.cosine = way.from.normal.dot(way.direction);
    here.point = way.from.point;
    Color pattern(1, 1, 1);
    for (ModifierId i = patterns_; i != kNone; i = scene_.modifiers[i].next)
      pattern *= functions_.pattern(i, here, scratch_);
    way.bright = std::max(0., brightness(Radiance(pattern)));
    return way;
  }

  const Scene& scene_;
  const LightSource& light_;
  const SurfaceFunctions& functions_;
  ShapeRef shape_;
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
      const Lamp::Way way = lamp.leave(random);
      each(way.from.point + 2 * scene.samePlace * way.from.normal, way.direction,
           one * way.bright / sender.mean, surface, random);
    }
  }
}

}  // namespace rsphere
