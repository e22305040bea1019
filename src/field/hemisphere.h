#pragma once
// Irradiance at a point from rays over its hemisphere, with its translational gradient and its dependence on
// the normal.
//
// The hemisphere is divided into cells of equal projected solid angle: rings, and sectors of rings. The
// gradient compares neighbouring cells. Source: Ward and Heckbert, "Irradiance Gradients" (Eurographics
// Rendering Workshop 1992), here for cells of equal projected solid angle.
#include <Imath/ImathVec.h>

#include <cstdint>
#include <span>
#include <vector>

#include "base/radiometry.h"

namespace rsphere {

using Imath::V3f;

// The bands of a color whose red, green and blue are stored as `channels`, in single precision. Each band
// keeps its ratio to its channel, so that the parts of contributors add up to what is stored.
Bands bandsBeside(const V3f& channels, const Color& color);

// A point where indirect light is gathered, over the hemisphere around the normal.
struct GatherSite {
  V3d point{0, 0, 0};
  V3d normal{0, 0, 1};  // unit
};

// How far the surfaces are that are seen from a site (world units), averaged over the hemisphere by projected
// solid angle. A direction that hits nothing counts as infinite distance in the harmonic mean, and not at all
// in the root mean square.
struct Surroundings {
  double harmonicMean = 0;
  double rootMeanSquare = 0;
  double covered = 0;  // share of the directions that hit something
};

// The incident light at a point as moments of radiance over directions, up to the second. They determine the
// irradiance for any normal to about 1% of its maximum. Source:
// Ramamoorthi and Hanrahan, "An efficient representation for irradiance environment maps" (SIGGRAPH 2001),
// with moments in place of spherical harmonics.
struct LightMoments {
  float all[3] = {0, 0, 0};                 // by channel: integral of L, over pi (W/sr/m2)
  V3f first[3] = {V3f(0), V3f(0), V3f(0)};  // of L d
  V3f squares[3] = {V3f(0), V3f(0), V3f(0)},
      products[3] = {V3f(0), V3f(0), V3f(0)};  // of L dd: xx yy zz, yz zx xy

  void add(const LightMoments& other, float share);
  // Irradiance over pi of a surface with this normal (unit).
  float towards(const V3f& normal, int channel) const;
};

// The indirect light of a site: irradiance over pi, that is mean radiance over the hemisphere weighted by
// projected solid angle (W/sr/m2), and its gradients, by channel.
struct GatheredLight {
  V3f mean{0, 0, 0};
  Bands bands;  // of the mean, in a spectral run; gradients and moments of a band are those of its channel
  V3f perLength[3] = {V3f(0), V3f(0), V3f(0)};  // gradient in the plane of the site, per world unit
  LightMoments tilted;                          // moments of the light above the surface
  // Standard errors of the brightness: of the mean, and of its gradient. They are overestimates, because they
  // include the real differences between cells.
  float noise = 0, noisePerLength = 0;
  float reach = 0;  // harmonic mean distance of the surfaces that are seen (world units)

  Color color() const { return Color(V3d(mean), bands); }  // of the mean
  void setColor(const Color& color);                       // the mean and its bands
  // Changes the mean, and its bands in proportion to their channels.
  void setMean(const V3f& changed);
  // The mean if a texture perturbs the normal of the surface from `normal` to `perturbed` (both unit). Light
  // from behind either of the two is excluded.
  Radiance meanOfTilted(const V3d& normal, const V3d& perturbed) const;
};

// The cells of a hemisphere: `rings` rings from the normal outwards, each of `sectors` sectors.
class HemisphereCells {
 public:
  // About `rays` cells, at least 4.
  explicit HemisphereCells(int rays);

  int rings() const { return rings_; }
  int sectors() const { return sectors_; }
  int count() const { return rings_ * sectors_; }

  // A direction in a cell (unit), uniform by projected solid angle for uniform u1, u2 in [0, 1). x, y, z:
  // orthonormal frame, z the normal.
  V3d direction(int cell, double u1, double u2, const V3d& x, const V3d& y, const V3d& z) const;

  // The cell that contains a direction (unit, on the side of z).
  int cellOf(const V3d& direction, const V3d& x, const V3d& y, const V3d& z) const;

  // Irradiance, gradient and moments from the values of all cells. radiance: mean of each cell (W/sr/m2);
  // distance: of the nearest hit in each cell (world units). Distances below `nearest` are raised to it,
  // which bounds the gradient. x, y, z: as for direction().
  GatheredLight sum(std::span<const Radiance> radiance, std::span<const double> distance, double nearest,
                    const V3d& x, const V3d& y, const V3d& z) const;

 private:
  int rings_, sectors_;
};

}  // namespace rsphere
