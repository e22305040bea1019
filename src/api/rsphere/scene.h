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

// A sensor or an eye: a place that receives light by the cosine, from the side that it faces.
struct Sensor {
  Point point;
  std::array<double, 3> direction;  // in which it faces; of any length but 0
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

  // Computes what passes through points from all directions. With -Sp among options.arguments, what each
  // modifier of a light source gives of it. Throws as trace() does.
  PointAnswers sphere(std::span<const Point> points, const Options& options = {}) const;

  // Computes the importance of each goal at points, of all goals in one pass. goals: modifiers whose surfaces
  // emit importance 1 W/sr/m2 from their front and reflect as before; all other sources are dark. They take
  // the place of SceneOptions::goals in this call. PointAnswers::contributors are the goals in their order.
  // By reciprocity, importance W(d) (W/sr/m2) from direction d is what the goals receive from a lamp at the
  // point: a lamp of intensity I(d) (cd) gives a goal of area A (m2) the mean illuminance
  // (1/A) integral of I(d) W(d) dd (lx). For 1 cd in all directions that is 4 pi mean / A, and for a small
  // downlight of I(d) = cos(angle to -z) faceIrradiance of -z / A.
  // The first calls with other goals than the last ones copy the scene. Throws as trace() does, and if there
  // are no goals, if one is named twice, or if no surface has one of the modifiers.
  PointAnswers importance(std::span<const Point> points, const std::vector<std::string>& goals,
                          const Options& options = {}) const;

  // The same for sensors or eyes as goals, which are not in the scene: they block and reflect nothing. Each
  // receives light by the cosine, as rays do with Options::irradianceAtOrigin, and counts as a goal of area
  // A = 1: a lamp of 1 cd in all directions gives it 4 pi mean (lx). What goes straight from a point to a
  // sensor, or by way of one mirror, is exact but for a share of the order of 1e-5 / distance (units of the
  // scene): a sensor is a square with a side of that. PointAnswers::contributors are sensor1, sensor2 and
  // so on. Throws as importance() does, and if a number is not finite or a direction is 0.
  PointAnswers importanceOfSensors(std::span<const Point> points, std::span<const Sensor> sensors,
                                   const Options& options = {}) const;

  // Computes glare at eyes: the origin of each ray is an eye, and its direction (of any length) is the gaze;
  // z is up. Throws as trace() does, and if a gaze has no length or is vertical (within 1e-6 rad).
  GlareAnswers glare(std::span<const Ray> eyes, const Options& options = {}) const;

  // Computes what surfaces with each of these modifiers send along rays and the paths that they begin: light
  // sources, the sky, goals or any others. The contributions of all that emits sum to the value of trace()
  // without interpolation (-aa 0). Throws as trace() does, and if a modifier is named twice, or if bins are
  // wrong. A modifier that the scene lacks has zeros.
  Contributions contributions(std::span<const Ray> rays, const std::vector<std::string>& of,
                              const ContributionOptions& options = {}) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

// The directions (unit) in the middle of each of a number of zones of equal solid angle, 4 pi / count sr: of
// Options::zones and Bins::zones. Zone 0 is a cap around +z and the last one a cap around -z; between them
// lie rows whose zones begin at the azimuth of +x and turn towards +y. REQUIRES count >= 1.
RSPHERE_API std::vector<std::array<double, 3>> zoneMiddles(size_t count);

}  // namespace RSPHERE_API_NAMESPACE
