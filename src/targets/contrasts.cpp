#include "targets/contrasts.h"

#include <algorithm>
#include <cmath>

#include "base/spectral_sampling.h"
#include "light/surface_point.h"
#include "silhouettes/tuning.h"
#include "targets/tuning.h"

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

double clearanceAt(const SurfacePoint& at, const Scene& scene) {
  return std::max(at.clearance, 4 * scene.samePlace);
}

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
    const TracedRay ray = tracer.trace(at.point + clearanceAt(at, scene) * away, away, 0, random.bits());
    if (sources.isApart(ray.shown)) continue;
    photopic.add(photopicOf(ray.value.color, sampling));
    values.add(brightness(ray.value));
  }
  if (!(values.mean() > 0)) return result;
  result.mean = photopic.mean();
  result.baseError = values.deviation() / values.mean();
  return result;
}

// Standard deviation of the brightness on objects that share a modifier. Rays start just in front of points
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
    const TracedRay ray =
        tracer.trace(at.point + clearanceAt(at, scene) * away, -away, 0, random.bits(), request);
    if (shows(scene, object, ray.surface) && !sources.isApart(ray.shown)) values.add(brightness(ray.value));
  }
  return values.deviation();
}

ModifierId modifierOf(const Scene& scene, const SpecialObject& object) {
  return scene.surfaces[object.surface].modifier;
}

std::vector<SpecialObject> byModifier(const Scene& scene, std::span<const SpecialObject> objects) {
  std::vector<SpecialObject> sorted(objects.begin(), objects.end());
  std::ranges::stable_sort(sorted, {}, [&](const SpecialObject& o) { return modifierOf(scene, o); });
  return sorted;
}

std::vector<Box3d> boxesOf(const Scene& scene, std::span<const SpecialObject> objects) {
  std::vector<Box3d> boxes;
  for (const SpecialObject& object : objects)
    boxes.push_back(bounds(shapeOf(scene, object), verticesOf(scene, object)));
  return boxes;
}

}  // namespace

// The objects that can be seen from a region, by modifier.
class Contrasts::Region {
 public:
  Region(std::span<const uint32_t> seen, std::span<const uint32_t> alikeOf) : objects(seen) {
    if (!alikeOf.empty()) alike = std::vector<Alike>(alikeOf.back() + 1);
    for (const uint32_t i : seen) alike[alikeOf[i]].objects.push_back(i);
  }

  struct Alike {
    std::vector<uint32_t> objects;
    mutable std::once_flag measured;
    mutable double deviation = 0;
  };

  std::span<const uint32_t> objects;
  std::vector<Alike> alike;  // by number of the modifier
};

Contrasts::Contrasts(const SphereTracing& tracing, std::span<const SpecialObject> objects,
                     const SeenSources& sources)
    : tracing_{tracing.prepared, tracing.caches, tracing.aims, tracing.pools},
      sources_(sources),
      objects_(byModifier(tracing.prepared.scene(), objects)),
      hidden_(tracing.prepared.lights().hidden().blockers(), boxesOf(tracing.prepared.scene(), objects_),
              tuning::SpecialObjects::kFewHidden) {
  if (objects.empty() && !tracing.aims.of<Openings>()) return;
  const Scene& scene = tracing.prepared.scene();
  uint32_t number = 0;
  for (size_t i = 0; i < objects_.size(); ++i) {
    if (i > 0 && modifierOf(scene, objects_[i]) != modifierOf(scene, objects_[i - 1])) ++number;
    alikeOf_.push_back(number);
  }
  if (tracing.pools) return;
  PathTracer tracer = tracing_.tracer();
  baseError_ = measureTypicalView(scene, sources, tracing.prepared.options().sampling, tracer).baseError;
}

Contrasts::View Contrasts::from(const V3d& point) const {
  const std::span<const uint32_t> own = hidden_.notHiddenFrom(point);
  // Wider regions share their measurements among more points.
  const std::span<const uint32_t> wide = hidden_.widestWhere(
      point, [&](auto some) { return some.size() <= tuning::Contrasts::kWider * own.size(); });
  const std::lock_guard lock(making_);
  auto& region = regions_[wide.data()];
  if (!region) region = std::make_shared<const Region>(wide, alikeOf_);
  return {own, region};
}

double Contrasts::deviationOn(size_t object, const Region& region) const {
  const size_t count = alikeOf_.back() + 1;
  const Region::Alike& alike = region.alike[alikeOf_[object]];
  std::call_once(alike.measured, [&] {
    std::vector<SpecialObject> objects;
    for (const uint32_t i : alike.objects) objects.push_back(objects_[i]);
    const size_t rays =
        std::clamp<size_t>(tuning::Contrasts::kRaysToAll / count, 2, tuning::Contrasts::kRays);
    PathTracer tracer = tracing_.tracer();
    PathRequest request;
    const std::shared_ptr<const VertexLight> light = lightFor(region);
    request.vertexLight = light.get();
    alike.deviation = measureDeviation(tracing_.prepared.scene(), objects, rays, sources_, request, tracer);
  });
  return alike.deviation;
}

// The light vertices of the place in the middle of the region's objects; the vertices common to all places if
// the region sees all objects.
std::shared_ptr<const VertexLight> Contrasts::lightFor(const Region& region) const {
  if (!tracing_.pools) return nullptr;
  if (region.objects.size() == objects_.size()) return tracing_.pools->ofAll();
  const Scene& scene = tracing_.prepared.scene();
  const SpecialObject& middle = objects_[region.objects[region.objects.size() / 2]];
  return tracing_.pools->at(bounds(shapeOf(scene, middle), verticesOf(scene, middle)).center(), 0);
}

double typicalRadiance(const SphereTracing& tracing, const SeenSources& sources) {
  PathTracer tracer = tracing.tracer();
  const PreparedScene& prepared = tracing.prepared;
  return measureTypicalView(prepared.scene(), sources, prepared.options().sampling, tracer).mean;
}

}  // namespace rsphere
