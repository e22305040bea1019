#pragma once
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rsphere/version.h"

namespace RSPHERE_API_NAMESPACE {

// Receives a warning: one line, which begins with its place in the scene if it has one. It is called on the
// thread that called the library, before the call returns or throws. An empty function drops warnings.
using Warn = std::function<void(std::string_view)>;

// How a scene is read.
struct SceneOptions {
  // -Sc  False: the scene is untrusted. Its !commands are refused, and so are files outside the folders of
  // the scene files and of RAYPATH.
  bool commands = true;
  // -Sg  The modifiers of goals: their surfaces emit importance 1, and all others nothing.
  std::vector<std::string> goals;
  Warn warn;
};

// The bins of a modifier that contributes to rays, or of the directions at a point.
struct Bins {
  // Zones of equal solid angle in which the directions of rays lie that meet the modifier, numbered as
  // zoneMiddles() has them. 1: a single bin. (At a point, Options::zones.)
  int zones = 1;
  // Or, if it is not empty, an expression of function files as rcontrib's -b, and -bn -p -f for it. The files
  // are searched for along RAYPATH.
  std::string expression, count, parameters;
  std::vector<std::string> files;
};

// How rays and points are answered. All options of the command rsphere work here. Members that are empty
// leave the command's default, which is rtrace's for rays, and for points one that suits means over thousands
// of directions. man/rsphere.1 describes each option by the name behind its member.
struct Options {
  // Light
  std::optional<int> ambientBounces;                  // -ab  diffuse reflections
  std::optional<double> ambientAccuracy;              // -aa  error of interpolation; 0: no interpolation
  std::optional<int> ambientDivisions;                // -ad  indirect rays for a value or a path
  std::optional<int> ambientSuperSamples;             // -as  more of them where light varies
  std::optional<int> ambientResolution;               // -ar  size of the scene over finest spacing
  std::optional<std::array<double, 3>> ambientValue;  // -av  W/sr/m2 instead of further reflections
  std::optional<int> limitReflections;                // -lr  most reflections along a path
  std::optional<double> limitWeight;                  // -lw  paths of less weight end
  std::optional<int> rotation;                        // -Sr  random numbers, for independent repeats

  // Rays
  bool irradianceAtOrigin = false;   // -I  of sensors at the origins, facing along the directions
  bool irradianceAtSurface = false;  // -i  of the surface that is hit, instead of its radiance

  // Points
  std::optional<int> directions;      // -Sn  base directions at a point
  std::optional<int> mostDirections;  // -Sx  most directions at a point in all
  std::optional<double> accuracy;     // -Sa  relative standard error to reach with more directions
  std::optional<int> zones;           // -Sz  zones of equal solid angle, whose means are computed, too
  // -Szb -Szn  instead of zones, bins of the directions Dx Dy Dz in which a point looks: the expression, its
  // count, parameters and files. Borders are followed to .1 degrees.
  std::optional<Bins> directionBins;

  // The quantities to compute: letters of -o, each of which fills the member of RayAnswers or PointAnswers
  // behind whose name it is. Empty: "v" for rays; all of GlareAnswers; for points "veECHuk", with zones
  // "veECHukzZ", without e and Z where colors have no standard error (other than RGB and -pY).
  std::string outputs;

  // -n  Threads that work on one call; 0: one for each core. They leave the answers the same, bit by bit.
  int threads = 0;

  // Further options as on the command line: {"-ds", ".05", "-pY"}. They come after those above and prevail.
  // - -Sg and -Sc belong in SceneOptions; -S, -Sd, -Sl, -ot and requests such as -help are refused, with the
  //   reason.
  // - Those of the command's input, output and messages have no effect: -h -x -y -t -w, formats and files of
  //   errors.
  std::vector<std::string> arguments;

  Warn warn;

  // If given, it is asked about ten times a second, on the thread that called the library, whether to give
  // up: true ends the call with Error::Cause::stopped as soon as the rays that are being traced are done.
  std::function<bool()> stop;
};

// How contributions to rays are computed. The members left empty have the defaults of rcontrib.
struct ContributionOptions : Options {
  Bins bins;                  // of each modifier
  bool coefficients = false;  // factors on the radiance of the modifiers, instead of what they contribute
  // Times that each ray is traced, with other random numbers. Their mean is the answer, and their spread
  // gives its standard error; 1: there is no standard error.
  int samples = 8;
};

}  // namespace RSPHERE_API_NAMESPACE
