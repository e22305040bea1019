#include "sphere/delaunay.h"

#include <limits>

namespace rsphere {
namespace {

// Only directions closer together than this can hide one another inside the hull: a chord of length h lies up
// to h^2/8 below the sphere, and radii differ by at most kUnitTolerance^2 / 8. For vectors normalized in
// double precision, the distance is 4e-16.
constexpr double kHiddenDistance = 2 * kUnitTolerance;

// Six times the signed volume of the tetrahedron of a, b, p and the centre. It is computed from differences,
// so it is accurate even if a, b and p are close together.
double sideOfArc(const V3d& aFromP, const V3d& bFromP, const V3d& p) { return aFromP.cross(bFromP).dot(p); }

// The vector from the apex to another corner. parts: the sum of its absolute components.
struct Edge {
  explicit Edge(const V3d& e) : to(e), parts(std::abs(e.x) + std::abs(e.y) + std::abs(e.z)) {}
  V3d to;
  double parts;
};

inline void setPlane(Triangle& t, const V3d& apex, const Edge& u, const Edge& v) {
  const V3d n = u.to.cross(v.to);
  t.nx = n.x;
  t.ny = n.y;
  t.nz = n.z;
  t.offset = n.dot(apex);
  // The error bound has two parts:
  // - Rounding: the normal contains 4 sqrt(2) roundings of |u||v|, and is used with p and with the apex; the
  //   two dot products add 8 more.
  // - Radii: each may be off by kUnitTolerance/2. The effect is multiplied by |n| at p, and at a corner by at
  //   most twice the opposite edge.
  const double m = u.parts, k = v.parts;
  t.bound = static_cast<float>(0x1p-48 * m * k + 0.51 * kUnitTolerance * (m * k + 4 * (m + k)) + 1e-36);
}

}  // namespace

bool Delaunay::holdsSlowly(const Triangle& t, const V3d& p) {
  return circleHolds(sites[t.corner[0]].at, sites[t.corner[1]].at, sites[t.corner[2]].at, p, counts);
}

void Delaunay::reserve(std::size_t count) {
  sites.reserve(count);
  standsFor.reserve(count);
  someTriangle.reserve(count);
  triangles.reserve(2 * count);
}

void Delaunay::start(const std::array<Site, 4>& first) {
  sites.assign(first.begin(), first.end());
  standsFor.assign({0, 1, 2, 3});
  triangles.assign(4, {});
  unused.clear();
  insertions = 4;
  lengthenScratch(kLeastScratch);
  hole_[0] = 0;
  lastRim_ = 1;
  counts = {};
  const std::uint32_t outward =
      circleHolds(first[0].at, first[1].at, first[2].at, first[3].at, counts) ? 1 : 0;
  const std::uint32_t i = 0, j = 1 + outward, k = 2 - outward, l = 3;
  const std::uint32_t corners[4][3] = {{i, j, k}, {j, i, l}, {k, j, l}, {i, k, l}};
  const std::uint32_t nexts[4][3] = {{2, 3, 1}, {3, 2, 0}, {1, 3, 0}, {2, 1, 0}};
  for (std::uint32_t t = 0; t < 4; ++t) {
    for (int e = 0; e < 3; ++e) {
      triangles[t].corner[e] = corners[t][e];
      const std::uint32_t* back = nexts[nexts[t][e]];
      triangles[t].next[e] = 4 * nexts[t][e] + (back[0] == t ? 0 : back[1] == t ? 1 : 2);
    }
    const V3d& apex = sites[corners[t][0]].at;
    setPlane(triangles[t], apex, Edge(sites[corners[t][1]].at - apex), Edge(sites[corners[t][2]].at - apex));
  }
  someTriangle.assign({0, 0, 0, 1});
}

// Inlined into insert(), its only caller, so that p stays in registers.
[[gnu::always_inline]] inline std::uint32_t Delaunay::locate(const V3d& p, std::uint32_t& equal) {
  // A visibility walk: while no circumcircle contains p, it crosses an edge that separates p from the
  // triangle. It ends by itself if the hull contains the centre and all signs are right. Otherwise it ends at
  // the step limit, and the nearest site is searched for instead.
  const std::uint32_t limit =
      64 + 4 * static_cast<std::uint32_t>(std::sqrt(static_cast<double>(triangles.size())));
  std::uint32_t t = 0, from = kNone;
  // The next site is usually near the last one. The walk starts at one of the triangles around the last site:
  // the one with p farthest beyond its plane. A fixed number of triangles is examined, because an
  // unpredictable end of the loop would take longer.
  double farthest = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < kStarts; ++k) {
    const std::uint32_t start = hole_[k < lastRim_ ? k : 0];
    const double beyond = triangles[start].beyond(p);
    t = beyond > farthest ? start : t;
    farthest = std::max(farthest, beyond);
  }
  for (std::uint32_t step = 0; step < limit; ++step) {
    const Triangle& triangle = triangles[t];
    if (triangle.beyond(p) > triangle.bound) {
      counts.filter += step + 1;
      return t;
    }
    const V3d d[3] = {sites[triangle.corner[0]].at - p, sites[triangle.corner[1]].at - p,
                      sites[triangle.corner[2]].at - p};
    // The edge that separates p most clearly. It is chosen without branches, which would be mispredicted.
    const double side0 = sideOfArc(d[1], d[2], p), side1 = sideOfArc(d[2], d[0], p),
                 side2 = sideOfArc(d[0], d[1], p);
    const bool oneIsLess = side1 < side0;
    const double less = oneIsLess ? side1 : side0;
    const bool twoIsLeast = side2 < less;
    const double least = twoIsLeast ? side2 : less;
    const std::uint32_t across = triangle.next[twoIsLeast ? 2u : static_cast<std::uint32_t>(oneIsLess)] / 4;
    // The walk would turn back, because rounding puts p on both sides of the edge.
    if (!(least < 0) || across == from) {
      counts.filter += step;
      break;
    }
    from = t;
    t = across;
  }
  return locateFromNearest(p, triangles[t].corner[0], equal);
}

