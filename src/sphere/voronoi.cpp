#include "sphere/voronoi.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>

#include "sphere/delaunay.h"
#include "sphere/kites.h"
#include "sphere/order.h"

namespace rsphere {
namespace {

constexpr std::uint32_t kNone = Delaunay::kNone;
constexpr double kSphere = 4 * std::numbers::pi;
// The square of an ulp of 1 [sr]. Smaller cells are dominated by rounding of the input.
constexpr double kLeastArea = 0x1p-104;

double withoutDust(double x) { return std::abs(x) < kSmallestComponent ? 0.0 : x; }

// Appends the directions as sites. Throws if one is not a unit vector.
void appendChecked(std::span<const V3d> directions, std::vector<Site>& sites) {
  if (sites.size() + directions.size() > (1u << 29)) throw std::invalid_argument("more than 2^29 directions");
  for (const V3d& d : directions) {
    const V3d at(withoutDust(d.x), withoutDust(d.y), withoutDust(d.z));
    const double excess = lengthExcess(at);
    if (!(std::abs(excess) <= kUnitTolerance)) {
      throw std::invalid_argument("direction " + std::to_string(sites.size()) + ": not a unit vector (" +
                                  std::to_string(d.x) + " " + std::to_string(d.y) + " " +
                                  std::to_string(d.z) + ")");
    }
    sites.push_back({at, excess / 2});
  }
}

// Directions in the order of insertion. If fewer than four are different, there is no triangulation: sites
// then keep the order of the input, and `few` lists the different ones.
struct Triangulation {
  Delaunay delaunay;
  std::vector<std::uint32_t> order;  // site -> direction
  std::vector<std::uint32_t> few;

  bool isFlat() const { return delaunay.sites.size() < 4 || !few.empty(); }
  void build(std::span<const Site> sites, OrderScratch& scratch);
};

void Triangulation::build(std::span<const Site> sites, OrderScratch& scratch) {
  orderForBuild(sites, scratch, order);
  few.clear();
  for (std::size_t k = 0; k < order.size() && few.size() < 4; ++k) {
    const auto isSame = [&](std::uint32_t f) { return sites[f].at == sites[order[k]].at; };
    if (std::ranges::none_of(few, isSame)) {
      std::swap(order[few.size()], order[k]);
      few.push_back(order[few.size()]);
    }
  }
  if (few.size() < 4) {
    delaunay.sites.assign(sites.begin(), sites.end());
    delaunay.counts = {};
    std::iota(order.begin(), order.end(), 0);
    return;
  }
  delaunay.reserve(sites.size());
  delaunay.start({sites[few[0]], sites[few[1]], sites[few[2]], sites[few[3]]});
  few.clear();
  // The insertion order accesses sites all over memory. Without this prefetch, a third of the time for a
  // million directions was spent waiting for memory.
  constexpr std::size_t kAhead = 8;
  for (std::size_t k = 4; k < order.size(); ++k) {
    __builtin_prefetch(&sites[order[std::min(k + kAhead, order.size() - 1)]]);
    delaunay.insert(sites[order[k]]);
  }
}

std::size_t indexAmong(const std::vector<std::uint32_t>& few, const std::vector<Site>& sites,
                       const Site& site) {
  std::size_t i = 0;
  while (sites[few[i]].at != site.at) ++i;
  return i;
}

std::uint32_t last(const std::vector<std::uint32_t>& standsFor, std::uint32_t site) {
  while (standsFor[site] != site) site = standsFor[site];
  return site;
}

}  // namespace

struct BaseTriangulation::Data {
  Triangulation triangulation;
  std::vector<Kites> kites;
  std::vector<std::uint8_t> wide;
  bool anyUnused = false, anyWide = false;
};

struct VoronoiWorkspace::Data {
  Triangulation triangulation;
  OrderScratch scratch;
  std::vector<Site> added;
  std::vector<std::uint32_t> addedOrder, which;
  std::vector<std::uint8_t> spoiled;  // by site: 1 for corners of a triangle with a wide circle
  std::vector<double> area;           // of sites
  std::vector<std::uint32_t> sharers;
  std::vector<double> solidAngles;

