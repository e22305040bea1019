#pragma once
// Light in scenes of RADIANCE's format: along rays, as rtrace computes it, and at points, averaged over all
// directions.
//
//   rsphere::Scene scene({"sky.rad", "room.rad"});
//   rsphere::Options options;
//   options.ambientBounces = 5;
//   const rsphere::PointAnswers answers = scene.sphere(std::vector<rsphere::Point>{{4, 2.6, 1.2}}, options);
//   answers.mean[0];  // red, green and blue (W/sr/m2)
#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "rsphere/answers.h"
#include "rsphere/error.h"
#include "rsphere/options.h"
#include "rsphere/version.h"

namespace RSPHERE_API_NAMESPACE {

using Point = std::array<double, 3>;  // x y z, in the units of the scene

struct Ray {
  Point origin;
  std::array<double, 3> direction;  // of any length; with -ld, the ray ends at that length
};

// A scene that was read from files.
// 1. It does not change: any threads may call trace() and sphere() on the same scene at once.
// 2. An answer depends on the scene, the ray or point, and the options. It is the same for any number of
//    threads and whatever else is asked in the same call or before. (With -u+ it also depends on the position
//    in the call.)
// 3. Preparations for the last options are kept, also interpolated light (-aa): repeated calls are fast if
//    their options are the same. Only threads, outputs and colors may differ.
// 4. Files that answers need are read by the constructor, or when options name them. RAYPATH has the folders.
class RSPHERE_API Scene {
 public:
  // files: one octree, or files of scene text in their order, or '!command's, as on the command line.
  // Throws Error if a file cannot be read or holds an error.
  explicit Scene(const std::vector<std::string>& files, const SceneOptions& options = {});
  ~Scene();
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;

  // Traces rays. Throws Error if the options are wrong or a number is not finite, and if options.stop
  // says so.
  RayAnswers trace(std::span<const Ray> rays, const Options& options = {}) const;

  // Computes what passes through points from all directions. Throws as trace() does.
  PointAnswers sphere(std::span<const Point> points, const Options& options = {}) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace RSPHERE_API_NAMESPACE
