#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "pictures/point_picture.h"
#include "points/sphere_options.h"
#include "rays/ray_options.h"
#include "records/number_text.h"
#include "records/output_colors.h"
#include "scene/sensors.h"

namespace rsphere {

// All options that determine the answers to the records of a run, and how they are written.
struct AnswerOptions {
  bool sphereMode = true;  // -S; else ray mode
  RayOptions ray;
  SphereOptions sphere;
  // scene
  std::vector<std::string> scene;         // an octree, .rad files or '!command'
  bool commands = true;                   // -Sc  whether commands in the scene may run
  std::vector<std::string> goals;         // -Sg
  std::vector<Sensor> sensors;            // goals in addition to -Sg
  bool separate = false;                  // whether the part due to each goal, or to each light source's
                                          // modifier, is reported
  std::vector<std::string> contributors;  // their names, set after the scene is read; empty: no parts
  // input
  NumberFormat in = NumberFormat::ascii;         // -f
  IrradianceAt irradiance = IrradianceAt::none;  // -i -I
  bool limitDistance = false;                    // -ld
  bool numberedRays = false;  // -u+ was given: random numbers also depend on the number of a ray
  // output
  NumberFormat out = NumberFormat::ascii;  // -f
  std::string outputs;                     // -o letters; if none are given, the default of the mode
  std::string treeOutputs;                 // -o letters after t or T, for each ray of a tree; empty: no trees
  bool treeShadows = false;                // -o..T: trees include shadow rays
  std::vector<std::string> treeExcluded, treeIncluded;  // -te -tE, -ti -tI; at least one is empty
  ColorOptions color;
  int64_t width = 0, height = 0;   // -x -y
  bool header = true;              // -h
  bool namesColumns = false;       // -Sf
  std::string program;             // argv[0] without its folder; for the header, like `words`
  std::vector<std::string> words;  // the command line between program and scene, with @file and $VAR replaced
  std::string picture;             // -Si  name of the pictures; empty: none
  PictureForm pictureForm;         // -Siw -Siv -Sih -Sie
  RayOptions pictureRay;           // options of the pictures' rays
  bool listSpecial = false;        // -Sl  lists the special objects instead of answering records
  // work
  int threads = 1;             // -n; 0: one for each core
  double progressSeconds = 0;  // -t; 0: no progress reports
  bool progressGiven = false;  // -t was given

  // Whether rays are estimated by several independent sets, for their standard errors or an accuracy.
  bool estimatesRays() const {
    return !sphereMode && (sphere.accuracy > 0 || outputs.find('e') != std::string::npos);
  }

  // Number of values in an input record: x y z of a point, origin and direction of a ray, or an eye and its
  // gaze.
  int numbersPerRecord() const { return sphereMode && !sphere.glare.wanted ? 3 : 6; }
};

}  // namespace rsphere
