#include <CGAL/Delaunay_triangulation_on_sphere_2.h>
#include <CGAL/Delaunay_triangulation_on_sphere_traits_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/Triangulation_on_sphere_face_base_2.h>
#include <CGAL/Triangulation_on_sphere_vertex_base_2.h>
#include <CGAL/spatial_sort.h>

#include "sets.h"

namespace {

using namespace bench;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Traits = CGAL::Delaunay_triangulation_on_sphere_traits_2<Kernel>;

// A vertex with its place among the directions.
template <class Base>
struct NumberedVertex : Base {
  using Base::Base;
  template <class Structure>
  struct Rebind_TDS {
    using Other = NumberedVertex<typename Base::template Rebind_TDS<Structure>::Other>;
  };
  std::size_t number = 0;
};
using Structure =
    CGAL::Triangulation_data_structure_2<NumberedVertex<CGAL::Triangulation_on_sphere_vertex_base_2<Traits>>,
                                         CGAL::Triangulation_on_sphere_face_base_2<Traits>>;
using Triangulation = CGAL::Delaunay_triangulation_on_sphere_2<Traits, Structure>;

// Inserts in the order of CGAL's own sort, each with the last face as a hint.
void insert(Triangulation& triangulation, const std::vector<V3d>& directions, std::size_t firstNumber) {
  std::vector<std::size_t> order(directions.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::vector<Kernel::Point_3> points;
  points.reserve(directions.size());
  for (const V3d& d : directions) points.emplace_back(d.x, d.y, d.z);
  using Places = CGAL::Pointer_property_map<Kernel::Point_3>::type;
  using SortTraits = CGAL::Spatial_sort_traits_adapter_3<Kernel, Places>;
  // Its sort for spheres does not compile with numbers (5.5); this one is as good.
  CGAL::spatial_sort(order.begin(), order.end(), SortTraits(CGAL::make_property_map(points), Kernel()));
  Triangulation::Face_handle hint;
  for (std::size_t i : order) {
    const auto vertex = triangulation.insert(points[i], hint);
    if (vertex == Triangulation::Vertex_handle()) continue;
    vertex->number = firstNumber + i;
    hint = vertex->face();
  }
}

void cgalAreas(const Triangulation& triangulation, std::size_t n, std::vector<double>& areas) {
  areas.assign(n, 0);
  for (auto face = triangulation.all_faces_begin(); face != triangulation.all_faces_end(); ++face) {
    std::array<V3d, 3> corner;
    std::array<std::size_t, 3> index;
    for (int i = 0; i < 3; ++i) {
      const auto& p = face->vertex(i)->point();
      corner[i] = V3d(p.x(), p.y(), p.z());
      index[i] = face->vertex(i)->number;
    }
    addFacet(corner, index, (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized(), areas);
  }
}

void cgalQuery(benchmark::State& state, Kind kind) {
  const auto& sets = queries(kind);
  Triangulation base(Traits(Kernel::Point_3(0, 0, 0), 1));
  insert(base, rsphere::baseDirections(kBase), 0);
  std::vector<double> areas;
  for (std::size_t q = 0; auto _ : state) {
    Triangulation copy(base);
    insert(copy, sets[q++ % sets.size()], kBase);
    cgalAreas(copy, kBase + kDynamic, areas);
  }
  requireSphere(state, areas);
}

void cgalFull(benchmark::State& state) {
  const auto directions = randomDirections(state.range(0), 1);
  std::vector<double> areas;
  for (auto _ : state) {
    Triangulation triangulation(Traits(Kernel::Point_3(0, 0, 0), 1));
    insert(triangulation, directions, 0);
    cgalAreas(triangulation, directions.size(), areas);
  }
  requireSphere(state, areas);
}

const bool registered = [] {
  registerQueries("cgal_query", cgalQuery);
  registerFull("cgal_full", cgalFull);
  return true;
}();

}  // namespace
