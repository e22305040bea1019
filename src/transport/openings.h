#pragma once
// Where daylight comes in: panes between a bright side and a dark one. A small window is met by few of a
// hemisphere's directions, and brings most of the light; so a share of the rays of a gather is aimed at it,
// and each ray is weighted by all the ways in which it might have been chosen (multiple importance sampling,
// the balance heuristic: Veach and Guibas 1995). How well openings are found decides how much answers
// scatter, not what they are in the mean.
//
// Anchor: Bitterli, Novák, Jarosz, "Portal-masked environment map sampling" (Computer Graphics Forum 34,
// 2015). What differs: portals are found rather than named, and sampled by area.
#include <functional>
#include <vector>

#include "scene/scene.h"

namespace rsphere {

class Openings {
 public:
  // The radiance (brightness, W/sr/m2) that comes back along a ray from a point in a direction (unit).
  using Probe = std::function<double(const V3d& origin, const V3d& direction, uint64_t seed)>;

  // Finds the panes of the scene and asks on both sides how bright it is beyond; the same scene and probe
  // give the same openings. bounds: of all that can be hit.
  Openings(const Scene& scene, const Box3d& bounds, const Probe& probe);

  bool empty() const { return openings_.empty(); }
  static constexpr size_t kMost = 64;

  // What a diffuse surface at a point aims at.
  struct Aim {
    double share = 0;                               // of its rays that are worth aiming, 0 to kMostAimed
    std::vector<std::pair<uint32_t, double>> upTo;  // an opening, and the chance of those up to it
  };
  static constexpr double kMostAimed = .4;

  // normal: unit, on the side that the light arrives at. Clears and fills aim.
  void aim(const V3d& point, const V3d& normal, Aim& aim) const;

  // One of the aimed directions (unit) from the point, for uniform u1, u2, u3 in [0, 1): u1 chooses the
  // opening. REQUIRES aim.share > 0.
  V3d sample(const Aim& aim, const V3d& point, double u1, double u2, double u3) const;

  // The density of aimed directions, per sr.
  double density(const Aim& aim, const V3d& point, const V3d& direction) const;

  // The area (square world units) that the openings show to light of this direction (unit) on its way in, and
  // a point of it for uniform u1, u2, u3 in [0, 1), even by that area. REQUIRES an area above 0.
  double areaTowards(const V3d& direction) const;
  V3d pointTowards(const V3d& direction, double u1, double u2, double u3) const;

 private:
  // A rectangle in the plane of panes; its normal points to the dark side.
  struct Opening {
    V3d corner{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0}, normal{0, 0, 1};  // x, y: unit
    double width = 0, height = 0;
    double area = 0;   // of the panes in it
    double power = 0;  // that they let pass: mean radiance to the dark side times area
  };
  static std::vector<Opening> panesOf(const Scene& scene, double leastArea);
  static void merge(std::vector<Opening>& panes);

  std::vector<Opening> openings_;
};

}  // namespace rsphere
