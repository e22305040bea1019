#include "spots/light_particles.h"

#include <cmath>
#include <vector>

#include "base/constants.h"
#include "light/surface_point.h"

namespace rsphere {

double powerOf(const Scene& scene, const LightSource& light, double reach) {
  const Surface& surface = scene.surfaces[light.surface];
  const auto* distant = surface.shape.as<Distant>();
  return brightness(sourceRadiance(scene, surface)) * kPi *
         (distant ? distant->solidAngle * reach * reach : areaOf(surface.shape, scene.vertices));
}

void sendParticles(const Scene& scene, const Tracer& tracer, const LightSources& lights, double count,
                   SentParticle each) {
  const V3d middle = tracer.bounds().center();
  const double reach = tracer.bounds().size().length() / 2;
  struct Sender {
    const LightSource* light;
    double power;
  };
  std::vector<Sender> senders;
  double all = 0;
  for (const LightSource& light : lights.all()) {
    if (light.isVirtual()) continue;
    const double power = powerOf(scene, light, reach) * (light.spot ? light.spot->solidAngle / kPi : 1);
    if (!(power > 0)) continue;
    senders.push_back({&light, power});
    all += power;
  }
  Random random(mixBits(senders.size()));
  const double one = all / count;
  double due = random.uniform();
  for (const Sender& sender : senders) {
    const Surface& surface = scene.surfaces[sender.light->surface];
    for (due += sender.power / one; due >= 1; --due) {
      V3d origin, direction;
      if (const auto* distant = surface.shape.as<Distant>()) {
        const double radius = reach * std::sqrt(random.uniform()), angle = 2 * kPi * random.uniform();
        direction = -distant->direction;
        const auto [x, y] = frame(direction);
        origin = middle + radius * std::cos(angle) * x + radius * std::sin(angle) * y - 2 * reach * direction;
      } else {
        const SurfacePoint at = samplePoint(surface.shape, scene.vertices, random);
        const auto& spot = sender.light->spot;
        direction = spot ? withinCone(spot->aim, spot->solidAngle, random) : sentFrom(at.normal, random);
        origin = at.point + 2 * scene.samePlace * at.normal;
      }
      each(origin, direction, one, surface, random);
    }
  }
}

}  // namespace rsphere