  void build(std::span<const Site> sites);
  void query(const BaseTriangulation::Data& base, std::span<const V3d> dynamicDirections);
  void addKeptTriangles(const BaseTriangulation::Data& base);  // also lists the new triangles in `which`
  void markSpoiled(const Triangle& t) {
    for (std::uint32_t corner : t.corner) spoiled[corner] = 1;
  }
  void finishAreas();
  void setFlatAreas();
};

void VoronoiWorkspace::Data::build(std::span<const Site> sites) {
  triangulation.build(sites, scratch);
  solidAngles.resize(sites.size());
  area.assign(sites.size(), 0);
  spoiled.assign(sites.size(), 0);
  if (triangulation.isFlat()) {
    setFlatAreas();
  } else {
    which.clear();
    for (std::uint32_t t = 0; t < triangulation.delaunay.triangles.size(); ++t) {
      if (triangulation.delaunay.triangles[t].corner[0] != kNone) which.push_back(t);
    }
    addKites(triangulation.delaunay, which, area, spoiled);
    finishAreas();
  }
}

void VoronoiWorkspace::Data::query(const BaseTriangulation::Data& base,
                                   std::span<const V3d> dynamicDirections) {
  const Triangulation& from = base.triangulation;
  const std::size_t kept = from.delaunay.sites.size();
  if (from.isFlat()) {
    added = from.delaunay.sites;
    appendChecked(dynamicDirections, added);
    build(added);
    return;
  }
  added.clear();
  appendChecked(dynamicDirections, added);
  orderAlongCurve(added, scratch, addedOrder);
  triangulation = from;
  Delaunay& delaunay = triangulation.delaunay;
  delaunay.counts = {};
  for (std::uint32_t i : addedOrder) {
    triangulation.order.push_back(static_cast<std::uint32_t>(kept + i));
    delaunay.insert(added[i]);
  }
  solidAngles.resize(delaunay.sites.size());
  area.assign(solidAngles.size(), 0);
  spoiled.assign(solidAngles.size(), 0);
  addKeptTriangles(base);
  addKites(triangulation.delaunay, which, area, spoiled);
  finishAreas();
}

void VoronoiWorkspace::Data::addKeptTriangles(const BaseTriangulation::Data& base) {
  // Replaced triangles are recognized by their first corner: in new triangles it is a site that was added
  // later, which no base triangle has. For replaced triangles, 0 is added instead of branching, because the
  // branch would be mispredicted.
  const auto& triangles = triangulation.delaunay.triangles;
  const std::size_t kept = base.triangulation.delaunay.sites.size(), places = base.kites.size();
  which.resize(triangles.size());
  std::size_t added = 0;
  for (std::uint32_t t = 0; t < places; ++t) {
    const Triangle& triangle = triangles[t];
    const bool isNew = triangle.corner[0] >= kept;
    which[added] = t;
    added += isNew;
    if (base.anyUnused && triangle.corner[0] == kNone) continue;
    for (int i = 0; i < 3; ++i) area[triangle.corner[i]] += isNew ? 0.0 : base.kites[t][i];
    if (base.anyWide && base.wide[t] && !isNew) markSpoiled(triangle);
  }
  for (auto t = static_cast<std::uint32_t>(places); t < triangles.size(); ++t) which[added++] = t;
  which.resize(added);
  if (!triangulation.delaunay.unused.empty())
    std::erase_if(which, [&](std::uint32_t t) { return triangles[t].corner[0] == kNone; });
}

void VoronoiWorkspace::Data::finishAreas() {
  const Delaunay& delaunay = triangulation.delaunay;
  bool anyMerged = false;
  for (std::uint32_t site = 0; site < area.size(); ++site) {
    anyMerged = anyMerged || delaunay.standsFor[site] != site;
    if (spoiled[site]) area[site] = carefulSolidAngle(delaunay, site);
    // In a cluster within an ulp, the cells are as small as the deviations of the radii of the hull's points
    // from 1 (predicates.h).
    if (area[site] < 0 && area[site] > -kLeastArea) area[site] = 0;
  }
  if (anyMerged) {
    sharers.assign(area.size(), 0);
    for (std::uint32_t site = 0; site < area.size(); ++site) ++sharers[last(delaunay.standsFor, site)];
    for (std::uint32_t site = 0; site < area.size(); ++site) {
      if (sharers[site] > 1) area[site] /= sharers[site];
    }
    for (std::uint32_t site = 0; site < area.size(); ++site)
      area[site] = area[last(delaunay.standsFor, site)];
  }
  for (std::uint32_t site = 0; site < area.size(); ++site)
    solidAngles[triangulation.order[site]] = area[site];
}

void VoronoiWorkspace::Data::setFlatAreas() {
  const auto& sites = triangulation.delaunay.sites;
  const auto& few = triangulation.few;
  std::array<double, 3> cell = {kSphere, kSphere / 2, kSphere / 2};
  if (few.size() == 2) cell[0] = kSphere / 2;
  if (few.size() == 3) {
    // Both sides of the plane triangle are faces of the hull, so that a cell is 2 pi minus its two angles
    // (kites.h).
    for (int i = 0; i < 3; ++i) {
      const long double angle = hullAngle(sites[few[(i + 1) % 3]], sites[few[(i + 2) % 3]], sites[few[i]]);
      cell[i] = static_cast<double>(2 * (std::numbers::pi_v<long double> - angle));
    }
  }
  std::array<int, 3> shares{};
  for (const Site& s : sites) ++shares[indexAmong(few, sites, s)];
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const std::size_t k = indexAmong(few, sites, sites[i]);
    solidAngles[i] = cell[k] / shares[k];
  }
}

