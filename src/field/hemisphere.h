#pragma once
// Estimates the irradiance at a point from rays over its hemisphere, with its translational gradient and its
// dependence on the normal.
//
// The hemisphere is divided into cells of equal projected solid angle: rings, and sectors of rings. The
// gradient compares neighbouring cells. Source: Ward and Heckbert, "Irradiance Gradients" (Eurographics
// Rendering Workshop 1992), here for cells of equal projected solid angle.
#include <Imath/ImathVec.h>

#include <span>

#include "base/radiometry.h"

namespace rsphere {

using Imath::V3f;

// The bands of a color whose red, green and blue are stored as `channels` in single precision. The ratio of
// each band to its channel is kept, so that the parts of contributors add up to the stored color.
Bands bandsBeside(const V3f& channels, const Color& color);

// A point where indirect light is gathered, over the hemisphere around the normal.
struct GatherSite {
  V3d point{0, 0, 0};
  V3d normal{0, 0, 1};  // unit
};

// Mean distances of the surfaces that are seen from a site (world units), weighted by projected solid angle.
// A direction that hits nothing has infinite distance in the harmonic mean, and is ignored in the root mean
// square.
struct Surroundings {
  double harmonicMean = 0;
  double rootMeanSquare = 0;
  double covered = 0;  // fraction of the directions that hit something
};

// The incident light at a point as moments of the radiance over all directions, up to order 2. They determine
// the irradiance for any normal within about 1% of its maximum. Source: Ramamoorthi and Hanrahan, "An
// efficient representation for irradiance environment maps" (SIGGRAPH 2001). Difference: moments replace
// spherical harmonics.
struct LightMoments {
  float all[3] = {0, 0, 0};                 // per channel: integral of L, divided by pi (W/sr/m2)
  V3f first[3] = {V3f(0), V3f(0), V3f(0)};  // integral of L d, divided by pi
  V3f squares[3] = {V3f(0), V3f(0), V3f(0)},
      products[3] = {V3f(0), V3f(0), V3f(0)};  // of L dd, divided by pi: xx yy zz, yz zx xy

  void add(const LightMoments& other, float share);
  // Irradiance over pi of a surface with this normal (unit).
  float towards(const V3f& normal, int channel) const;
};

// The indirect light at a site, per channel: irradiance over pi, which is the mean radiance over the
// hemisphere weighted by projected solid angle (W/sr/m2), and its gradients.
struct GatheredLight {
  V3f mean{0, 0, 0};
  Bands bands;  // of the mean, in a spectral run; their gradients and moments are those of their channel
  V3f perLength[3] = {V3f(0), V3f(0), V3f(0)};  // gradient in the plane of the site, per world unit
  LightMoments tilted;                          // moments of the light above the surface
  // Standard errors of the brightness of the mean, and of its gradient. They are overestimated, because they
  // include actual differences between cells.
  float noise = 0, noisePerLength = 0;
  float reach = 0;  // harmonic mean distance of the visible surfaces (world units)

  Color color() const { return Color(V3d(mean), bands); }  // of the mean
  void setColor(const Color& color);                       // the mean and its bands
  // Changes the mean, and scales its bands in proportion to their channels.
  void setMean(const V3f& changed);
  // The mean for a surface whose texture perturbs the normal from `normal` to `perturbed` (both unit). Light
  // that arrives from behind the surface or from behind the perturbed surface is excluded.
  Radiance meanOfTilted(const V3d& normal, const V3d& perturbed) const;
};

// The cells of a hemisphere: `rings` rings around the normal, each divided into `sectors` sectors.
class HemisphereCells {
 public:
  // Chooses rings and sectors so that there are about `rays` cells, at least 4.
  explicit HemisphereCells(int rays);

  int count() const { return rings_ * sectors_; }

  // A direction in a cell (unit). It is uniform in projected solid angle if u1, u2 are uniform in [0, 1). x,
  // y, z: an orthonormal frame; z is the normal.
  V3d direction(int cell, double u1, double u2, const V3d& x, const V3d& y, const V3d& z) const;

  // The cell that contains a direction (unit, on the side of z).
  int cellOf(const V3d& direction, const V3d& x, const V3d& y, const V3d& z) const;

  // Irradiance, gradient and moments from the values of all cells. radiance: mean of each cell (W/sr/m2);
  // distance: to the nearest hit in each cell (world units). Distances below `nearest` are raised to it,
  // which bounds the gradient. x, y, z: as in direction().
  GatheredLight sum(std::span<const Radiance> radiance, std::span<const double> distance, double nearest,
                    const V3d& x, const V3d& y, const V3d& z) const;

 private:
  int rings_, sectors_;
};

}  // namespace rsphere
