#pragma once
// A coarse solution of diffuse interreflection, which final gathers look up (-aa above 0).
//
// Diffuse surfaces are divided into patches, which the scene and the options determine. A patch gathers once:
// rays from one point of it, each of which ends at other patches or in light that does not depend on any
// patch. The result is stored as links, form factors times reflectances. The light after any number of
// bounces follows from the links without tracing another ray. Patches are made and linked on demand.
//
// Source: final gathering over a radiosity solution (Smits, "Efficient global illumination for radiosity
// environments", 1994; Ward's "two-pass" reasoning, 1988). The links are Monte Carlo form factors: all
// bounces share the same rays.
//
// A patch serves a place only if the segment between the two is unoccluded, so that no light leaks through
// walls.
//
// Threads: any number may query at once, and none waits. If two threads need the same patch at the same time,
// both may link it; the links are identical, and the first are kept. An answer depends only on the place and
// the random numbers of the query, not on earlier queries or on the thread.
//
// Memory: not bounded by -Sm. It grows with the number of patches that paths reach.
#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "field/field_options.h"
#include "field/field_rays.h"
#include "field/insert_once.h"
#include "field/surface_cells.h"
#include "scene/scene.h"

namespace rsphere {

class CoarseSolution {
 public:
  // Keeps a reference to the scene. bounds: of all that can be hit. room: the size of a room into which light
  // comes through openings (world units), so that few rays find it and patches that matter more need more of
  // them. 0: lamps light the surfaces directly, where more rays do not pay.
  CoarseSolution(const Scene& scene, const Box3d& bounds, const FieldOptions& options, double room);
  ~CoarseSolution();

  // The patch that serves a place; null if there is none and the path has to be followed. One of the patches
  // around the place is drawn by the uniform numbers u1, u2 in [0, 1), so that the expected value is
  // interpolated between them. Other patches, whose rays ask for it, may be served by larger ones
  // (FieldOptions::coarserLinks).
  enum class Asker : uint8_t { path, patch };
  Patch* find(const SurfacePlace& place, double u1, double u2, FieldRays& rays, Asker asker = Asker::path);

  // The mean radiance that arrives at a patch (irradiance over pi) after at most `bounces` diffuse
  // reflections; -av for 0 of them.
  Color light(Patch& patch, int bounces, FieldRays& rays);

  size_t patches() const { return made_.load(std::memory_order_relaxed); }
  // The patches of these that were linked, and the rays that were followed for them.
  struct Work {
    size_t patches = 0, rays = 0;
  };
  Work work() const {
    return {linked_.load(std::memory_order_relaxed), rays_.load(std::memory_order_relaxed)};
  }

 private:
  // How finely surfaces are divided, and how many rays a patch has.
  struct Effort {
    double spacing;      // of patches, as a multiple of the harmonic mean distance of their surroundings
    double leastSide;    // of a patch, as a share of its surface's extent
    double farSide;      // that suffices, as a share of the distance that it is seen from
    double usual;        // rays of a patch of the usual share in the light of others (Tuning::kUsualShare)
    double fewer, more;  // bounds on the factor for other shares
    double least;        // rays of every patch
  };
  static Effort effortFor(const FieldOptions& options, bool daylit);

  struct Division;
  int finestLevel(const SurfaceChart& chart, double leastSide) const;
  bool isEnclosed(const SurfaceChart& chart, FieldRays& rays);
  const Division& divisionAt(const SurfaceChart& chart, int finest, FieldRays& rays);
  Patch& patchOf(const SurfaceChart& chart, const CellKey& key, FieldRays& rays);
  const PatchLinks& linksOf(Patch& patch, FieldRays& rays);

  const Scene& scene_;
  CellGrid grid_;
  double room_;
  Effort effort_;
  int bounces_;  // -ab
  int coarserLinks_;
  bool hasBands_;
  Color ambient_;
  std::atomic<size_t> made_{0}, linked_{0}, rays_{0};
  std::unique_ptr<InsertOnce<CellKey, Division>> divisions_;
  std::unique_ptr<InsertOnce<CellKey, Patch>> patches_;
  std::unique_ptr<InsertOnce<CellKey, bool>> enclosed_;  // by the first cell of a chart
};

}  // namespace rsphere
