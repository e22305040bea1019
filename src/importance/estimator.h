#pragma once
// The radiance that passes through a point from all around, as an average of traced directions, each weighted
// by the solid angle it stands for.
//
// Source: Costa, Sousa, Parracho, Cruz, "A New Technique for Spherical Radiance Calculation" (base
// directions, weights by spherical Voronoi cells).
#include <vector>

#include "cli/answer.h"
#include "cli/options.h"
#include "sphere/voronoi.h"
#include "transport/path_tracer.h"

namespace rsphere {

// One traced direction of a point.
struct DirectionSample {
  double solidAngle = 0;  // sr; those of a point sum to 4 pi
  Ray ray;                // origin is the point
};

// What all threads share: the base directions and their weights. Keeps a reference to transport.
class SphereEstimator {
 public:
  // Throws rad::Error where a weight that the options ask for is not supported yet, or fails its check (-Sv).
  SphereEstimator(const Transport& transport, const SphereOptions& options);

  // What one thread needs.
  struct Workspace {
    explicit Workspace(const SphereEstimator& estimator) : tracer(estimator.transport_) {}
    PathTracer tracer;
    std::vector<DirectionSample> samples;  // of the last point
  };

  // The quantities at a point (world), and the directions in workspace.samples. Depends on point, scene and
  // options alone. Error: that of an equal-weight lattice of -Sn directions for what varies over the sphere,
  // plus the paths' own noise; both fall with -Sn.
  PointAnswer estimate(const V3d& point, Workspace& workspace) const;

 private:
  const Transport& transport_;
  SphereOptions options_;
  std::vector<V3d> base_;
  std::vector<double> baseSolidAngles_;  // sr
};

// The quantities of PointAnswer (all but its standard error) from weighted directions: sums over L w, L w d
// and so on. Definitions: answer.h.
PointAnswer integrate(const V3d& point, const std::vector<DirectionSample>& samples);

// One direction of a point as -Sd prints it.
RayAnswer directionAnswer(const Scene& scene, const DirectionSample& sample);

}  // namespace rsphere
