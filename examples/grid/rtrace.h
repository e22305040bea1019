#pragma once
#include <Imath/ImathVec.h>

#include <span>
#include <string>
#include <vector>

namespace grid {

// Whether $RTRACE names another rtrace, which may be one that states no errors.
bool isOtherRtrace();

struct Illuminances {
  std::vector<double> values;  // lx, or W/m2
  std::vector<double> errors;  // standard errors; empty: those of another rtrace
};

// The illuminances of sensors at these points that face along the normal, by running rtrace with these
// options on these scene files. The program is $RTRACE, or else the rsphere beside this program, or else the
// rtrace of PATH. Throws rad::Error if it cannot be run, fails, or does not answer every point; its own
// messages go to standard error. If rsphere fails, this program ends with its status: rsphere has said why,
// in this program's name. radiant: irradiances in W/m2, the means of the channels.
Illuminances traceIlluminances(std::span<const Imath::V3d> points, const Imath::V3d& normal,
                               const std::vector<std::string>& options, const std::vector<std::string>& files,
                               bool radiant);

}  // namespace grid
