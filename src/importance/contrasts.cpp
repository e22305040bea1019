#include "importance/contrasts.h"

#include <algorithm>
#include <cmath>

#include "base/spectral_sampling.h"
#include "importance/tuning.h"
#include "light/surface_point.h"
#include "transport/tuning.h"

namespace rsphere {
namespace {

class Values {
 public:
  void add(double value) {
    sum_ += value;
    squares_ += value * value;
    ++count_;
  }
  double mean() const { return count_ > 0 ? sum_ / count_ : 0; }
  double deviation() const {
    return count_ > 1 ? std::sqrt(std::max(0., (squares_ - sum_ * sum_ / count_) / (count_ - 1))) : 0;
  }

 private:
  double sum_ = 0, squares_ = 0;
  int count_ = 0;
};

// The radiance seen from random points on the scene's surfaces; every surface is equally probable.
struct TypicalView {
  double mean = 0;       // of the photopic radiance, W/sr/m2
  double baseError = 1;  // Contrasts::baseError
};
TypicalView measureTypicalView(const Scene& scene, const SeenSources& sources,
                               const SpectralSampling* sampling, PathTracer& tracer) {
  TypicalView result;
  Random random(mixBits(scene.outermost().size()));
  Values photopic;
  Values values;
  for (size_t k = 0; k < 2 * tuning::Contrasts::kRays; ++k) {
    const auto surfaces = static_cast<double>(scene.outermost().size());
    const SurfaceId i(static_cast<size_t>(random.uniform() * surfaces));
    if (scene.surfaces[i].shape.as<Distant>()) continue;
    const SurfacePoint at = samplePoint(scene, scene.surfaces[i], random);
    if (!(at.clearance > 0)) continue;
    const V3d away = diffuseDirection(at.normal, random.uniform(), random.uniform());
    const TracedRay ray = tracer.trace(at.point + at.clearance * away, away, 0, random.bits());
    if (sources.isApart(ray.shown)) continue;
    photopic.add(photopicOf(ray.value.color, sampling));
    values.add(brightness(ray.value));
  }
  if (!(values.mean() > 0)) return result;
  result.mean = photopic.mean();
  result.baseError = values.deviation() / values.mean();
  return result;
}

// Standard deviation of the brightness on objects with the same modifier. Rays start just in front of points
// of an object and hit it from evenly distributed directions, because it may be seen from anywhere.
double measureDeviation(const Scene& scene, std::span<const SpecialObject> objects, size_t rays,
                        const SeenSources& sources, const PathRequest& request, PathTracer& tracer) {
  Random random(mixBits(objects[0].surface.index()));
  Values values;
  for (size_t k = 0; k < rays; ++k) {
    const SpecialObject& object = objects[k * objects.size() / rays];
    const SurfacePoint at = samplePoint(scene, object, random);
    // Objects that are not closed are seen from both sides.
    const bool behind = !isClosed(shapeOf(scene, object)) && k % 2;
    const V3d away = diffuseDirection(behind ? -at.normal : at.normal, random.uniform(), random.uniform());
    const TracedRay ray = tracer.trace(at.point + at.clearance * away, -away, 0, random.bits(), request);
    if (shows(scene, object, ray.surface) && !sources.isApart(ray.shown)) values.add(brightness(ray.value));
  }
  return values.deviation();
}

}  // namespace

Contrasts::Contrasts(const SphereTracing& tracing, std::span<const SpecialObject> objects,
                     const SeenSources& sources)
    : tracing_{tracing.prepared, tracing.caches, tracing.aims, tracing.vertexLight},
      sources_(sources),
      objects_(objects.begin(), objects.end()) {
  if (objects.empty() && !tracing.aims.openings) return;
  const Scene& scene = tracing.prepared.scene();
  const auto modifierOf = [&](const SpecialObject& object) {
    return scene.surfaces[object.surface].modifier;
  };
  std::ranges::stable_sort(objects_, {}, modifierOf);
  for (size_t i = 0; i < objects_.size(); ++i) {
    if (i == 0 || modifierOf(objects_[i]) != modifierOf(objects_[i - 1])) {
      alike_.push_back(std::make_unique<Alike>());
      alike_.back()->first = i;
    }
    ++alike_.back()->count;
    alikeOf_.push_back(static_cast<uint32_t>(alike_.size() - 1));
  }
  if (tracing.vertexLight) return;
  PathTracer tracer = tracing_.tracer();
  baseError_ = measureTypicalView(scene, sources, tracing.prepared.options().sampling, tracer).baseError;
}

double Contrasts::deviationOn(size_t object) const {
  Alike& alike = *alike_[alikeOf_[object]];
  std::call_once(alike.measured, [&] {
    const size_t rays = std::clamp<size_t>(tuning::Caps::kAsked / alike_.size(), 2, tuning::Contrasts::kRays);
    PathTracer tracer = tracing_.tracer();
    PathRequest request;
    request.vertexLight = tracing_.vertexLight.get();
    alike.deviation =
        measureDeviation(tracing_.prepared.scene(), std::span(objects_).subspan(alike.first, alike.count),
                         rays, sources_, request, tracer);
  });
  return alike.deviation;
}

double typicalRadiance(const SphereTracing& tracing, const SeenSources& sources) {
  PathTracer tracer = tracing.tracer();
  const PreparedScene& prepared = tracing.prepared;
  return measureTypicalView(prepared.scene(), sources, prepared.options().sampling, tracer).mean;
}

}  // namespace rsphere
