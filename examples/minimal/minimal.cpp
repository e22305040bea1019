// The smallest program on the library: the mean radiance at one point of a scene.
//   minimal scene.rad [x y z]
#include <fmt/core.h>

#include <cstdlib>
#include <string>

#include "importance/estimator.h"
#include "rad_parser/scene_file.h"
#include "scene/scene.h"
#include "transport/path_tracer.h"

int main(int argc, char** argv) {
  using namespace rsphere;
  if (argc != 2 && argc != 5) {
    fmt::print(stderr, "usage: {} scene.rad [x y z]\n", argv[0]);
    return 1;
  }
  const V3d point =
      argc == 5 ? V3d(std::atof(argv[2]), std::atof(argv[3]), std::atof(argv[4])) : V3d(0, 0, 0);
  try {
    const std::string files[] = {argv[1]};
    const Scene scene = buildScene(rad::readScene(files));

    RayOptions rays;
    rays.ambientBounces = 2;
    rays.ambientAccuracy = 0;
    rays.ambientDivisions = 1;  // of thousands of directions, each needs one indirect path
    const Transport transport(scene, rays, IrradianceAt::none);

    const SphereEstimator estimator(transport, SphereOptions{});
    SphereEstimator::Workspace workspace(estimator);
    const Rgb mean = estimator.estimate(point, workspace).mean.rgb;
    fmt::print("{:.4f} {:.4f} {:.4f}\n", mean.x, mean.y, mean.z);
  } catch (const rad::Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
