#pragma once
#include <Imath/ImathVec.h>

#include <array>
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
  std::uint32_t next[3] = {};    // the triangle across the edge opposite to that corner
  std::uint32_t hole = 0;        // the insertion that took it away last
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
  std::uint32_t lastTriangle = 0;  // where the next walk begins
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
    const double beyond = t.nx * p.x + t.ny * p.y + t.nz * p.z - t.offset;
    if (beyond > t.bound) return true;
    if (beyond < -t.bound) return false;
    return holdsSlowly(t, p);
  }

  // Calls visit(triangle, corner) for each triangle around the site, counterclockwise, until it returns true.
  template <class Visit>
  void around(std::uint32_t site, Visit&& visit) const {
    const std::uint32_t first = someTriangle[site];
    std::uint32_t t = first;
    do {
      const Triangle& triangle = triangles[t];
      const int i = triangle.corner[0] == site ? 0 : triangle.corner[1] == site ? 1 : 2;
      if (visit(t, i)) return;
      t = triangle.next[kAfter[i]];
    } while (t != first);
  }

  // What is wrong with the triangulation, if anything: triangles that do not fit, a circle that holds the
  // corner of a neighbour, a surface that is not closed. names[i] is what site i is called.
  std::optional<std::string> fault(std::span<const std::uint32_t> names) const;

  static constexpr int kAfter[3] = {1, 2, 0}, kBefore[3] = {2, 0, 1};

 private:
  struct RimEdge {
    std::uint32_t from, to, outside;  // counterclockwise as seen from inside the hole
    int outsideEdge;
  };

  bool holdsSlowly(const Triangle& t, const V3d& p);
  // A triangle whose circle holds p, or kNone and the site that p is to be merged into.
  std::uint32_t locate(const V3d& p, std::uint32_t& equal);
  std::uint32_t locateFromNearest(const V3d& p, std::uint32_t from, std::uint32_t& equal);
  void setPlane(Triangle& t, const V3d& apex, const V3d& u, const V3d& v);
  void mergeHidden(std::uint32_t p);

  std::vector<std::uint32_t> hole_;
  std::vector<RimEdge> rim_;
  std::vector<std::uint32_t> pending_;  // 4 * triangle + edge
};

}  // namespace rsphere
