#pragma once

namespace rsphere {

struct GlareOptions {
  bool wanted = false;  // -Su
  // -Sub  Luminance above which regions other than light sources are glare sources. Values above kFixed are
  // in cd/m2. Smaller values are factors on the mean luminance of the task or, without a task, of the whole
  // view.
  double threshold = 2000;
  // -Sut  The task is a disk around the direction this far below the line of sight; degrees.
  double taskBelow = 0;
  double taskOpening = 0;  // diameter of the disk, degrees; 0: no task

  static constexpr double kFixed = 100;
  bool isFixed() const { return threshold > kFixed; }
};

}  // namespace rsphere
