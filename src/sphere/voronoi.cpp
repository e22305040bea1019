#include "sphere/voronoi.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "sphere/delaunay.h"
#include "sphere/kites.h"
#include "sphere/order.h"

namespace rsphere {
namespace {

constexpr std::uint32_t kNone = Delaunay::kNone;
constexpr double kSphere = 4 * std::numbers::pi;

double withoutDust(double x) { return std::abs(x) < kSmallestComponent ? 0.0 : x; }

void appendChecked(std::span<const V3d> directions, std::vector<V3d>& out) {
  if (out.size() + directions.size() > (1u << 29)) throw std::invalid_argument("more than 2^29 directions");
  for (const V3d& d : directions) {
    if (!(std::abs(d.length2() - 1) <= kUnitTolerance)) {
      throw std::invalid_argument("direction " + std::to_string(out.size()) + ": not a unit vector (" +
                                  std::to_string(d.x) + " " + std::to_string(d.y) + " " +
                                  std::to_string(d.z) + ")");
    }
    out.emplace_back(withoutDust(d.x), withoutDust(d.y), withoutDust(d.z));
  }
}

// A triangulation of directions in the order of a list. Below four different directions there is none, and
// few holds them.
struct Triangulation {
  Delaunay delaunay;
  std::vector<V3d> directions;
  std::vector<std::uint32_t> order;  // site -> direction
  std::vector<std::uint32_t> few;    // directions that differ, if less than four

  void build(OrderScratch& scratch) {
    orderForBuild(directions, scratch, order);
    few.clear();
    std::size_t taken = 0;
    for (std::size_t k = 0; k < order.size() && few.size() < 4; ++k) {
      const V3d& d = directions[order[k]];
      if (std::any_of(few.begin(), few.end(), [&](std::uint32_t f) { return directions[f] == d; })) continue;
      few.push_back(order[k]);
      std::swap(order[taken++], order[k]);
    }
    if (few.size() < 4) return;
    delaunay.start(directions[few[0]], directions[few[1]], directions[few[2]], directions[few[3]]);
    few.clear();
    for (std::size_t k = 4; k < order.size(); ++k) delaunay.insert(directions[order[k]]);
  }
};

// Adds kites to the cells of their corners and marks those that wide circles spoil.
void addKites(const Triangle& t, const Kites& kites, bool isWide, std::vector<double>& area,
              std::vector<std::uint8_t>& spoiled) {
  for (int i = 0; i < 3; ++i) area[t.corner[i]] += kites[i];
  if (isWide) {
    for (std::uint32_t corner : t.corner) spoiled[corner] = 1;
  }
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
  std::vector<double> solidAngles;
};

struct VoronoiWorkspace::Data {
  Triangulation triangulation;
  OrderScratch scratch;
  std::vector<std::uint32_t> dynamicOrder, which;
  std::vector<Kites> kites;
  std::vector<std::uint8_t> wide, spoiled;
  std::vector<double> area;  // of sites
  std::vector<std::uint32_t> sharers;
  std::vector<double> solidAngles;

