#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "answer/number_format.h"
#include "answer/output_colors.h"
#include "importance/sphere_options.h"
#include "scene/sensors.h"
#include "transport/ray_options.h"

namespace rsphere {

// Everything that the answers to the records of a run depend on, and how they are written.
struct AnswerOptions {
  bool sphereMode = true;  // -S; else ray mode
  RayOptions ray;
  SphereOptions sphere;
  // scene
  std::vector<std::string> scene;         // an octree, .rad files or '!command'
  bool commands = true;                   // -Sc  whether commands in the scene may run
  std::vector<std::string> goals;         // -Sg
  std::vector<Sensor> sensors;            // -SG  goals as well
  bool separate = false;                  // -Sp  the part of each goal, or of each light source's modifier
  std::vector<std::string> contributors;  // their names; set once the scene is read. Empty: no parts
  // input
  NumberFormat in = NumberFormat::ascii;         // -f
  IrradianceAt irradiance = IrradianceAt::none;  // -i -I
  bool limitDistance = false;                    // -ld
  bool numberedRays = false;  // -u+ was given: random numbers also depend on the number of a ray
  // output
  NumberFormat out = NumberFormat::ascii;  // -f
  std::string outputs;                     // -o letters; the mode's default where not given
  std::string treeOutputs;   // -o letters behind t or T, for each ray of a tree; empty: no trees
  bool treeShadows = false;  // -o..T: shadow rays as well
  std::vector<std::string> treeExcluded, treeIncluded;  // -te -tE, -ti -tI; one or both are empty
  ColorOptions color;
  int64_t width = 0, height = 0;   // -x -y
  bool header = true;              // -h
  std::string program;             // argv[0] without its folder; it and the words are for the header
  std::vector<std::string> words;  // the command line between program and scene, with @file and $VAR replaced
  std::string picture;             // -Si  the name of the pictures; empty: none
  RayOptions pictureRay;           // how their rays are traced
  bool listSpecial = false;        // -Sl  a list of the special objects instead of answers
  // work
  int threads = 1;             // -n; 0: one for each core
  double progressSeconds = 0;  // -t; 0: no progress reports
  bool progressGiven = false;  // -t was given

  // Numbers of an input record: x y z of a point, or origin and direction of a ray, or an eye and its gaze.
  int numbersPerRecord() const { return sphereMode && !sphere.glare.wanted ? 3 : 6; }
};

}  // namespace rsphere
