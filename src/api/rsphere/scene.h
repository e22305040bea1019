#pragma once
// Light in scenes in RADIANCE's format: along rays, computed like rtrace, and at points, averaged over all
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
  std::array<double, 3> direction;  // of any length; with -ld, its length is that of the ray
};

// A sensor or an eye: a place that receives light in proportion to the cosine, on the side that it faces.
struct Sensor {
  Point point;
  std::array<double, 3> direction;  // the direction that it faces; of any length except 0
};

// A scene read from files.
// 1. It is immutable: several threads may call functions of one scene at a time.
// 2. An answer depends only on the scene, the ray or point, and the options, and not on the number of threads
//    or on other records and calls. (With -u+ it also depends on the position in the call.)
// 3. The preparations for the last options are kept, including interpolated light (-aa), so that repeated
//    calls with equal options are fast. Threads, outputs and colors may differ.
// 4. Files that answers need are read by the constructor, or when options name them. They are searched for
//    along RAYPATH.
class RSPHERE_API Scene {
 public:
  // files: one octree, or files of scene text in order, or '!command's, as on the command line. Throws Error
  // if a file cannot be read or contains an error.
  explicit Scene(const std::vector<std::string>& files, const SceneOptions& options = {});
  ~Scene();
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;

  // Traces rays. Throws Error if the options are invalid, if a number is not finite, or if options.stop
  // requests it.
  RayAnswers trace(std::span<const Ray> rays, const Options& options = {}) const;

  // Computes the light that passes through points from all directions. With -Sp among options.arguments, also
  // the part due to each modifier of light sources. Throws like trace().
  PointAnswers sphere(std::span<const Point> points, const Options& options = {}) const;

  // Computes the importance of goals at points, for all goals in one pass. goals: modifiers whose surfaces
  // emit importance 1 W/sr/m2 from their front, and reflect as before; all other sources are dark. They
  // replace SceneOptions::goals in this call. PointAnswers::contributors are the goals in their order.
  // By reciprocity, importance W(d) (W/sr/m2) from direction d determines the light that the goals receive
  // from a lamp at the point: a lamp of intensity I(d) (cd) gives a goal of area A (m2) the mean illuminance
  // (1/A) integral of I(d) W(d) dd (lx). For 1 cd in all directions it is 4 pi mean / A, and for a small
  // downlight with I(d) = cos(angle to -z) it is faceIrradiance of -z / A.
  // The first call with new goals copies the scene. Throws like trace(), and if there are no goals, if one is
  // named twice, or if one is the modifier of no surface.
  PointAnswers importance(std::span<const Point> points, const std::vector<std::string>& goals,
                          const Options& options = {}) const;

  // importance() with sensors or eyes as goals, which are not in the scene: they block and reflect nothing.
  // Each receives light in proportion to the cosine, like rays with Options::irradianceAtOrigin, and is a
  // goal of area A = 1: a lamp of 1 cd in all directions gives it 4 pi mean (lx). A sensor is a square of
  // side 1e-5 (units of the scene), so that light from a point, directly or by one mirror, has a relative
  // error of the order of 1e-5 / distance. PointAnswers::contributors are sensor1, sensor2 and so on. Throws
  // like importance(), and if a number is not finite or a direction is 0.
  PointAnswers importanceOfSensors(std::span<const Point> points, std::span<const Sensor> sensors,
                                   const Options& options = {}) const;

  // Computes glare at eyes: the origin of each ray is an eye, and its direction (of any length) is the gaze;
  // z is up. Throws like trace(), and if a gaze is 0 or vertical (within 1e-6 rad).
  GlareAnswers glare(std::span<const Ray> eyes, const Options& options = {}) const;

  // Computes the light that surfaces with each of these modifiers send along rays and the paths that start
  // with them. The modifiers may be those of light sources, the sky, goals or any other surfaces. The
  // contributions of all emitters sum to the value of trace() without interpolation (-aa 0). Throws like
  // trace(), and if a modifier is named twice, or if bins are invalid. A modifier that no surface has is a
  // warning, and has zeros.
  Contributions contributions(std::span<const Ray> rays, const std::vector<std::string>& of,
                              const ContributionOptions& options = {}) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

// The middle directions (unit) of a number of zones of equal solid angle, 4 pi / count sr: the zones of
// Options::zones and Bins::zones. Zone 0 is a cap around +z and the last one a cap around -z. In the rows
// between them, zones begin at the azimuth of +x and are numbered towards +y. REQUIRES count >= 1.
RSPHERE_API std::vector<std::array<double, 3>> zoneMiddles(size_t count);

}  // namespace RSPHERE_API_NAMESPACE