std::uint32_t Delaunay::locateFromNearest(const V3d& p, std::uint32_t site, std::uint32_t& equal) {
  // Each step comes strictly nearer, so the loop ends even on rings of sites at equal distances.
  double distance2 = (sites[site].at - p).length2();
  for (bool nearer = true; nearer;) {
    nearer = false;
    around(site, [&](std::uint32_t t, int i) {
      const std::uint32_t other = triangles[t].corner[kAfter[i]];
      const double d2 = (sites[other].at - p).length2();
      if (d2 < distance2) {
        distance2 = d2;
        site = other;
        nearer = true;
      }
      return nearer;
    });
  }
  equal = site;
  if (sites[site].at == p) return kNone;
  // The nearest site will be joined to p, so the circle of one of its triangles contains p, unless p is
  // hidden inside the hull.
  std::uint32_t found = kNone;
  const std::uint64_t slow = counts.lifted + counts.exact + counts.symbolic;
  std::uint64_t asked = 0;
  around(site, [&](std::uint32_t t, int) {
    ++asked;
    if (holds(triangles[t], p)) found = t;
    return found != kNone;
  });
  // Rounding may have ended the descent before the nearest site. In that case all triangles are searched.
  for (std::uint32_t t = 0;
       found == kNone && distance2 > kHiddenDistance * kHiddenDistance && t < triangles.size(); ++t) {
    if (triangles[t].corner[0] == kNone) continue;
    ++asked;
    if (holds(triangles[t], p)) found = t;
  }
  counts.filter += asked - (counts.lifted + counts.exact + counts.symbolic - slow);
  return found;
}

void Delaunay::lengthenScratch(std::size_t length) {
  hole_.resize(length);
  pending_.resize(length);
  rim_.resize(length);
}

