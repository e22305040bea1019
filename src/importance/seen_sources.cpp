#include "importance/seen_sources.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "importance/silhouette.h"

namespace rsphere {
namespace {
// Parts of a source smaller than this, against their distance, would be more than 64 for most of them.
constexpr double kSmallestPart = .02;
}  // namespace

SeenSources::SeenSources(const Transport& transport) : transport_(transport) {
  const Scene& scene = transport.scene();
  for (const LightSource& light : transport.lights().all()) {
    const Surface& surface = scene.surfaces[light.surface];
    const Material* material = scene.materialOf(surface);
    bool apart = !(material && std::holds_alternative<Illum>(*material));
    if (light.distant) apart = apart && light.cosHalfAngle > std::cos(kWidestDistant);
    // What is seen by way of a relay is left to the other directions.
    if (light.map == LightSource::Map::square || light.isVirtual()) apart = false;
    apart_.push_back(apart);
    any_ = any_ || apart;
  }
}

void SeenSources::sample(const V3d& point, size_t most, uint64_t seed, PathTracer& tracer,
                         std::vector<Sample>& samples) const {
  const Scene& scene = transport_.scene();
  const auto lights = transport_.lights().all();
  std::vector<SourceSample> aims;
  // A shadow ray costs a tenth of another direction, and something half in front of a source is all that is
  // left of the error here: from where -ds begins, parts are made smaller as long as they are few enough, or
  // larger.
  SourceSampling how{std::clamp(transport_.options().sourceSubstructuring, kSmallestPart, 1.), 1, false};
  const auto aim = [&] {
    aims.clear();
    Random random(seed);
    for (uint32_t i = 0; i < lights.size(); ++i)
      if (apart_[i]) transport_.lights().sample(i, point, how, random, aims);
    return aims.size() <= most;
  };
  const double step = std::sqrt(2.);
  bool few = aim();
  for (; few && how.largest > kSmallestPart; few = aim()) how.largest /= step;
  for (; !few && how.largest > 0; few = aim()) how.largest = how.largest < 8 ? how.largest * step : 0;
  for (size_t begin = 0; begin < aims.size();) {
    size_t end = begin;
    double sum = 0;
    for (; end < aims.size() && aims[end].source == aims[begin].source; ++end) sum += aims[end].solidAngle;
    const LightSource& light = lights[aims[begin].source];
    double scale = 1;
    if (!light.distant && light.map != LightSource::Map::tube && sum > 0)
      scale = silhouetteOf(scene.surfaces[light.surface].shape, scene.vertices, point).solidAngle() / sum;
    for (; begin < end; ++begin) {
      const SourceSample& to = aims[begin];
      Sample s;
      s.source = to.source;
      s.part = to.solidAngle * scale;
      s.ray = tracer.traceToSource(point, to, mixBits(seed + begin));
      const bool seen = tracer.shownSource() == static_cast<int32_t>(to.source);
      s.direction = {to.direction, seen ? s.part : 0, seen ? s.ray.value : Rgb(0, 0, 0), true};
      samples.push_back(s);
    }
  }
}

}  // namespace rsphere
