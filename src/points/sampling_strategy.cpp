#include "points/sampling_strategy.h"

#include "sphere/directions.h"

namespace rsphere {

SetAtPoint::SetAtPoint(const V3d& point, uint64_t number, uint64_t rotation, const std::optional<V3d>& gaze)
    : point_(point),
      gaze_(gaze),
      number_(number),
      seed_(seedOf(std::initializer_list<double>{point.x, point.y, point.z},
                   mixBits(rotation + (number << 32)))) {}

std::vector<V3d> SetAtPoint::turned(std::span<const V3d> directions) const {
  if (isFirst()) return {directions.begin(), directions.end()};
  return rotatedDirections(directions, mixBits(seed_));
}

void SampledSet::setVariance(const Neighbours& neighbours, const BaseSet& base) {
  ofKernels = KernelVariances(base.kernels);
  variance = evenVariance(samples, neighbours, base.sampling, &ofKernels);
  ofKernels.addQuantities([&](size_t quantity) {
    return evenVariance(weighted(samples, base.kernels, quantity), neighbours, base.sampling);
  });
}

Moments SampledSet::moments(const BaseSet& base, const std::optional<V3d>& gaze) const {
  Moments moments(base.kernels.zones.get(), gaze);
  for (const DirectionSample& s : samples)
    moments.add(s.direction, irradianceFrom(s.value, s.solidAngle), base.sampling, s.solidAngle,
                !s.toSource && s.region == 0);
  moments.add(excess, 1);
  return moments;
}

SampledSet traceEach(const SetAtPoint& set, std::span<const V3d> directions,
                     std::span<const double> solidAngles, bool keepRays, PathTracer& tracer) {
  SampledSet sampled;
  sampled.samples.reserve(directions.size());
  for (size_t i = 0; i < directions.size(); ++i) {
    const TracedRay ray = tracer.trace(set.point(), directions[i], 0, mixBits(set.seed() + i));
    sampled.samples.push_back({directions[i], solidAngles[i], ray.value});
    if (keepRays) sampled.rays.push_back(ray);
  }
  return sampled;
}

}  // namespace rsphere
