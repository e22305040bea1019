#pragma once
// A coarse solution of diffuse interreflection, which final gathers look up (-aa above 0).
//
// Diffuse surfaces are divided into patches, which depend only on the scene and the options. Each patch
// gathers once: it sends rays from places all over its area, which end at other patches or in light that
// depends on no patch. The result is stored as links, products of form factors and reflectances. The links
// give the light after any number of bounces without tracing more rays. Patches are made and linked on
// demand.
//
// Source: final gathering over a radiosity solution (Smits, "Efficient global illumination for radiosity
// environments", 1994; Ward's "two-pass" reasoning, 1988). Differences: the form factors are Monte Carlo
// estimates, and all bounces share the same rays.
//
// A place uses a patch only if the segment between them is unoccluded, so that no light leaks through walls.
//
// Bias: the light of a patch is a linear function, fitted to the light at places all over its area. The
// function may be negative at the edges of a patch; its mean is not. Two simpler representations were
// rejected. The light at the middle of a patch, or interpolation between patches of different sizes, is too
// bright where light increases ever faster towards a window: in a room below north lights, sensors were 4%
// too bright at every setting. The mean over the area neglects that light and solid angle may both vary
// across a patch: sensors below the last north light were 1% too dark at -aa .05.
//
// Noise: a patch serves a gather only if it has sent at least as many rays as the gather sends to it. This
// matters for near patches, whose noise many rays of the gather share. Outdoors, patches of the ground send 8
// rays; without this rule, a sensor close above the ground had 25% of noise instead of the 4% of paths.
//
// Errors: there may be several independent solutions with the same patches, each with its share of the rays
// (FieldOptions::solutions). Their spread shows the noise that all answers from one solution share.
//
// Threads: any number may query at the same time, and none waits. If two threads need the same patch at the
// same time, both may link it; the links are identical, and the first are kept. An answer depends only on the
// place and the random numbers of the query, not on earlier queries or on the thread.
//
// Memory: not limited by -Sm. It grows with the number of patches that paths reach.
#include <atomic>
#include <cstdint>
#include <memory>

#include "field/field_options.h"
#include "field/field_rays.h"
#include "field/insert_once.h"
#include "field/surface_cells.h"
#include "scene/scene.h"

namespace rsphere {

class CoarseSolution {
 public:
  static constexpr size_t kMostSolutions = 8;  // of FieldOptions::solutions

  // Keeps a reference to the scene. bounds: of everything that rays can hit. room: the size of a room that is
  // lit through openings (world units); few rays hit the openings, so that important patches need more rays.
  // 0: lamps light the surfaces directly, and more rays would not pay.
  CoarseSolution(const Scene& scene, const Box3d& bounds, const FieldOptions& options, double room);
  ~CoarseSolution();

  // Finds the patch whose light is used at a place, and the place on it; no patch if the path has to be
  // followed. There is no interpolation between patches: where their sizes differ, the light of a bright
  // patch would be lent to a dark neighbour without the reverse. Rays that are traced to link a patch may use
  // larger patches than paths do (FieldOptions::coarserLinks).
  enum class Asker : uint8_t { path, patch };
  // solution: from 0 to FieldOptions::solutions - 1.
  PatchPlace find(const SurfacePlace& place, FieldRays& rays, Asker asker = Asker::path, int solution = 0);

  // The mean radiance that arrives at a place on a patch (irradiance over pi) after at most `bounces` diffuse
  // reflections; -av for 0 reflections.
  Color light(const PatchPlace& place, int bounces, FieldRays& rays);

  size_t patches() const { return made_.load(std::memory_order_relaxed); }
  // The number of patches that were linked, and of the rays that were followed for them.
  struct Work {
    size_t patches = 0, rays = 0;
  };
  Work work() const {
    return {linked_.load(std::memory_order_relaxed), rays_.load(std::memory_order_relaxed)};
  }

 private:
  // How finely surfaces are divided into patches, and how many rays a patch sends.
  struct Effort {
    double spacing;      // side of a patch, relative to the harmonic mean distance of its surroundings
    double leastSide;    // lower bound on the side of a patch, relative to its surface's extent
    double farSide;      // sufficient side of a patch, relative to the viewing distance
    double nearSide;     // largest side of a patch, relative to that distance
    double usual;        // rays of a patch whose share of the light on other surfaces is usualShare
    double fewer, more;  // bounds on the factor for other shares
    double least;        // lower bound on the rays of a patch
    double asked;        // number of rays of a gather that uses patches
    double usualShare;   // tuning::CoarseSolution::kUsualShare or kUsualShareAtFirst
    double forSlopes;    // least number of rays of a patch whose light has slopes
    double forLinks;     // the same for light that links use; below it, they use the mean
  };
  static Effort effortFor(const FieldOptions& options, bool daylit);

  struct Division;
  struct Frame;
  int finestLevel(const SurfaceChart& chart, double leastSide) const;
  bool isEnclosed(const SurfaceChart& chart, FieldRays& rays);
  const Division& divisionAt(const SurfaceChart& chart, int finest, FieldRays& rays);
  Frame& frameOf(const SurfaceChart& chart, const CellKey& key, FieldRays& rays);
  Patch& patchOf(Frame& frame, int solution) const;
  void spread(Patch& patch, const Frame& frame, const SurfaceChart& chart, const CellKey& key,
              FieldRays& rays);
  double raysOf(const Frame& frame) const;
  const PatchLinks& linksOf(Patch& patch, FieldRays& rays);
  LinearColor ofAllBounces(Patch& patch, FieldRays& rays, Color& inBands);
  LinearColor sumOf(const PatchLinks& links, int bounces, FieldRays& rays, Color& inBands);

  const Scene& scene_;
  CellGrid grid_;
  double room_;
  Effort effort_;
  uint64_t rotation_;
  int bounces_;  // whose light is computed
  int last_;     // one more if all bounces count, whose light is extrapolated
  int coarserLinks_;
  bool hasBands_;
  Color ambient_;
  std::atomic<size_t> made_{0}, linked_{0}, rays_{0};
  std::unique_ptr<InsertOnce<CellKey, Division>> divisions_;
  std::unique_ptr<InsertOnce<CellKey, Frame>> frames_;
  std::unique_ptr<InsertOnce<CellKey, bool>> enclosed_;  // key: the first cell of the surface's chart
};

}  // namespace rsphere
