#pragma once
// Indices of discomfort glare at an eye. Luminances are in cd/m2, illuminances in lx, solid angles in sr.
#include <span>

#include "glare/position_index.h"

namespace rsphere {

// The light of one glare source at the eye: integrals over the directions in which the source is seen.
// Integrals may be added up, or averaged over estimates.
struct SeenGlare {
  double solidAngle = 0;
  double light = 0;        // integral of luminance, cd/m2 sr
  double illuminance = 0;  // integral of luminance times the cosine of the angle to the line of sight
  V3d towards{0, 0, 0};    // integral of luminance times direction

  SeenGlare& operator+=(const SeenGlare& other);
  SeenGlare operator*(double factor) const;

  double luminance() const { return solidAngle > 0 ? light / solidAngle : 0; }
  // The middle of the source's light, as in CIE 117 and evalglare.
  V3d direction() const { return towards.normalized(); }
  double positionIndex(const Gaze& gaze) const { return rsphere::positionIndex(direction(), gaze); }
  // L^2 omega / P^2, with the mean luminance L.
  double weight(const Gaze& gaze) const;
};

// Unified glare rating. Source: CIE 117-1995, 8 lg(.25 / Lb sum(L^2 omega / P^2)). background: luminance Lb.
// sum: of the weights of the sources. As in evalglare, 0 if there is no source. Infinite if there are sources
// and the background is black.
double unifiedGlareRating(double background, double sum);

// Daylight glare probability, 0 to 1: the fraction of people who are disturbed. Source: Wienold and
// Christoffersen 2006, Energy and Buildings 38, 743-757,
//   5.87e-5 Ev + .0918 lg(1 + sum(L^2 omega / P^2) / Ev^1.87) + .16
// It omits the correction for dim scenes of Wienold 2009 (Building Simulation), which evalglare applies only
// on request (-C l+). illuminance: Ev at the eye, in a plane perpendicular to the line of sight. sum: of the
// weights of the sources.
double daylightGlareProbability(double illuminance, double sum);

struct GlareIndices {
  double ugr = 0;
  double illuminance = 0;  // at the eye, lx
  double background = 0;   // (illuminance - that due to the sources) / pi, cd/m2; at least 0
  double dgp = 0;
};

// illuminance: of all light at the eye.
GlareIndices glareIndices(double illuminance, std::span<const SeenGlare> sources, const Gaze& gaze);

}  // namespace rsphere
