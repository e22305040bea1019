#include "sphere/voronoi.h"

#include <random>

#include "sets.h"

namespace bench {

std::vector<V3d> randomDirections(std::size_t n, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<V3d> directions(n);
  for (V3d& d : directions) {
    d.x = normal(random);
    d.y = normal(random);
    d.z = normal(random);
    d.normalize();
  }
  return directions;
}

const std::vector<std::vector<V3d>>& queries(Kind kind) {
  static const std::array<std::vector<std::vector<V3d>>, 3> sets = [] {
    std::array<std::vector<std::vector<V3d>>, 3> made;
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> unit;
    for (std::size_t q = 0; q < kQueries; ++q) {
      std::vector<V3d> caps, rings;
      for (const V3d& axis : randomDirections(10, 1000 + q)) {
        const V3d side = axis.cross(std::abs(axis.x) < 0.5 ? V3d(1, 0, 0) : V3d(0, 1, 0)).normalized();
        const V3d up = axis.cross(side);
        const double radius = (2 + 8 * unit(random)) * M_PI / 180;
        for (int i = 0; i < 103; ++i) {
          const auto at = [&](double angle, double turn) {
            return (axis * std::cos(angle) + (side * std::cos(turn) + up * std::sin(turn)) * std::sin(angle))
                .normalized();
          };
          caps.push_back(at(radius * std::sqrt(unit(random)), 2 * M_PI * unit(random)));
          rings.push_back(at(radius, 2 * M_PI * i / 103));
        }
      }
      made[0].push_back(std::move(caps));
      made[1].push_back(std::move(rings));
      made[2].push_back(randomDirections(kDynamic, 2000 + q));
    }
    return made;
  }();
  return sets[static_cast<std::size_t>(kind)];
}

}  // namespace bench

namespace {

using namespace bench;

void voronoiQuery(benchmark::State& state, Kind kind) {
  const rsphere::BaseTriangulation base(rsphere::baseDirections(kBase));
  rsphere::VoronoiWorkspace workspace;
  const auto& sets = queries(kind);
  std::span<const double> areas;
  for (std::size_t q = 0; auto _ : state)
    areas = rsphere::cellSolidAngles(base, sets[q++ % sets.size()], workspace);
  requireSphere(state, areas);
}

void voronoiFull(benchmark::State& state) {
  const auto directions = randomDirections(state.range(0), 1);
  rsphere::VoronoiWorkspace workspace;
  std::span<const double> areas;
  for (auto _ : state) areas = rsphere::cellSolidAngles(directions, workspace);
  requireSphere(state, areas);
}

}  // namespace

int main(int argc, char** argv) {
  registerQueries("voronoi_query", voronoiQuery);
  registerFull("voronoi_full", voronoiFull);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
