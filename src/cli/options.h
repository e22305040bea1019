#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/rgb.h"

namespace rsphere {

// -e expression and -f file: definitions for all function files.
struct SharedDefinitions {
  bool isFile = false;
  std::string text;  // the expression, or the name of the file, looked for along RAYPATH
};

// What steers a ray's path: rtrace's options, under the names rtrace(1) explains. Defaults are rtrace's (ray
// mode); sphere mode has its own, see modeDefaults() of option_table.h.
struct RayOptions {
  // direct light
  double directThreshold = .03;      // -dt  share of the possible contribution left untested
  double directCertainty = .75;      // -dc
  double directJitter = 0;           // -dj  0 to 1
  double sourceSubstructuring = .2;  // -ds  largest size/distance of a source's part; 0: not divided
  int directRelays = 2;              // -dr
  int chosenSources = 0;             // -Ss  tested at a surface, drawn at random; 0: all of them
  int directPretest = 512;           // -dp
  bool sourcesVisible = true;        // -dv  whether a directly seen source is its radiance, not black
  // specular
  double specularSampling = 1;     // -ss
  double specularThreshold = .15;  // -st
  // indirect
  int ambientBounces = 0;         // -ab
  double ambientAccuracy = .1;    // -aa
  int ambientResolution = 256;    // -ar
  int ambientDivisions = 1024;    // -ad
  int ambientSuperSamples = 512;  // -as
  Rgb ambientValue{0, 0, 0};      // -av  W/sr/m2
  int ambientWeight = 0;          // -aw
  std::string ambientFile;        // -af
  double fieldMemory = 0;         // -Sm  MB; 0: no bound
  std::vector<std::string> ambientExcluded,
      ambientIncluded;  // -ae -aE, -ai -aI (at most one of the two is not empty)
  // limits
  int reflectionLimit = -10;  // -lr  negative: Russian roulette below -lw, from depth -lr
  double weightLimit = 1e-4;  // -lw
  // medium
  Rgb mediumExtinction{0, 0, 0};  // -me  per unit length
  Rgb mediumAlbedo{0, 0, 0};      // -ma
  double mediumEccentricity = 0;  // -mg
  double mediumSampling = 0;      // -ms  unit lengths; 0: whole
  // others
  std::vector<SharedDefinitions> definitions;  // -e -f, in their order
  bool backFacesVisible = true;                // -bv
  // random numbers
  bool uncorrelated = true;  // -u  changes nothing; see Options::numberedRays
  uint64_t rotation = 0;     // -Sr
};

enum class Irradiance : uint8_t { none, surface /* -i */, point /* -I */ };

enum class Weights : uint8_t { homogeneous /* h */, voronoi /* v */, silhouettes /* c */ };

struct SphereOptions {
  bool on = true;                          // -S
  int baseDirections = 2048;               // -Sn  1 to 1,000,000
  int mostDirections = 4096;               // -Sx
  int mostForAccuracy = 0;                 // of all sets of -Sa together, where that is more than -Sx
  double densityFactor = 1;                // -Sk
  double accuracy = 0;                     // -Sa  0: off
  Weights weights = Weights::silhouettes;  // -Sw
  std::vector<std::string> goals;          // -Sg
  bool basicRadiance = false;              // -Sb
  bool everyDirection = false;             // -Sd
  uint64_t rotation = 0;                   // -Sr
  bool verify = false;                     // -Sv
  std::string picture;                     // -Si
  bool listSpecial = false;                // -Sl

  // Directions of one point, of all sets that -Sa averages.
  int mostOfAllSets() const { return std::max(mostDirections, mostForAccuracy); }
};

enum class NumberFormat : char { ascii = 'a', float32 = 'f', float64 = 'd', rgbe = 'c' };

enum class ColorSpace : uint8_t {
  rgb,
  xyz,        // -pXYZ  tristimulus values, Y in lumens
  primaries,  // -pc
  photopic,   // -pY -pS -pM: one channel, in lumens (-pM: as rtrace scales it)
  scotopic,
  melanopic,
  average,  // -pA  one channel
  spectrum  // -co
};

// How colors are written.
struct ColorOptions {
  ColorSpace space = ColorSpace::rgb;
  std::array<double, 8> primaries{};     // x y of red, green, blue and white
  int bands = 3;                         // -cs  at most kMostBands count
  double shortest = 380, longest = 780;  // -cw  nm
};
inline constexpr int kMostBands = 24;

// What the command line asks for: answers, or something to be printed instead of them.
enum class Request : uint8_t { answers, version, defaults, help, features };

// Everything the command line says, checked but not acted upon: no file has been opened.
struct Options {
  RayOptions ray;
  SphereOptions sphere;
  bool irradianceAtHit = false, irradianceAtPoint = false;  // -i -I as given
  Irradiance irradiance = Irradiance::none;                 // which of them counts: -I, if both are on
  NumberFormat in = NumberFormat::ascii, out = NumberFormat::ascii;  // -f
  std::string outputs;       // -o letters; the mode's default where not given
  std::string treeOutputs;   // those behind t or T: of every ray on the way. Empty: no trees
  bool treeShadows = false;  // -o..T: shadow rays, too
  std::vector<std::string> treeExcluded, treeIncluded;  // -te -tE, -ti -tI (at most one is not empty)
  ColorOptions color;
  int64_t width = 0, height = 0;   // -x -y
  bool limitDistance = false;      // -ld
  bool numberedRays = false;       // -u+ was given: random numbers depend on the number of a ray as well
  bool header = true;              // -h
  bool warnings = true;            // -w
  int threads = 1;                 // -n; 0: all cores
  double progressSeconds = 0;      // -t; 0: none
  std::string errorFile;           // -e
  bool commands = true;            // -Sc
  std::vector<std::string> scene;  // octree, .rad files or '!command'
  std::vector<std::string> words;  // the command line after @file and $VAR were put in place, without the
                                   // scene: for the header
  std::string program;             // argv[0] without its folder
  Request request = Request::answers;
  std::vector<std::string> features;  // the words after -features
  std::vector<std::string> remarks;   // what Messages::use() has to warn of
  double photonRadius = 0;            // -am  accepted and printed by -defaults; photon maps are not read
};

}  // namespace rsphere