// Grows the hole edge by edge counterclockwise, so that its rim is in order. This function and the next two
// are inlined into insert(), their only caller, so that p stays in registers.
[[gnu::always_inline]] inline Delaunay::Hole Delaunay::growHole(const V3d& p, std::uint32_t first) {
  // Because the pointers are local, the compiler may assume that writes to the arrays do not change them.
  const std::uint32_t insertion = ++insertions;
  std::size_t holes = 1, rims = 0, pending = 3;
  makeRoom(holes, rims, pending);
  Triangle* const all = triangles.data();
  std::uint32_t *hole = hole_.data(), *stack = pending_.data();
  RimEdge* border = rim_.data();
  all[first].hole = insertion;
  hole[0] = first;
  for (std::uint32_t e = 0; e < 3; ++e) stack[e] = 4 * first + 2 - e;
  const std::uint64_t slow = counts.lifted + counts.exact + counts.symbolic;
  std::uint64_t asked = 0;
  while (pending > 0) {
    const std::uint32_t t = stack[--pending] / 4, e = stack[pending] % 4;
    const Triangle& inside = all[t];
    const std::uint32_t across = inside.next[e], back = across % 4;
    Triangle& outside = all[across / 4];
    if (outside.hole == insertion) continue;
    ++asked;
    if (holds(outside, p)) {
      outside.hole = insertion;
      hole[holes++] = across / 4;
      stack[pending++] = across - back + kBefore[back];
      stack[pending++] = across - back + kAfter[back];
      if (makeRoom(holes, rims, pending)) {
        hole = hole_.data();
        stack = pending_.data();
        border = rim_.data();
      }
    } else {
      border[rims++] = {inside.corner[kAfter[e]], inside.corner[kBefore[e]], across};
    }
  }
  counts.filter += asked - (counts.lifted + counts.exact + counts.symbolic - slow);
  return {holes, rims};
}

[[gnu::always_inline]] inline void Delaunay::takeTriangles(std::size_t holes, std::size_t rims) {
  if (hole_.size() < rims) hole_.resize(rims);
  while (holes < rims) {
    if (unused.empty()) {
      hole_[holes++] = static_cast<std::uint32_t>(triangles.size());
      triangles.emplace_back();
    } else {
      hole_[holes++] = unused.back();
      unused.pop_back();
    }
  }
  while (holes > rims) {
    const std::uint32_t left = hole_[--holes];
    triangles[left].corner[0] = kNone;
    unused.push_back(left);
  }
}

[[gnu::always_inline]] inline void Delaunay::fillHole(const V3d& p, std::uint32_t site, std::size_t rims) {
  const RimEdge* const rim = rim_.data();
  Triangle* const now = triangles.data();
  const Site* const site_ = sites.data();
  std::uint32_t* const triangleOf = someTriangle.data();
  const std::uint32_t* const place = hole_.data();
  Edge u(site_[rim[0].from].at - p);
  std::uint32_t before = place[rims - 1], t = place[0];
  for (std::size_t i = 0; i < rims; ++i) {
    const RimEdge& edge = rim[i];
    const Edge v(site_[edge.to].at - p);
    const std::uint32_t after = place[i + 1 < rims ? i + 1 : 0];
    Triangle& triangle = now[t];
    triangle.corner[0] = site;
    triangle.corner[1] = edge.from;
    triangle.corner[2] = edge.to;
    triangle.next[0] = edge.outside;
    triangle.next[1] = 4 * after + 2;
    triangle.next[2] = 4 * before + 1;
    now[edge.outside / 4].next[edge.outside % 4] = 4 * t;
    triangleOf[edge.from] = t;
    setPlane(triangle, p, u, v);
    u = v;
    before = t;
    t = after;
  }
  triangleOf[site] = place[0];
  lastRim_ = rims;
}

void Delaunay::insert(const Site& added) {
  const V3d p = added.at;
  const auto site = static_cast<std::uint32_t>(sites.size());
  std::uint32_t equal = kNone;
  const std::uint32_t first = locate(p, equal);
  sites.push_back(added);
  someTriangle.push_back(kNone);
  if (first == kNone) {
    standsFor.push_back(equal);
    return;
  }
  standsFor.push_back(site);
  const Hole hole = growHole(p, first);
  // If no site lies inside the hole, its number of triangles is the number of rim edges minus two.
  if (hole.edges != hole.triangles + 2)
    mergeHidden(site, {hole_.data(), hole.triangles}, {rim_.data(), hole.edges});
  takeTriangles(hole.triangles, hole.edges);
  fillHole(p, site, hole.edges);
}

void Delaunay::mergeHidden(std::uint32_t p, std::span<const std::uint32_t> hole,
                           std::span<const RimEdge> rim) {
  for (std::uint32_t t : hole) {
    for (std::uint32_t corner : triangles[t].corner) {
      bool onRim = false;
      for (const RimEdge& edge : rim) onRim = onRim || edge.from == corner;
      if (!onRim) standsFor[corner] = p;
    }
  }
}

}  // namespace rsphere
