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

// How light arrives at a point, as far as the irradiance of a surface depends on its normal: the moments of
// radiance over directions up to the second, which tell it to 1% or so of the most there is. Source:
// Ramamoorthi and Hanrahan, "An efficient representation for irradiance environment maps" (SIGGRAPH 2001),
// with moments in place of spherical harmonics.
struct LightMoments {
  float all[3] = {0, 0, 0};                 // by channel: integral of L over pi (W/sr/m2)
  V3f first[3] = {V3f(0), V3f(0), V3f(0)};  // of L d
  V3f squares[3] = {V3f(0), V3f(0), V3f(0)},
      products[3] = {V3f(0), V3f(0), V3f(0)};  // of L dd: xx yy zz, yz zx xy

  void add(const LightMoments& other, float share);
  // Irradiance over pi of a surface with this normal (unit).
  float towards(const V3f& normal, int channel) const;
};

// The indirect light of a site: mean radiance over the hemisphere by projected solid angle (irradiance over
// pi; W/sr/m2), and its changes, by channel.
struct GatheredLight {
  V3f mean{0, 0, 0};
  V3f perLength[3] = {V3f(0), V3f(0), V3f(0)};  // when the site moves in its plane, per world unit
  LightMoments tilted;                          // of what arrives above its surface
  // How much of it may be chance, of the brightness, as standard errors: of the mean, and of its change per
  // length. What really differs from cell to cell is counted in, so they are rather too great.
  float noise = 0, noisePerLength = 0;
  float reach = 0;  // harmonic mean of the distances to what gives it (world units)

  // The mean where the surface's normal is perturbed from one to another (unit): light that arrives from
  // behind either of the two does not count.
  V3f meanOfTilted(const V3d& normal, const V3d& perturbed) const;
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

  // The cell that a direction (unit, on the side of z) lies in.
  int cellOf(const V3d& direction, const V3d& x, const V3d& y, const V3d& z) const;

  // The sum of it all. radiance: by cell; distance: the nearest that a ray in it hit, taken to be `nearest`
  // at least (world units), which bounds the change per length. x, y, z: as for direction().
  GatheredLight sum(std::span<const Rgb> radiance, std::span<const double> distance, double nearest,
                    const V3d& x, const V3d& y, const V3d& z) const;

 private:
  int rings_, sectors_;
};

}  // namespace rsphere
