#pragma once
#include <Imath/ImathVec.h>
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sphere/directions.h"

// What is measured, the same for each program.
namespace bench {

using Imath::V3d;

inline constexpr std::size_t kBase = 2048, kDynamic = 1030, kQueries = 200;

// n directions without order, distributed evenly.
std::vector<V3d> randomDirections(std::size_t n, std::uint64_t seed);

// 200 sets of 1030 dynamic directions. caps: 10 caps of 2 to 10 degrees, evenly filled: objects that a mirror
// or a lamp is seen as. rings: their rims, cocircular but for rounding. uniform: all over the sphere.
enum class Kind { caps, rings, uniform };
const std::vector<std::vector<V3d>>& queries(Kind kind);

// Solid angles the usual way, added for a facet of a hull: the circumcentre is the facet's unit normal, and
// each edge makes an isosceles triangle with it, half for either end.
inline void addFacet(const std::array<V3d, 3>& corner, const std::array<std::size_t, 3>& index,
                     const V3d& normal, std::span<double> areas) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const V3d &a = corner[i], &b = corner[j];
    const double half = std::atan2(normal.dot(a.cross(b)), 1 + a.dot(b) + 2 * normal.dot(a));
    areas[index[i]] += half;
    areas[index[j]] += half;
  }
}

inline void requireSphere(benchmark::State& state, std::span<const double> areas) {
  double sum = 0;
  for (double a : areas) sum += a;
  if (!(std::abs(sum - 4 * M_PI) < 1e-6)) state.SkipWithError("areas do not sum to 4 pi");
}

// Registers name/caps, name/rings and name/uniform.
template <class Run>
void registerQueries(const std::string& name, Run run) {
  const std::pair<const char*, Kind> kinds[] = {
      {"/caps", Kind::caps}, {"/rings", Kind::rings}, {"/uniform", Kind::uniform}};
  for (const auto& [suffix, kind] : kinds) {
    benchmark::RegisterBenchmark((name + suffix).c_str(), run, kind)->Unit(benchmark::kMillisecond);
  }
}

// Registers name/N for N from a thousand to a million.
template <class Run>
void registerFull(const std::string& name, Run run) {
  benchmark::RegisterBenchmark(name.c_str(), run)
      ->Arg(1000)
      ->Arg(3078)
      ->Arg(10000)
      ->Arg(100000)
      ->Arg(1000000)
      ->Unit(benchmark::kMillisecond);
}

}  // namespace bench