  void build(std::span<const V3d> first, std::span<const V3d> second);
  void query(const BaseTriangulation::Data& base, std::span<const V3d> dynamicDirections);
  void addNewTriangles(std::uint32_t firstNewSite);
  void finishAreas();
  void setFewAreas();
};

void VoronoiWorkspace::Data::build(std::span<const V3d> first, std::span<const V3d> second) {
  triangulation.directions.clear();
  appendChecked(first, triangulation.directions);
  appendChecked(second, triangulation.directions);
  triangulation.build(scratch);
  solidAngles.assign(triangulation.directions.size(), 0);
  if (!triangulation.few.empty() || triangulation.directions.empty()) {
    setFewAreas();
    return;
  }
  area.assign(solidAngles.size(), 0);
  spoiled.assign(solidAngles.size(), 0);
  addNewTriangles(0);
  finishAreas();
}

void VoronoiWorkspace::Data::query(const BaseTriangulation::Data& base,
                                   std::span<const V3d> dynamicDirections) {
  const Triangulation& from = base.triangulation;
  if (!from.few.empty() || from.directions.empty()) {
    build(from.directions, dynamicDirections);
    return;
  }
  const std::size_t kept = from.directions.size();
  triangulation.few.clear();
  triangulation.directions = from.directions;
  appendChecked(dynamicDirections, triangulation.directions);
  const std::span<const V3d> added = std::span(triangulation.directions).subspan(kept);
  orderAlongCurve(added, scratch, dynamicOrder);
  triangulation.order = from.order;
  triangulation.delaunay = from.delaunay;
  triangulation.delaunay.counts = {};
  for (std::uint32_t i : dynamicOrder) {
    triangulation.order.push_back(static_cast<std::uint32_t>(kept + i));
    triangulation.delaunay.insert(added[i]);
  }
  solidAngles.assign(triangulation.directions.size(), 0);
  area.assign(solidAngles.size(), 0);
  spoiled.assign(solidAngles.size(), 0);
  // A triangle of the base has no corner that came later; new ones have theirs first.
  for (std::size_t t = 0; t < from.delaunay.triangles.size(); ++t) {
    const Triangle& triangle = triangulation.delaunay.triangles[t];
    if (triangle.corner[0] < kept) addKites(triangle, base.kites[t], base.wide[t], area, spoiled);
  }
  addNewTriangles(static_cast<std::uint32_t>(kept));
  finishAreas();
}

void VoronoiWorkspace::Data::addNewTriangles(std::uint32_t firstNewSite) {
  const auto& triangles = triangulation.delaunay.triangles;
  constexpr std::size_t kAtOnce = 4096;
  which.reserve(kAtOnce);
  kites.resize(kAtOnce);
  wide.resize(kAtOnce);
  for (std::uint32_t t = 0; t < triangles.size();) {
    which.clear();
    for (; t < triangles.size() && which.size() < kAtOnce; ++t) {
      if (triangles[t].corner[0] >= firstNewSite && triangles[t].corner[0] != kNone) which.push_back(t);
    }
    computeKites(triangulation.delaunay, which, kites, wide);
    for (std::size_t i = 0; i < which.size(); ++i)
      addKites(triangles[which[i]], kites[i], wide[i], area, spoiled);
  }
}

void VoronoiWorkspace::Data::finishAreas() {
  const Delaunay& delaunay = triangulation.delaunay;
  bool anyMerged = false;
  for (std::uint32_t site = 0; site < area.size(); ++site) {
    anyMerged = anyMerged || delaunay.standsFor[site] != site;
    if (spoiled[site]) area[site] = carefulSolidAngle(delaunay, site);
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

void VoronoiWorkspace::Data::setFewAreas() {
  const auto& [delaunay, directions, order, few] = triangulation;
  std::array<double, 3> cell = {kSphere, kSphere / 2, kSphere / 2};
  if (few.size() == 2) cell[0] = kSphere / 2;
  if (few.size() == 3) {
    // Both sides of the plane triangle are faces of the hull: a cell is 2 pi less its two angles (kites.h).
    for (int i = 0; i < 3; ++i) {
      const long double angle =
          hullAngle(directions[few[(i + 1) % 3]], directions[few[(i + 2) % 3]], directions[few[i]]);
      cell[i] = static_cast<double>(2 * (std::numbers::pi_v<long double> - angle));
    }
  }
  std::array<int, 3> shares{};
  const auto indexOf = [&](const V3d& d) {
    return std::find_if(few.begin(), few.end(), [&](std::uint32_t f) { return directions[f] == d; }) -
           few.begin();
  };
  for (const V3d& d : directions) ++shares[indexOf(d)];
  for (std::size_t i = 0; i < directions.size(); ++i) {
    solidAngles[i] = cell[indexOf(directions[i])] / shares[indexOf(directions[i])];
  }
}

BaseTriangulation::BaseTriangulation(std::span<const V3d> directions) {
  VoronoiWorkspace workspace;
  workspace.data_->build(directions, {});
  auto data = std::make_unique<Data>();
  data->triangulation = std::move(workspace.data_->triangulation);
  data->solidAngles = std::move(workspace.data_->solidAngles);
  const Delaunay& delaunay = data->triangulation.delaunay;
  if (data->triangulation.few.empty() && !directions.empty()) {
    std::vector<std::uint32_t> all(delaunay.triangles.size());
    std::iota(all.begin(), all.end(), 0);
    for (std::uint32_t t : delaunay.unused)
      all[t] = all[0] == t ? all[1] : all[0];  // no corners to read there
    data->kites.resize(all.size());
    data->wide.resize(all.size());
    computeKites(delaunay, all, data->kites, data->wide);
  }
  data_ = std::move(data);
}
BaseTriangulation::~BaseTriangulation() = default;
BaseTriangulation::BaseTriangulation(BaseTriangulation&&) noexcept = default;
BaseTriangulation& BaseTriangulation::operator=(BaseTriangulation&&) noexcept = default;
std::span<const V3d> BaseTriangulation::directions() const { return data_->triangulation.directions; }
std::span<const double> BaseTriangulation::solidAngles() const { return data_->solidAngles; }

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
  workspace.data_->build(directions, {});
  return workspace.data_->solidAngles;
}

std::vector<double> cellSolidAngles(std::span<const V3d> directions) {
  VoronoiWorkspace workspace;
  const std::span<const double> areas = cellSolidAngles(directions, workspace);
  return {areas.begin(), areas.end()};
}

VoronoiCells voronoiCells(const VoronoiWorkspace& workspace) {
  const auto& [delaunay, directions, order, few] = workspace.data_->triangulation;
  VoronoiCells cells;
  cells.first.push_back(0);
  cells.mergedInto.resize(directions.size());
  if (!few.empty() || directions.empty()) {
    for (std::uint32_t i = 0; i < directions.size(); ++i) {
      const auto self = static_cast<std::size_t>(
          std::find_if(few.begin(), few.end(),
                       [&](std::uint32_t f) { return directions[f] == directions[i]; }) -
          few.begin());
      cells.mergedInto[i] = few[self];
      for (std::size_t k = 1; k < few.size(); ++k) {
        const std::uint32_t other = few[(self + k) % few.size()],
                            third = few[(self + k % 2 + 1) % few.size()];
        cells.neighbour.push_back(other);
        cells.vertex.push_back(
            few.size() == 3 ? circumcentre(directions[other], directions[third], directions[i]) : V3d(0));
      }
      cells.first.push_back(static_cast<std::uint32_t>(cells.neighbour.size()));
    }
    return cells;
  }
  std::vector<std::uint32_t> siteOf(directions.size());
  for (std::uint32_t site = 0; site < order.size(); ++site) siteOf[order[site]] = site;
  for (std::uint32_t i = 0; i < directions.size(); ++i) {
    const std::uint32_t site = last(delaunay.standsFor, siteOf[i]);
    cells.mergedInto[i] = order[site];
    delaunay.around(site, [&](std::uint32_t t, int c) {
      const Triangle& triangle = delaunay.triangles[t];
      const std::uint32_t a = triangle.corner[Delaunay::kAfter[c]], b = triangle.corner[Delaunay::kBefore[c]];
      cells.neighbour.push_back(order[a]);
      cells.vertex.push_back(circumcentre(delaunay.sites[a], delaunay.sites[b], delaunay.sites[site]));
      return false;
    });
    cells.first.push_back(static_cast<std::uint32_t>(cells.neighbour.size()));
  }
  return cells;
}

std::optional<std::string> voronoiFault(const VoronoiWorkspace& workspace) {
  const auto& data = *workspace.data_;
  const auto& [delaunay, directions, order, few] = data.triangulation;
  if (directions.empty()) return std::nullopt;
  const double sum = std::accumulate(data.solidAngles.begin(), data.solidAngles.end(), 0.0);
  if (!(std::abs(sum - kSphere) <= 1e-12))
    return "the solid angles sum to 4 pi + " + std::to_string(sum - kSphere);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    if (!(data.solidAngles[i] > 0)) return "direction " + std::to_string(i) + " has no solid angle";
  }
  if (!few.empty()) return std::nullopt;
  PredicateCounts counts;
  std::size_t corners = 0, faces = 0;
  for (std::uint32_t site = 0; site < order.size(); ++site) corners += delaunay.standsFor[site] == site;
  for (std::uint32_t t = 0; t < delaunay.triangles.size(); ++t) {
    const Triangle& triangle = delaunay.triangles[t];
    if (triangle.corner[0] == kNone) continue;
    ++faces;
    for (int e = 0; e < 3; ++e) {
      const Triangle& other = delaunay.triangles[triangle.next[e]];
      const int back = other.next[0] == t ? 0 : other.next[1] == t ? 1 : 2;
      const std::uint32_t from = triangle.corner[Delaunay::kAfter[e]],
                          to = triangle.corner[Delaunay::kBefore[e]];
      if (other.next[back] != t || other.corner[Delaunay::kAfter[back]] != to ||
          other.corner[Delaunay::kBefore[back]] != from) {
        return "triangles do not fit together at direction " + std::to_string(order[from]);
      }
      if (circleHolds(delaunay.sites[triangle.corner[0]], delaunay.sites[triangle.corner[1]],
                      delaunay.sites[triangle.corner[2]], delaunay.sites[other.corner[back]], counts)) {
        return "the circle of directions " + std::to_string(order[triangle.corner[0]]) + " " +
               std::to_string(order[triangle.corner[1]]) + " " + std::to_string(order[triangle.corner[2]]) +
               " holds " + std::to_string(order[other.corner[back]]);
      }
    }
  }
  if (faces + 4 != 2 * corners) return "the triangulation is not closed";
  return std::nullopt;
}

}  // namespace rsphere
