extern "C" {
#include <libqhull_r/libqhull_r.h>
}

#include <cstdio>

#include "sets.h"

namespace {

using namespace bench;

// qhull has no insertion into a hull that is kept: a query is a hull of all directions.
bool qhullAreas(const std::vector<V3d>& directions, std::vector<double>& areas) {
  areas.assign(directions.size(), 0);
  std::vector<V3d> points = directions;  // qhull may change them
  char options[] = "qhull Qt";
  qhT memory;
  qhT* qh = &memory;
  qh_zero(qh, stderr);
  const int status =
      qh_new_qhull(qh, 3, static_cast<int>(points.size()), &points[0].x, False, options, nullptr, stderr);
  facetT* facet;
  FORALLfacets {
    if (status != 0) break;
    std::array<V3d, 3> corner;
    std::array<std::size_t, 3> index;
    for (int i = 0; i < 3; ++i) {
      const auto* vertex = static_cast<const vertexT*>(facet->vertices->e[i].p);
      index[i] = qh_pointid(qh, vertex->point);
      corner[i] = directions[index[i]];
    }
    if (facet->toporient) {
      std::swap(corner[0], corner[1]);
      std::swap(index[0], index[1]);
    }
    addFacet(corner, index, V3d(facet->normal[0], facet->normal[1], facet->normal[2]), areas);
  }
  qh_freeqhull(qh, !qh_ALL);
  int left = 0, total = 0;
  qh_memfreeshort(qh, &left, &total);
  return status == 0;
}

void qhullQuery(benchmark::State& state, Kind kind) {
  const auto& sets = queries(kind);
  const auto base = rsphere::baseDirections(kBase);
  std::vector<double> areas;
  std::vector<V3d> all;
  for (std::size_t q = 0; auto _ : state) {
    all = base;
    const auto& added = sets[q++ % sets.size()];
    all.insert(all.end(), added.begin(), added.end());
    if (!qhullAreas(all, areas)) state.SkipWithError("qhull failed");
  }
  requireSphere(state, areas);
}

void qhullFull(benchmark::State& state) {
  const auto directions = randomDirections(state.range(0), 1);
  std::vector<double> areas;
  for (auto _ : state) {
    if (!qhullAreas(directions, areas)) state.SkipWithError("qhull failed");
  }
  requireSphere(state, areas);
}

const bool registered = [] {
  registerQueries("qhull_query", qhullQuery);
  registerFull("qhull_full", qhullFull);
  return true;
}();

}  // namespace
