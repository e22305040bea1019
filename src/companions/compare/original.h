#pragma once
// RADIANCE's rtrace, which runs as a child process.
#include <span>
#include <string>
#include <vector>

#include "cli/option_table.h"
#include "companions/compare/child.h"

namespace rsphere {

struct OriginalProgram {
  std::string path, version;
};

// Finds the original: $RTRACE, a path or a name on PATH, if it is set; otherwise the first rtrace on PATH
// whose -version does not name rsphere. Throws rad::Error (Status::system) if there is none, with advice on
// how to set it, or if it cannot be run.
OriginalProgram findOriginal();

// The options with which the original computes the quantities of this run: those in `used` that affect rays
// rather than records, and in sphere mode those whose defaults differ from rtrace's. In a spectral run the
// original writes bands (-co), otherwise red, green and blue.
std::vector<std::string> originalOptions(const Options& options, std::span<const UsedOption> used);

class Original {
 public:
  // If the scene is not an octree, creates one with the oconv in the program's folder or, if there is none,
  // on PATH. Throws rad::Error (Status::system) if this fails.
  Original(OriginalProgram program, const std::vector<std::string>& scene, bool isOctree,
           std::vector<std::string> options);

  // The original's answers to rays (six numbers each): `perRay` numbers for each ray, selected by `letters`
  // of -o. All come from a single run, so that equal rays get different random numbers. Throws rad::Error
  // (Status::system), with the original's message, if it fails or returns a different number of values.
  std::vector<double> answers(std::span<const double> rays, const std::string& letters, size_t perRay);

  // The names of the surfaces hit by rays.
  std::vector<std::string> surfaces(std::span<const double> rays);

  // CPU time in seconds: of all calls of answers(), and of oconv.
  double seconds() const { return seconds_; }
  double octreeSeconds() const { return octreeSeconds_; }

 private:
  std::string run(std::span<const double> rays, std::vector<std::string> more);

  OriginalProgram program_;
  std::vector<std::string> options_;
  MemoryFile octree_;
  std::string octreeName_;
  double seconds_ = 0, octreeSeconds_ = 0;
};

}  // namespace rsphere
