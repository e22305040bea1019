#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "cli/number_format.h"
#include "cli/output_colors.h"
#include "importance/sphere_options.h"
#include "transport/ray_options.h"

namespace rsphere {

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
