#include "importance/estimator.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rad_parser/error.h"
#include "sphere/directions.h"

namespace rsphere {

SphereEstimator::SphereEstimator(const Transport& transport, const SphereOptions& options)
    : transport_(transport), options_(options) {
  const auto count = static_cast<size_t>(options.baseDirections);
  base_ = rotatedDirections(baseDirections(count), options.rotation);
  if (options.weights == Weights::homogeneous) {
    baseSolidAngles_.assign(count, 4 * std::numbers::pi / static_cast<double>(count));
    return;
  }
  VoronoiWorkspace workspace;
  const auto areas = cellSolidAngles(base_, workspace);
  baseSolidAngles_.assign(areas.begin(), areas.end());
  if (!options.verify) return;
  if (const auto fault = voronoiFault(workspace)) throw rad::Error("weights of the directions: " + *fault);
}

PointAnswer SphereEstimator::estimate(const V3d& point, Workspace& workspace) const {
  const uint64_t seed =
      seedOf(std::initializer_list<double>{point.x, point.y, point.z}, mixBits(options_.rotation));
  workspace.samples.resize(base_.size());
  for (size_t i = 0; i < base_.size(); ++i)
    workspace.samples[i] = {baseSolidAngles_[i],
                            workspace.tracer.trace(point, base_[i], 0, mixBits(seed + i))};
  return integrate(point, workspace.samples);
}

PointAnswer integrate(const V3d& point, const std::vector<DirectionSample>& samples) {
  PointAnswer a;
  a.point = point;
  a.directions = samples.size();
  std::fill(std::begin(a.facing), std::end(a.facing), Rgb(0, 0, 0));
  Rgb total(0, 0, 0);
  for (const DirectionSample& s : samples) {
    const Rgb part = s.ray.value * s.solidAngle;
    const V3d& d = s.ray.direction;
    total += part;
    a.cylindricalIrradiance += part * (std::sqrt(std::max(0., 1 - d.z * d.z)) / std::numbers::pi);
    for (int axis = 0; axis < 3; ++axis) a.facing[2 * axis + (d[axis] < 0)] += part * std::abs(d[axis]);
    a.lightVector += brightness(part) * d;
  }
  a.mean = total / (4 * std::numbers::pi);
  a.scalarIrradiance = total / 4.;
  return a;
}

RayAnswer directionAnswer(const Scene& scene, const DirectionSample& sample) {
  RayAnswer a = answerOf(scene, sample.ray);
  a.solidAngle = sample.solidAngle;
  return a;
}

}  // namespace rsphere
