#pragma once
// A coarse solution of interreflection, which final gathers look up (-aa above 0).
//
// Diffuse surfaces are divided into patches, by the scene and the options alone. A patch gathers once: rays
// from one point of it, each of which ends at other patches or in light that does not depend on any patch.
// What the rays found is kept as links, so that the light after one, two, ... bounces follows from the links
// without another ray. Patches are made and linked where a path first asks for them.
//
// Source: final gathering over a radiosity solution (Smits, "Efficient global illumination for radiosity
// environments", 1994; Ward's "two-pass" reasoning, 1988). Storing links rather than light is Monte Carlo
// form factors: all bounces share the same rays.
//
// A patch serves a place only where the segment between the two is free, so that no light passes a wall.
//
// Threads: any number may ask at once, and none waits. Two that need the same patch at the same time may both
// link it; the links are the same, and the first are kept. An answer depends on the place and the random
// numbers that are asked with, not on what was asked before, or by whom.
#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "cli/options.h"
#include "scene/scene.h"
#include "transport/hemisphere.h"
#include "transport/insert_once.h"
#include "transport/surface_cells.h"

namespace rsphere {

class CoarseSolution {
 public:
  struct Patch;

  // What the rays of a patch found, by the diffuse bounces that a ray made beyond its first hit, because no
  // patch served there: 0 for most. Coefficients are of the mean radiance that arrives at the patch.
  struct Links {
    struct Link {
      Patch* patch;
      V3f coefficient;  // of the mean radiance that arrives there
      int bounces;
    };
    std::vector<Link> links;
    std::vector<V3f> light;  // by bounces: radiance that depends on no patch (W/sr/m2)
    std::vector<V3f> ends;   // by bounces: coefficient of -av, should the path be allowed no further bounce

    void addLight(int bounces, const Rgb& radiance);
    void addEnd(int bounces, const Rgb& coefficient);
  };

  // How the scene is looked at. Answers depend on nothing but the arguments.
  class Looker {
   public:
    // Sends about `rays` rays over the hemisphere of a site.
    virtual void link(const GatherSite& site, int rays, uint64_t seed, Links& links) = 0;
    // The harmonic mean of the distances to what is seen from a site, in few directions (world units).
    virtual double reach(const GatherSite& site) = 0;
    // Whether nothing is between two points.
    virtual bool sees(const V3d& from, const V3d& to) = 0;

   protected:
    ~Looker() = default;
  };

  // Keeps a reference to the scene. bounds: of all that can be hit.
  CoarseSolution(const Scene& scene, const Box3d& bounds, const RayOptions& options);
  ~CoarseSolution();

  // The patch that serves a place; null where none does, and the path has to be followed. Patches near the
  // place serve in turn, by the uniform numbers u1, u2 in [0, 1), so that the mean is interpolated between
  // them.
  Patch* find(const SurfacePlace& place, double u1, double u2, Looker& looker);

  // The mean radiance that arrives at a patch (irradiance over pi) after at most `bounces` diffuse
  // reflections; -av for 0 of them.
  V3f light(Patch& patch, int bounces, Looker& looker);

  size_t patches() const { return made_.load(std::memory_order_relaxed); }

 private:
  Patch& patchOf(const SurfaceChart& chart, const CellKey& key, Looker& looker);
  const Links& linksOf(Patch& patch, Looker& looker);

  const Scene& scene_;
  CellGrid grid_;
  double spacing_;  // of patches, in mean distances of what they see
  int rays_;        // of a patch
  int bounces_;     // at most
  V3f ambient_;
  std::atomic<size_t> made_{0};
  std::unique_ptr<InsertOnce<CellKey, Patch>> patches_;
};

}  // namespace rsphere
