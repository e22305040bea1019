#pragma once
#include <Imath/ImathVec.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "sphere/predicates.h"

// The Delaunay triangulation of directions, which is the convex hull of their points on the sphere
// (predicates.h defines these). It is built incrementally: an inserted direction removes the triangles whose
// circumcircles contain it and is joined to the rim of the hole (Bowyer 1981, Watson 1981). This is an inner
// part of voronoi.h, which validates the input.
namespace rsphere {

// Fills one cache line, so that each step of a walk or of a hole's growth loads only one line.
struct alignas(64) Triangle {
  double nx = 0, ny = 0, nz = 0,
         offset = 0;             // normal: outward, with the length of twice the area; offset: normal .
                                 // corner
  float bound = 0;               // the sign of beyond() is right if its absolute value exceeds this bound
  std::uint32_t corner[3] = {};  // sites, counterclockwise as seen from outside
  std::uint32_t next[3] = {};    // neighbour across the edge opposite each corner: 4 * triangle + edge
  std::uint32_t hole = 0;        // number of the last insertion that removed it

  // The distance of p beyond the plane, times |normal|.
  double beyond(const V3d& p) const { return nx * p.x + ny * p.y + nz * p.z - offset; }
};
static_assert(sizeof(Triangle) == 64);

// A direction. height: (|at|^2 - 1) / 2, the rounding error of its distance from the origin.
struct alignas(32) Site {
  V3d at;
  double height = 0;
};

struct Delaunay {
  static constexpr std::uint32_t kNone = ~0u;

  std::vector<Site> sites;                  // in the order of insertion
  std::vector<std::uint32_t> standsFor;     // the site into which each was merged; itself if it was not
                                            // merged
  std::vector<std::uint32_t> someTriangle;  // a triangle with the site as a corner
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> unused;  // free slots in triangles; their corner[0] is kNone
  std::uint32_t insertions = 0;
  PredicateCounts counts;

  // Reserves memory for this number of sites in total.
  void reserve(std::size_t count);

  // Starts with four different sites.
  void start(const std::array<Site, 4>& first);

  // Adds a site. Its index is 4 plus the number of earlier calls. If it equals an existing site, it is merged
  // into that site. If it lies inside the hull, which happens only within 1e-15 of another site, it is merged
  // into the nearest site. Existing sites that come to lie inside the hull are merged into the new one.
  void insert(const Site& added);

  // Whether p lies inside the triangle's circumcircle.
  bool holds(const Triangle& t, const V3d& p) {
    const double beyond = t.beyond(p);
    if (beyond > t.bound) return true;
    if (beyond < -t.bound) return false;
    return holdsSlowly(t, p);
  }

  // Calls visit(triangle, corner) for each triangle around the site, counterclockwise, until it returns true.
  template <class Visit>
  void around(std::uint32_t site, Visit&& visit) const {
    const std::uint32_t first = someTriangle[site];
    const auto& k = triangles[first].corner;
    std::uint32_t t = first;
    int i = k[0] == site ? 0 : k[1] == site ? 1 : 2;
    do {
      if (visit(t, i)) return;
      const std::uint32_t across = triangles[t].next[kAfter[i]];
      t = across / 4;
      i = kAfter[across % 4];
    } while (t != first);
  }

  static constexpr int kAfter[3] = {1, 2, 0}, kBefore[3] = {2, 0, 1};

 private:
  struct RimEdge {
    std::uint32_t from, to;  // counterclockwise as seen from inside the hole
    std::uint32_t outside;   // 4 * triangle + edge
  };

  bool holdsSlowly(const Triangle& t, const V3d& p);
  // Finds a triangle whose circumcircle contains p. Returns kNone if there is none, and sets `equal` to the
  // site with which p is merged.
  std::uint32_t locate(const V3d& p, std::uint32_t& equal);
  std::uint32_t locateFromNearest(const V3d& p, std::uint32_t from, std::uint32_t& equal);
  // Enlarges the scratch memory of insert() if needed; returns whether it did. Each triangle of the hole adds
  // at most two edges to the total of pending edges and rim edges.
  bool makeRoom(std::size_t holes, std::size_t rims, std::size_t pending) {
    const std::size_t most = std::max(holes, rims + pending) + 4;
    if (most <= hole_.size()) [[likely]]
      return false;
    lengthenScratch(2 * most + 64);
    return true;
  }
  void lengthenScratch(std::size_t length);
  // The steps of insert(). growHole() stores the triangles whose circumcircles contain p in hole_, and the
  // edges around them in order in rim_; it returns both numbers. takeTriangles() provides as many triangles
  // as the rim has edges. fillHole() joins the new site to each of these edges.
  struct Hole {
    std::size_t triangles, edges;
  };
  Hole growHole(const V3d& p, std::uint32_t first);
  void takeTriangles(std::size_t holes, std::size_t rims);
  void fillHole(const V3d& p, std::uint32_t site, std::size_t rims);
  void mergeHidden(std::uint32_t p, std::span<const std::uint32_t> hole, std::span<const RimEdge> rim);

  // Scratch memory of insert(); the lengths in use are tracked separately. After an insertion, the first
  // lastRim_ entries of hole_ are the triangles around the new site.
  static constexpr std::size_t kStarts = 6, kLeastScratch = 64;
  std::size_t lastRim_ = 1;
  std::vector<std::uint32_t> hole_;
  std::vector<RimEdge> rim_;
  std::vector<std::uint32_t> pending_;  // 4 * triangle + edge
};

}  // namespace rsphere