BaseTriangulation::BaseTriangulation(std::span<const V3d> directions) {
  std::vector<Site> sites;
  appendChecked(directions, sites);
  VoronoiWorkspace workspace;
  workspace.data_->build(sites);
  auto data = std::make_unique<Data>();
  data->triangulation = std::move(workspace.data_->triangulation);
  if (!data->triangulation.isFlat()) {
    const Delaunay& delaunay = data->triangulation.delaunay;
    std::vector<std::uint32_t> all(delaunay.triangles.size());
    std::iota(all.begin(), all.end(), 0);
    // Free slots have no corners, so they are replaced by some other triangle.
    const auto used =
        std::ranges::find_if(all, [&](std::uint32_t t) { return delaunay.triangles[t].corner[0] != kNone; });
    for (std::uint32_t t : delaunay.unused) all[t] = *used;
    data->kites.resize(all.size());
    data->wide.resize(all.size());
    computeKites(delaunay, all, data->kites, data->wide);
    data->anyUnused = !delaunay.unused.empty();
    data->anyWide = std::ranges::find(data->wide, 1) != data->wide.end();
  }
  data_ = std::move(data);
}
BaseTriangulation::~BaseTriangulation() = default;

VoronoiWorkspace::VoronoiWorkspace() : data_(std::make_unique<Data>()) {}
VoronoiWorkspace::~VoronoiWorkspace() = default;
VoronoiWorkspace::VoronoiWorkspace(VoronoiWorkspace&&) noexcept = default;
VoronoiWorkspace& VoronoiWorkspace::operator=(VoronoiWorkspace&&) noexcept = default;
const PredicateCounts& VoronoiWorkspace::counts() const { return data_->triangulation.delaunay.counts; }

std::span<const double> cellSolidAngles(const BaseTriangulation& base, std::span<const V3d> dynamicDirections,
                                        VoronoiWorkspace& workspace) {
  workspace.data_->query(*base.data_, dynamicDirections);
  return workspace.data_->solidAngles;
}

std::span<const double> cellSolidAngles(std::span<const V3d> directions, VoronoiWorkspace& workspace) {
  auto& added = workspace.data_->added;
  added.clear();
  appendChecked(directions, added);
  workspace.data_->build(added);
  return workspace.data_->solidAngles;
}

std::vector<double> cellSolidAngles(std::span<const V3d> directions) {
  VoronoiWorkspace workspace;
  const std::span<const double> areas = cellSolidAngles(directions, workspace);
  return {areas.begin(), areas.end()};
}

VoronoiCells voronoiCells(const VoronoiWorkspace& workspace) {
  const auto& [delaunay, order, few] = workspace.data_->triangulation;
  const auto& sites = delaunay.sites;
  const std::size_t n = sites.size();
  VoronoiCells cells;
  cells.first.push_back(0);
  cells.mergedInto.resize(n);
  if (workspace.data_->triangulation.isFlat()) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::size_t self = indexAmong(few, sites, sites[i]);
      cells.mergedInto[i] = few[self];
      for (std::size_t k = 1; k < few.size(); ++k) {
        const std::uint32_t other = few[(self + k) % few.size()],
                            third = few[(self + k % 2 + 1) % few.size()];
        cells.neighbour.push_back(other);
        cells.vertex.push_back(few.size() == 3 ? circumcentre(sites[other].at, sites[third].at, sites[i].at)
                                               : V3d(0));
      }
      cells.first.push_back(static_cast<std::uint32_t>(cells.neighbour.size()));
    }
    return cells;
  }
  std::vector<std::uint32_t> siteOf(n);
  for (std::uint32_t site = 0; site < order.size(); ++site) siteOf[order[site]] = site;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t site = last(delaunay.standsFor, siteOf[i]);
    cells.mergedInto[i] = order[site];
    delaunay.around(site, [&, &delaunay = delaunay, &order = order](std::uint32_t t, int c) {
      const Triangle& triangle = delaunay.triangles[t];
      const std::uint32_t a = triangle.corner[Delaunay::kAfter[c]], b = triangle.corner[Delaunay::kBefore[c]];
      cells.neighbour.push_back(order[a]);
      cells.vertex.push_back(circumcentre(sites[a].at, sites[b].at, sites[site].at));
      return false;
    });
    cells.first.push_back(static_cast<std::uint32_t>(cells.neighbour.size()));
  }
  return cells;
}

}  // namespace rsphere
