#pragma once
// Indirect light at a place, from rays over its hemisphere: how much there is, and how it changes when the
// place moves or its surface tilts.
//
// The hemisphere is divided into rings of equal projected solid angle, and those into sectors; a ray each,
// and more where the values around differ. Source of the changes: Ward and Heckbert, "Irradiance Gradients"
// (Eurographics Rendering Workshop 1992), for cells of equal projected solid angle.
#include <Imath/ImathVec.h>

#include <cstdint>
#include <span>
#include <vector>

#include "cli/rgb.h"

namespace rsphere {

using Imath::V3f;

// A place that indirect light is gathered at, on the side of the normal.
struct GatherSite {
  V3d point{0, 0, 0};
  V3d normal{0, 0, 1};  // unit
};

// The indirect light of a site: mean radiance over the hemisphere by projected solid angle (irradiance over
// pi; W/sr/m2), and its change, by channel, as vectors in the site's plane.
struct GatheredLight {
  V3f mean{0, 0, 0};
  V3f perLength[3];  // when the site moves, per world unit
  V3f perTilt[3];    // when its normal tilts, per sine of the angle: mean times the cosine comes before it
  // How much of it may be chance, of the brightness, as standard errors: of the mean, and of its change per
  // length. What really differs from cell to cell is counted in, so they are rather too great.
  float noise = 0, noisePerLength = 0;
  float reach = 0;  // harmonic mean of the distances to what gives it (world units)
};

// A hemisphere's cells: ring j of `rings` from the normal outwards, sector k of `sectors`.
class HemisphereCells {
 public:
  // About `rays` cells, at least 4.
  explicit HemisphereCells(int rays);

  int rings() const { return rings_; }
  int sectors() const { return sectors_; }
  int count() const { return rings_ * sectors_; }

  // A direction of a cell (unit), uniform by projected solid angle for uniform u1, u2 in [0, 1). x, y, z: a
  // frame, z the normal.
  V3d direction(int cell, double u1, double u2, const V3d& x, const V3d& y, const V3d& z) const;

  // How many of `more` rays each cell gets besides its first: in proportion to how much the first values of
  // the cells around it differ. Its own value has no say, which would make bright accidents count for less.
  std::vector<int> refinement(std::span<const double> brightness, int more) const;

  // The sum of it all. radiance: by cell, the mean of its `rays`; distance: the nearest that one of them
  // hit, taken to be `nearest` at least (world units), which bounds the change per length.
  GatheredLight sum(std::span<const Rgb> radiance, std::span<const int> rays,
                    std::span<const double> distance, double nearest, const V3d& x, const V3d& y) const;

 private:
  int rings_, sectors_;
};

}  // namespace rsphere
