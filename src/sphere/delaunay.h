#pragma once
#include <Imath/ImathVec.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sphere/predicates.h"

// The Delaunay triangulation of directions, which is their convex hull (predicates.h says of which points),
// one direction after another: a new one takes away the triangles whose circles hold it and is joined to the
// rim of the hole (Bowyer 1981, Watson 1981). Inner part of voronoi.h, which checks the input.
namespace rsphere {

// One cache line: a step of a walk or of a hole's growth costs one.
struct alignas(64) Triangle {
  double nx = 0, ny = 0, nz = 0,
         offset = 0;             // outward normal, twice the triangle's area long; normal . corner
  float bound = 0;               // a plane distance times |normal| that is greater has the right sign
  std::uint32_t corner[3] = {};  // sites, counterclockwise as seen from outside
  std::uint32_t next[3] = {};    // across the edge opposite to that corner: 4 * triangle + its edge
  std::uint32_t hole = 0;        // the insertion that took it away last

  // How far p is beyond the plane, times |normal|.
  double beyond(const V3d& p) const { return nx * p.x + ny * p.y + nz * p.z - offset; }
};
static_assert(sizeof(Triangle) == 64);

// A direction and half of |at|^2 - 1: how far outside the unit sphere rounding has left it.
struct alignas(32) Site {
  V3d at;
  double height = 0;
};

struct Delaunay {
  static constexpr std::uint32_t kNone = ~0u;

  std::vector<Site> sites;                  // in the order of insertion
  std::vector<std::uint32_t> standsFor;     // the site that a site was merged into; itself if it is a corner
  std::vector<std::uint32_t> someTriangle;  // one that has the site as a corner
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> unused;  // places in triangles; their corner[0] is kNone
  std::uint32_t insertions = 0;
  PredicateCounts counts;

  // Makes room for that many sites in all.
  void reserve(std::size_t count);

  // Starts with four different sites.
  void start(const std::array<Site, 4>& first);

  // Adds a site; its number is that of calls before it, plus 4. It is merged into the one that it equals, or
  // into the nearest if the hull keeps it hidden, which happens below 1e-15 apart only; so are those that it
  // hides.
  void insert(const Site& added);

  // Is p inside the circle of the triangle?
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

  // What is wrong with the triangulation, if anything: triangles that do not fit, a circle that holds the
  // corner of a neighbour, a surface that is not closed. names[i] is what site i is called.
  std::optional<std::string> fault(std::span<const std::uint32_t> names) const;

  static constexpr int kAfter[3] = {1, 2, 0}, kBefore[3] = {2, 0, 1};

 private:
  struct RimEdge {
    std::uint32_t from, to;  // counterclockwise as seen from inside the hole
    std::uint32_t outside;   // 4 * triangle + edge
  };

  bool holdsSlowly(const Triangle& t, const V3d& p);
  // A triangle whose circle holds p, or kNone and the site that p is to be merged into.
  std::uint32_t locate(const V3d& p, std::uint32_t& equal);
  std::uint32_t locateFromNearest(const V3d& p, std::uint32_t from, std::uint32_t& equal);
  // Whether the scratch of insert() had to be made longer: each triangle of the hole leaves two edges or
  // fewer to look at and to its rim.
  bool makeRoom(std::size_t holes, std::size_t rims, std::size_t pending) {
    const std::size_t most = std::max(holes, rims + pending) + 4;
    if (most <= hole_.size()) [[likely]]
      return false;
    lengthenScratch(2 * most + 64);
    return true;
  }
  void lengthenScratch(std::size_t length);
  void mergeHidden(std::uint32_t p, std::span<const std::uint32_t> hole, std::span<const RimEdge> rim);

  // Scratch of insert(), which knows how much of it counts. What stays in hole_ until the next are the
  // triangles around the last site, lastRim_ of them.
  static constexpr std::size_t kStarts = 6, kLeastScratch = 64;
  std::size_t lastRim_ = 1;
  std::vector<std::uint32_t> hole_;
  std::vector<RimEdge> rim_;
  std::vector<std::uint32_t> pending_;  // 4 * triangle + edge
};

}  // namespace rsphere
