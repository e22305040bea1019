// Which paths make the tails of spherical means: the directions that sphere mode chooses at some points are
// traced many times, and what each path brings to the mean is summed by what the path hits.
//
//   bench_heavy_paths REPEATS POINTS [options] scene     POINTS: a file
//
// First a line for each kind of path, those that cause most of the variance first: its share of the sum of
// squared contributions, its share of the mean, the largest single contribution (relative to the mean of its
// point), and the modifiers that its rays hit, from the point on ("*": mirrored or refracted sharply there,
// "~": by a rough highlight, nothing: diffusely). Then the largest single contributions, with the places that
// were hit.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "cli/option_table.h"
#include "estimate/estimator.h"
#include "rad_parser/scene_file.h"
#include "scene/build_scene.h"
#include "tests/bench/support/bench_main.h"

namespace rsphere {
namespace {

constexpr size_t kKinds = 24, kSingles = 12;

struct Kind {
  double sum = 0, squares = 0, largest = 0;  // of contributions, relative to the mean of the point
};

struct Single {
  double contribution = 0;
  std::string path;
};

// How a ray left the surface before it.
std::string_view markOf(const PathContext& ray) {
  if (ray.kind & (kAmbient | kShadow)) return "";
  return ray.kind & kSpecular ? "~" : "*";
}

// The surfaces that a path hits, from its beginning to the ray; with their places if asked for.
std::string pathOf(const Scene& scene, const RayEnd& end, bool places) {
  std::string path;
  for (const RayEnd* e = &end; e; e = e->context.parent) {
    const SurfaceId surface = e->hit.surface;
    std::string hit(surface == kNone ? "nothing" : scene.modifierName(scene.surfaces[surface]));
    const V3d& point = e->hit.point;
    if (places) hit += fmt::format(" ({:.2f} {:.2f} {:.2f})", point.x, point.y, point.z);
    if (e->context.parent) hit.insert(0, markOf(e->context));
    path = path.empty() ? hit : hit + " > " + path;
  }
  return path;
}

int run(int argc, char** argv) {
  if (argc < 4) throw rad::Error("usage: bench_heavy_paths REPEATS POINTS [options] scene");
  const int repeats = std::max(1, std::atoi(argv[1]));
  std::vector<V3d> points;
  std::ifstream file(argv[2]);
  for (double x, y, z; file >> x >> y >> z;) points.push_back(V3d(x, y, z));
  if (points.empty()) throw rad::Error(fmt::format("no points in {}", argv[2]));
  std::vector<std::string> words{argv[0]};
  words.insert(words.end(), argv + 3, argv + argc);
  const Options options = parseOptions(words);
  const rad::Warn quiet = [](std::string_view) {};
  const rad::ReadOptions read{options.commands, quiet};
  const Scene scene = buildScene(rad::readScene(options.scene, read), read, options.goals);
  const Transport transport(scene, options.ray, options.irradiance, options.sphere.basicRadiance, quiet);

  std::map<std::string, Kind> kinds;
  std::vector<Single> singles;
  double squares = 0, sum = 0;
  for (int k = 1; k <= repeats; ++k) {
    SphereOptions o = options.sphere;
    o.rotation = static_cast<uint64_t>(k);
    const SphereEstimator estimator(transport, o);
    SphereEstimator::Workspace workspace(estimator), again(estimator);
    Random random(mixBits(static_cast<uint64_t>(k)));
    for (const V3d& point : points) {
      const double mean = brightness(estimator.estimate(point, workspace).mean);
      if (!(mean > 0)) continue;
      for (const DirectionSample& sample : workspace.samples) {
        if (sample.toSource) continue;
        const double share = sample.solidAngle / (4 * kPi) / mean;
        // Light arrives where a ray sees a source: its value is then what the source emits. What samples of a
        // lobe estimate of near sources (shared_highlights.h) is not among it.
        const RayObserver observer = [&](const RayEnd& end, const RayResult& result) {
          const SurfaceId surface = end.hit.surface;
          if (surface == kNone || !end.context.parent) return;
          if (transport.prepared().lights().of(surface) == kNone || isBlack(result.value)) return;
          const double contribution = brightness(result.value * end.context.contribution) * share;
          if (!(contribution > 0)) return;
          Kind& kind = kinds[pathOf(scene, end, false)];
          kind.sum += contribution;
          kind.squares += contribution * contribution;
          kind.largest = std::max(kind.largest, contribution);
          sum += contribution;
          squares += contribution * contribution;
          if (singles.size() < kSingles || contribution > singles.back().contribution) {
            singles.push_back({contribution, pathOf(scene, end, true)});
            std::sort(singles.begin(), singles.end(),
                      [](const Single& a, const Single& b) { return a.contribution > b.contribution; });
            if (singles.size() > kSingles) singles.pop_back();
          }
        };
        again.tracer.trace(point, sample.direction, 0, random.bits(),
                           {.observer = &observer, .shadows = ShownShadows::all});
      }
    }
  }
  std::vector<std::pair<std::string, Kind>> sorted(kinds.begin(), kinds.end());
  std::sort(sorted.begin(), sorted.end(),
            [](const auto& a, const auto& b) { return a.second.squares > b.second.squares; });
  fmt::print("squares    mean  largest  path\n");
  for (size_t i = 0; i < std::min(kKinds, sorted.size()); ++i) {
    const auto& [path, kind] = sorted[i];
    fmt::print("{:6.1f}% {:6.1f}% {:7.2f}%  {}\n", 100 * kind.squares / squares, 100 * kind.sum / sum,
               100 * kind.largest, path);
  }
  fmt::print("\nlargest\n");
  for (const Single& s : singles) fmt::print("{:7.2f}%  {}\n", 100 * s.contribution, s.path);
  return 0;
}

}  // namespace
}  // namespace rsphere

int main(int argc, char** argv) { return rsphere::benchMain("bench_heavy_paths", rsphere::run, argc, argv); }
