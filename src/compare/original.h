#pragma once
// The original rtrace as a child process.
#include <span>
#include <string>
#include <vector>

#include "cli/option_table.h"
#include "compare/child.h"

namespace rsphere {

struct OriginalProgram {
  std::string path, version;
};

// $RTRACE, a path or a name on PATH; without it the first rtrace on PATH that is not rsphere by that name,
// which its -version tells. Throws rad::Error (Status::system), which says how to point at one, where there
// is none, and where it does not start.
OriginalProgram findOriginal();

// The options to give it for the same answers: those used that are about rays rather than records, and those
// whose defaults in sphere mode are not rtrace's.
std::vector<std::string> originalOptions(const Options& options, std::span<const UsedOption> used);

class Original {
 public:
  // Where the scene is no octree, makes one by the oconv in the program's folder, or on PATH.
  Original(OriginalProgram program, const std::vector<std::string>& scene, bool isOctree,
           std::vector<std::string> options);

  // The numbers that it answers to rays, of six numbers each: `perRay` a ray, for -o letters of numbers. All
  // of them come from one run, so that equal rays get different random numbers. Throws rad::Error
  // (Status::system) with its message where it fails, or answers less.
  std::vector<double> answers(std::span<const double> rays, const std::string& letters, size_t perRay);

  // The surfaces that rays hit.
  std::vector<std::string> surfaces(std::span<const double> rays);

  // CPU time of what was run so far for answers, and of oconv, s.
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
