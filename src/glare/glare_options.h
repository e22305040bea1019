#pragma once

namespace rsphere {

// What glare at an eye is computed from.
struct GlareOptions {
  bool wanted = false;  // -Su
  // -Sub  Other regions than light sources are glare sources if their luminance is above this: cd/m2 if it is
  // above kFixed, otherwise a multiple of the mean luminance of the task, or without a task of all that the
  // eye sees.
  double threshold = 2000;
  // -Sut  The task is a disk around a direction that lies this far below the line of sight; degrees.
  double taskBelow = 0;
  double taskOpening = 0;  // diameter of the disk, degrees; 0: no task

  static constexpr double kFixed = 100;
  bool isFixed() const { return threshold > kFixed; }
};

}  // namespace rsphere
