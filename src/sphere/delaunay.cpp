#include "sphere/delaunay.h"

#include <cmath>

namespace rsphere {
namespace {

// Directions that hide one another are nearer than this: radii differ by at most kUnitTolerance^2 / 8, and a
// chord of length h cuts h^2/8 off. For vectors normalized in double precision it is 4e-16.
constexpr double kHiddenDistance = 2 * kUnitTolerance;

// Twice the volume of a, b, p and the centre, from differences: right also where the three are close
// together.
double sideOfArc(const V3d& aFromP, const V3d& bFromP, const V3d& p) { return aFromP.cross(bFromP).dot(p); }

double sumOfParts(const V3d& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

}  // namespace

void Delaunay::setPlane(Triangle& t, const V3d& apex, const V3d& u, const V3d& v) {
  const V3d n = u.cross(v);
  t.nx = n.x;
  t.ny = n.y;
  t.nz = n.z;
  t.offset = n.dot(apex);
  // Rounding: normal 4 sqrt(2) roundings of |u||v|, used with p and with the apex; 8 more for the two dot
  // products. Radii: each may be off by kUnitTolerance/2, at p times |n|, at a corner times at most twice the
  // opposite edge.
  const double m = sumOfParts(u), k = sumOfParts(v);
  t.bound = static_cast<float>(0x1p-48 * m * k + 0.51 * kUnitTolerance * (m * k + 4 * (m + k)) + 1e-36);
}

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
  lastTriangle = 0;
  counts = {};
  const std::uint32_t outward =
      circleHolds(first[0].at, first[1].at, first[2].at, first[3].at, counts) ? 1 : 0;
  const std::uint32_t i = 0, j = 1 + outward, k = 2 - outward, l = 3;
  const std::uint32_t corners[4][3] = {{i, j, k}, {j, i, l}, {k, j, l}, {i, k, l}};
  const std::uint32_t nexts[4][3] = {{2, 3, 1}, {3, 2, 0}, {1, 3, 0}, {2, 1, 0}};
  for (int t = 0; t < 4; ++t) {
    for (int e = 0; e < 3; ++e) {
      triangles[t].corner[e] = corners[t][e];
      triangles[t].next[e] = nexts[t][e];
    }
    const V3d& apex = sites[corners[t][0]].at;
    setPlane(triangles[t], apex, sites[corners[t][1]].at - apex, sites[corners[t][2]].at - apex);
  }
  someTriangle.assign({0, 0, 0, 1});
}

std::uint32_t Delaunay::locate(const V3d& p, std::uint32_t& equal) {
  // A visibility walk: across an edge that separates p from the triangle, until a circle holds p. It ends
  // where the hull holds the centre and signs are right; elsewhere the limit ends it and the nearest site is
  // sought instead.
  const std::uint32_t limit =
      64 + 4 * static_cast<std::uint32_t>(std::sqrt(static_cast<double>(triangles.size())));
  std::uint32_t t = lastTriangle, from = kNone;
  for (std::uint32_t step = 0; step < limit; ++step) {
    const Triangle& triangle = triangles[t];
    if (triangle.nx * p.x + triangle.ny * p.y + triangle.nz * p.z - triangle.offset > triangle.bound) {
      counts.filter += step + 1;
      return t;
    }
    const V3d d[3] = {sites[triangle.corner[0]].at - p, sites[triangle.corner[1]].at - p,
                      sites[triangle.corner[2]].at - p};
    double least = 0;
    int across = -1;
    for (int e = 0; e < 3; ++e) {
      if (triangle.next[e] == from) continue;
      const double side = sideOfArc(d[kAfter[e]], d[kBefore[e]], p);
      if (side < least) {
        least = side;
        across = e;
      }
    }
    if (across < 0) {
      counts.filter += step;
      break;
    }
    from = t;
    t = triangle.next[across];
  }
  return locateFromNearest(p, triangles[t].corner[0], equal);
}

std::uint32_t Delaunay::locateFromNearest(const V3d& p, std::uint32_t site, std::uint32_t& equal) {
  // Each step is strictly nearer, so it ends, also on rings where many sites are equally near.
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
  // The nearest site will be joined to p, so a circle through it holds p; unless p is hidden.
  std::uint32_t found = kNone;
  const std::uint64_t slow = counts.lifted + counts.exact + counts.symbolic;
  std::uint64_t asked = 0;
  around(site, [&](std::uint32_t t, int) {
    ++asked;
    if (holds(triangles[t], p)) found = t;
    return found != kNone;
  });
  // Rounding may have ended the descent at a site that is not the nearest.
  for (std::uint32_t t = 0;
       found == kNone && distance2 > kHiddenDistance * kHiddenDistance && t < triangles.size(); ++t) {
    if (triangles[t].corner[0] == kNone) continue;
    ++asked;
    if (holds(triangles[t], p)) found = t;
  }
  counts.filter += asked - (counts.lifted + counts.exact + counts.symbolic - slow);
  return found;
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

  // The hole, edge by edge counterclockwise, so that its rim comes out in order.
  ++insertions;
  hole_.clear();
  rim_.clear();
  pending_.clear();
  triangles[first].hole = insertions;
  hole_.push_back(first);
  for (std::uint32_t e : {2u, 1u, 0u}) pending_.push_back(4 * first + e);
  const std::uint64_t slow = counts.lifted + counts.exact + counts.symbolic;
  std::uint64_t asked = 0;
  while (!pending_.empty()) {
    const std::uint32_t t = pending_.back() / 4, e = pending_.back() % 4;
    pending_.pop_back();
    const std::uint32_t across = triangles[t].next[e];
    Triangle& outside = triangles[across];
    if (outside.hole == insertions) continue;
    const int back = outside.next[0] == t ? 0 : outside.next[1] == t ? 1 : 2;
    ++asked;
    if (holds(outside, p)) {
      outside.hole = insertions;
      hole_.push_back(across);
      pending_.push_back(4 * across + kBefore[back]);
      pending_.push_back(4 * across + kAfter[back]);
    } else {
      rim_.push_back({triangles[t].corner[kAfter[e]], triangles[t].corner[kBefore[e]], across, back});
    }
  }
  counts.filter += asked - (counts.lifted + counts.exact + counts.symbolic - slow);
  // A hole without a site inside has two triangles less than its rim has edges.
  if (rim_.size() != hole_.size() + 2) mergeHidden(site);

  while (hole_.size() < rim_.size()) {
    if (unused.empty()) {
      hole_.push_back(static_cast<std::uint32_t>(triangles.size()));
      triangles.emplace_back();
    } else {
      hole_.push_back(unused.back());
      unused.pop_back();
    }
  }
  for (; hole_.size() > rim_.size(); hole_.pop_back()) {
    triangles[hole_.back()].corner[0] = kNone;
    unused.push_back(hole_.back());
  }
  V3d u = sites[rim_[0].from].at - p;
  for (std::size_t i = 0; i < rim_.size(); ++i) {
    const RimEdge& edge = rim_[i];
    const V3d v = sites[edge.to].at - p;
    const std::uint32_t t = hole_[i];
    Triangle& triangle = triangles[t];
    triangle.corner[0] = site;
    triangle.corner[1] = edge.from;
    triangle.corner[2] = edge.to;
    triangle.next[0] = edge.outside;
    triangle.next[1] = hole_[i + 1 < rim_.size() ? i + 1 : 0];
    triangle.next[2] = hole_[i > 0 ? i - 1 : rim_.size() - 1];
    triangles[edge.outside].next[edge.outsideEdge] = t;
    someTriangle[edge.from] = t;
    setPlane(triangle, p, u, v);
    u = v;
  }
  lastTriangle = someTriangle[site] = hole_[0];
}

void Delaunay::mergeHidden(std::uint32_t p) {
  for (std::uint32_t t : hole_) {
    for (std::uint32_t corner : triangles[t].corner) {
      bool onRim = false;
      for (const RimEdge& edge : rim_) onRim = onRim || edge.from == corner;
      if (!onRim) standsFor[corner] = p;
    }
  }
}

std::optional<std::string> Delaunay::fault(std::span<const std::uint32_t> names) const {
  const auto name = [&](std::uint32_t site) { return std::to_string(names[site]); };
  PredicateCounts ignored;
  std::size_t corners = 0, faces = 0;
  for (std::uint32_t site = 0; site < sites.size(); ++site) corners += standsFor[site] == site;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const Triangle& triangle = triangles[t];
    const auto& k = triangle.corner;
    if (k[0] == kNone) continue;
    ++faces;
    for (int e = 0; e < 3; ++e) {
      const Triangle& other = triangles[triangle.next[e]];
      const int back = other.next[0] == t ? 0 : other.next[1] == t ? 1 : 2;
      if (other.next[back] != t || other.corner[kAfter[back]] != k[kBefore[e]] ||
          other.corner[kBefore[back]] != k[kAfter[e]]) {
        return "triangles do not fit together at direction " + name(k[kAfter[e]]);
      }
      if (circleHolds(sites[k[0]].at, sites[k[1]].at, sites[k[2]].at, sites[other.corner[back]].at,
                      ignored)) {
        return "the circle of directions " + name(k[0]) + " " + name(k[1]) + " " + name(k[2]) + " holds " +
               name(other.corner[back]);
      }
    }
  }
  if (faces + 4 != 2 * corners) return "the triangulation is not closed";
  return std::nullopt;
}

}  // namespace rsphere
