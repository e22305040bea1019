// How far spherical means scatter: ours, and equal weights with light sources integrated apart (-Sk 0) that
// are given the same CPU time or the same number of directions, whichever is more. Over rotations of the
// directions (-Sr).
//
//   bench_importance [ROTATIONS]                        the scenes below
//   bench_importance ROTATIONS POINTS [options] scene   one of your own; POINTS: a file
//
// A line for each scene: directions, CPU time (ms a point, start-up left out) and root mean square of the
// relative deviations of the mean from its average over the rotations, for both; then ours, true over
// estimated.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>
#include <vector>

#include "cli/option_table.h"
#include "estimate/estimator.h"
#include "rad_parser/scene_file.h"
#include "scene/build_scene.h"
#include "tests/bench/support/bench_main.h"

namespace rsphere {
namespace {

struct Case {
  std::string name;
  std::vector<std::string> words;  // options, scene
  std::vector<V3d> points;
};

struct Figures {
  double directions = 0, milliseconds = 0;  // a point
  double rms = 0, estimated = 0;            // relative
};

Figures measure(const Transport& transport, SphereOptions o, const std::vector<V3d>& points, int rotations) {
  struct Sums {
    double value = 0, squares = 0, errors = 0;
  };
  std::vector<Sums> sums(points.size());
  Figures f;
  for (int k = 1; k <= rotations; ++k) {
    o.rotation = static_cast<uint64_t>(k);
    const SphereEstimator estimator(transport, o, true);
    SphereEstimator::Workspace workspace(estimator);
    const std::clock_t start = std::clock();
    for (size_t i = 0; i < points.size(); ++i) {
      const PointAnswer a = estimator.estimate(points[i], workspace);
      const double value = brightness(a.mean), error = a.brightnessError;
      sums[i].value += value;
      sums[i].squares += value * value;
      sums[i].errors += error * error;
      f.directions += static_cast<double>(a.directions);
    }
    f.milliseconds += 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  }
  const double n = rotations, all = n * static_cast<double>(points.size());
  for (const Sums& s : sums) {
    const double mean = s.value / n, variance = (s.squares - n * mean * mean) / (n - 1);
    f.rms += variance / (mean * mean) / static_cast<double>(points.size());
    f.estimated += s.errors / n / (mean * mean) / static_cast<double>(points.size());
  }
  return {f.directions / all, f.milliseconds / all, std::sqrt(f.rms), std::sqrt(f.estimated)};
}

void compare(const Case& c, int rotations) {
  std::vector<std::string> words{"rsphere"};
  words.insert(words.end(), c.words.begin(), c.words.end());
  const Options options = parseOptions(words);
  const rad::Warn quiet = [](std::string_view) {};
  const rad::ReadOptions read{options.commands, quiet};
  const Scene scene = buildScene(rad::readScene(options.scene, read), read, options.goals);
  const Transport transport(scene, options.ray, options.irradiance, options.sphere.basicRadiance, quiet);

  const Figures ours = measure(transport, options.sphere, c.points, rotations);
  SphereOptions equal = options.sphere;
  equal.densityFactor = 0;
  const Figures as = measure(transport, equal, c.points, std::max(2, rotations / 8));
  const double more = std::max(ours.milliseconds / as.milliseconds, ours.directions / as.directions);
  equal.baseDirections = static_cast<int>(more * equal.baseDirections);
  equal.mostDirections = 2 * equal.baseDirections;
  const Figures theirs = measure(transport, equal, c.points, rotations);
  fmt::print("{:<18} {:6.0f} {:7.2f} {:8.3f}%   {:6.0f} {:7.2f} {:8.3f}%   {:5.2f} {:9.2f}\n", c.name,
             ours.directions, ours.milliseconds, 100 * ours.rms, theirs.directions, theirs.milliseconds,
             100 * theirs.rms, theirs.rms / ours.rms, ours.rms / ours.estimated);
  std::fflush(stdout);
}

std::vector<Case> ourCases() {
  const auto with = [](std::vector<std::string> options, const std::string& scene) {
    for (const char* word : {"-ab", "3", "-dt", "0", "-dj", "1", "-ds", ".05", "-Sn", "512", "-Sx", "1024"})
      options.emplace_back(word);
    options.push_back(scene);
    return options;
  };
  std::vector<Case> cases;
  for (const bool goal : {false, true})
    for (const int spheres : {0, 20, 50, 100}) {
      const auto goals = goal ? std::vector<std::string>{"-Sg", "goal"} : std::vector<std::string>{};
      cases.push_back({fmt::format("openplan {}{}", spheres, goal ? " goal" : ""),
                       with(goals, fmt::format("!" RSPHERE_OPENPLAN " {}", spheres)),
                       {{6.4, 1.75, 1.2}, {14, 3.85, 1.2}, {6.4, 8.05, 1.2}, {14, 10.15, 1.2}}});
    }
  const std::string folder = RSPHERE_SCENES "/";
  cases.push_back({"mirror wall",
                   with({}, folder + "mirror.rad"),
                   {{1, 1, 1.2}, {2.8, 3.9, 1.2}, {1.5, 2.5, 1.2}, {4.6, 2.2, 1.6}}});
  cases.push_back({"chrome",
                   with({}, folder + "chrome.rad"),
                   {{2.8, 2.6, 1.3}, {2.2, 3.0, 1.2}, {1.5, 1.0, 1.2}, {3.6, 3, 1.2}}});
  cases.push_back({"desk beside goal",
                   with({"-Sg", "goal"}, folder + "goal_desk.rad"),
                   {{2.8, 1.2, 1.2}, {2.2, .8, 1.5}, {3.9, 1.9, 1.1}, {2.8, 1.9, 2.6}}});
  return cases;
}

int run(int argc, char** argv) {
  const int rotations = argc > 1 ? std::max(2, std::atoi(argv[1])) : 24;
  std::vector<Case> cases;
  if (argc > 3) {
    Case c{"own", std::vector<std::string>(argv + 3, argv + argc), {}};
    std::ifstream file(argv[2]);
    for (double x, y, z; file >> x >> y >> z;) c.points.push_back(V3d(x, y, z));
    if (c.points.empty()) throw rad::Error(fmt::format("no points in {}", argv[2]));
    cases.push_back(c);
  } else {
    cases = ourCases();
  }
  fmt::print("{:<18} ours: directions, ms, rms   equal weights, sources apart   ratio  true/est.\n", "");
  for (const Case& c : cases) compare(c, rotations);
  return 0;
}

}  // namespace
}  // namespace rsphere

int main(int argc, char** argv) { return rsphere::benchMain("bench_importance", rsphere::run, argc, argv); }
