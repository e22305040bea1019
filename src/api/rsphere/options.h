#pragma once
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rsphere/version.h"

namespace RSPHERE_API_NAMESPACE {

// Receives a warning: one line, which begins with its place in the scene if it has one. Called on the thread
// that called the library, before that call returns or throws. An empty function suppresses warnings.
using Warn = std::function<void(std::string_view)>;

// Options for reading a scene.
struct SceneOptions {
  // -Sc  False: the scene is untrusted. Its !commands are rejected, and so are files outside the folders of
  // the scene files and of RAYPATH.
  bool commands = true;
  // -Sg  The modifiers of goals: their surfaces emit importance 1, and all other surfaces emit nothing.
  std::vector<std::string> goals;
  Warn warn;
};

// The bins of a contributing modifier, or of the directions at a point.
struct Bins {
  // Number of zones of equal solid angle, as in zoneMiddles(); the bin of a ray is the zone of its direction
  // when it hits the modifier. 1: a single bin. (For points, use Options::zones.)
  int zones = 1;
  // If it is not empty, used instead of zones: an expression of function files like rcontrib's -b, with -bn,
  // -p and -f for it. Files are searched for along RAYPATH.
  std::string expression, count, parameters;
  std::vector<std::string> files;
};

// Options for answering rays and points. All options of the command rsphere are available. Empty members keep
// the command's defaults, which for rays are those of rtrace, and for points suit means over thousands of
// directions. man/rsphere.1 describes the options by the names given here. Options that have an effect on
// points alone are errors for rays, and the reverse.
struct Options {
  // Light
  std::optional<int> ambientBounces;                  // -ab  diffuse reflections
  std::optional<double> ambientAccuracy;              // -aa  error of interpolation; 0: no interpolation
  std::optional<int> ambientDivisions;                // -ad  indirect rays for a value or a path
  std::optional<int> ambientSuperSamples;             // -as  more of them where light varies
  std::optional<int> ambientResolution;               // -ar  ratio of scene size to finest spacing
  std::optional<std::array<double, 3>> ambientValue;  // -av  W/sr/m2, replaces further reflections
  std::optional<int> limitReflections;                // -lr  most reflections along a path
  std::optional<double> limitWeight;                  // -lw  weight below which paths end
  std::optional<int> rotation;                        // -Sr  selects random numbers, for independent
                                                      // repetitions

  // Rays
  bool irradianceAtOrigin = false;   // -I  irradiance of sensors at the origins, facing along the directions
  bool irradianceAtSurface = false;  // -i  irradiance of the surface that is hit, instead of its radiance

  std::optional<double> accuracy;  // -Sa  relative standard error; of contributions, of their sum

  // Points
  std::optional<int> directions;      // -Sn  base directions at a point
  std::optional<int> mostDirections;  // -Sx  largest number of directions at a point
  std::optional<int> zones;           // -Sz  zones of equal solid angle whose means are also computed
  // -Szb -Szn  bins of directions Dx Dy Dz, used instead of zones: their expression, count, parameters and
  // files. Borders are accurate to .1 degrees.
  std::optional<Bins> directionBins;

  // The quantities to compute: letters of -o. The comments of RayAnswers and PointAnswers give the letter of
  // each member. Empty: "v" for rays; all of GlareAnswers; for points "veECHuk", with zones "veECHukzZ",
  // without e and Z if colors have no standard error (other than RGB and -pY).
  std::string outputs;

  // -n  Number of threads for one call; 0: one for each core. The answers do not depend on it, bit by bit.
  int threads = 0;

  // Further options, as on the command line: {"-ds", ".05", "-pY"}. They override the members above.
  // - -Sg and -Sc must be given in SceneOptions. -S, -Sd, -Sl, -ot and requests such as -help are rejected
  //   with a reason.
  // - Options for the command's input, output and messages have no effect: -h -x -y -t -w, formats and files
  //   of errors.
  std::vector<std::string> arguments;

  Warn warn;

  // If given, it is called about ten times a second, on the thread that called the library. If it returns
  // true, the call ends with Error::Cause::stopped as soon as the rays in progress are finished.
  std::function<bool()> stop;
};

// Options for contributions to rays. Empty members have rcontrib's defaults.
struct ContributionOptions : Options {
  Bins bins;                  // of each modifier
  bool coefficients = false;  // coefficients of the paths to the modifiers, instead of contributed radiance
  // Number of times that each ray is traced with different random numbers. The answer is the mean, and the
  // standard error follows from the spread; 1: no standard error. With an accuracy it is not used: each ray
  // then takes as many samples as the accuracy needs.
  int samples = 8;
};

}  // namespace RSPHERE_API_NAMESPACE
