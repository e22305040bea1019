// The bias of stopping: -Sa averages sets of directions until the error that they estimate is small enough.
// Sets of many rotations are drawn first, and answers made of them, in another order each time, by three
// rules:
//   one     stop on what is averaged
//   halves  TwoHalves, as -Sa has it: each half decides for the other
//   pilot   a first set decides how many more there are, and is thrown away
// The bias is that of an answer against the mean of all sets that were drawn at its point, so that the sets'
// own errors cancel.
//
//   bench_stopping SETS ORDERS ACCURACY POINTS [options] scene     POINTS: a file
//
// A line for each rule: sets an answer, bias with its standard error, rms error, and the share of answers
// that estimate an error above the accuracy; all of them averaged over the points.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "base/random.h"
#include "cli/option_table.h"
#include "estimate/estimator.h"
#include "estimate/two_halves.h"
#include "rad_parser/scene_file.h"
#include "scene/build_scene.h"
#include "tests/bench/support/bench_main.h"
#include "tests/unit/support/spread.h"

namespace rsphere {
namespace {

struct Set {
  double total = 0, variance = 0;
};

// What a rule makes of some sets.
struct Stopped {
  double mean = 0, error = 0;
  size_t sets = 0;
};

double errorOf(const std::vector<Set>& sets, size_t first, size_t end) {
  double total = 0, variance = 0;
  for (size_t i = first; i < end; ++i) {
    total += sets[i].total;
    variance += sets[i].variance;
  }
  return std::sqrt(variance) / total;
}

double meanOf(const std::vector<Set>& sets, size_t first, size_t end) {
  double total = 0;
  for (size_t i = first; i < end; ++i) total += sets[i].total;
  return total / static_cast<double>(end - first);
}

Stopped stopOnOne(const std::vector<Set>& sets, double accuracy) {
  size_t count = 1;
  while (count < sets.size() && errorOf(sets, 0, count) > accuracy) ++count;
  return {meanOf(sets, 0, count), errorOf(sets, 0, count), count};
}

Stopped stopOnHalves(const std::vector<Set>& sets, double accuracy) {
  TwoHalves decision(accuracy);
  double totals[2] = {0, 0}, variances[2] = {0, 0};
  size_t count = 0;
  for (auto half = decision.next(); half && count < sets.size(); half = decision.next(), ++count) {
    decision.add(*half, sets[count].total, sets[count].variance);
    totals[*half] += sets[count].total;
    variances[*half] += sets[count].variance;
  }
  const double a = decision.share(0), b = decision.share(1);
  const double mean = a * totals[0] + b * totals[1];
  return {mean, std::sqrt(a * a * variances[0] + b * b * variances[1]) / mean, count};
}

Stopped stopOnPilot(const std::vector<Set>& sets, double accuracy) {
  const double wanted = accuracy * sets[0].total;
  const double needed = std::ceil(sets[0].variance / (wanted * wanted));
  const size_t end = 1 + static_cast<size_t>(std::clamp(needed, 1., static_cast<double>(sets.size() - 1)));
  return {meanOf(sets, 1, end), errorOf(sets, 1, end), end};
}

int run(int argc, char** argv) {
  if (argc < 6) {
    fmt::print(stderr, "usage: bench_stopping SETS ORDERS ACCURACY POINTS [options] scene\n");
    return 1;
  }
  const int sets = std::atoi(argv[1]), orders = std::atoi(argv[2]);
  const double accuracy = std::atof(argv[3]);
  std::vector<V3d> points;
  std::ifstream file(argv[4]);
  for (double x, y, z; file >> x >> y >> z;) points.push_back(V3d(x, y, z));
  std::vector<std::string> words{"rsphere"};
  words.insert(words.end(), argv + 5, argv + argc);
  const Options options = parseOptions(words);
  const rad::Warn quiet = [](std::string_view) {};
  const rad::ReadOptions read{options.commands, quiet};
  const Scene scene = buildScene(rad::readScene(options.scene, read), read, options.goals);
  const Transport transport(scene, options.ray, options.irradiance, options.sphere.basicRadiance, quiet);

  std::vector<std::vector<Set>> drawn(points.size());
  double directions = 0;
  for (int k = 1; k <= sets; ++k) {
    SphereOptions o = options.sphere;
    o.rotation = static_cast<uint64_t>(k);
    const SphereEstimator estimator(transport, o, true);
    SphereEstimator::Workspace workspace(estimator);
    for (size_t i = 0; i < points.size(); ++i) {
      const PointAnswer a = estimator.estimate(points[i], workspace);
      drawn[i].push_back({brightness(a.mean), a.brightnessError * a.brightnessError});
      directions += static_cast<double>(a.directions);
    }
  }
  const double n = static_cast<double>(points.size());
  fmt::print("{} sets of {:.0f} directions at {} points, {} orders, -Sa {}\n", sets, directions / sets / n,
             points.size(), orders, accuracy);

  struct Rule {
    const char* name;
    std::function<Stopped(const std::vector<Set>&, double)> stop;
  };
  for (const Rule& rule :
       {Rule{"one", stopOnOne}, Rule{"halves", stopOnHalves}, Rule{"pilot", stopOnPilot}}) {
    double bias = 0, variance = 0, square = 0, used = 0, above = 0;  // averages over the points
    for (const std::vector<Set>& all : drawn) {
      const double mean = meanOf(all, 0, all.size());
      Random random(1);
      // The bias in each order of all sets, one answer after the other until they are used up.
      Spread ofOrders, biases, squares, counts, tooLarge;
      for (int order = 0; order < orders; ++order) {
        std::vector<Set> left = all;
        for (size_t i = left.size() - 1; i > 0; --i)
          std::swap(left[i], left[static_cast<size_t>(random.uniform() * static_cast<double>(i + 1))]);
        Spread ofOrder;
        while (left.size() > all.size() / 4) {
          const Stopped stopped = rule.stop(left, accuracy);
          left.erase(left.begin(), left.begin() + static_cast<ptrdiff_t>(stopped.sets));
          const double off = stopped.mean / mean - 1;
          ofOrder.add(off);
          biases.add(off);
          squares.add(off * off);
          counts.add(static_cast<double>(stopped.sets));
          tooLarge.add(stopped.error > accuracy ? 1 : 0);
        }
        ofOrders.add(ofOrder.mean());
      }
      bias += biases.mean() / n;
      square += squares.mean() / n;
      used += counts.mean() / n;
      above += tooLarge.mean() / n;
      variance += ofOrders.variance() / orders / (n * n);
    }
    fmt::print("  {:<8} {:5.2f} sets  bias {:+.4f} +- {:.4f}%  rms {:.3f}%  above {:.3f}\n", rule.name, used,
               100 * bias, 100 * std::sqrt(variance), 100 * std::sqrt(square), above);
  }
  return 0;
}

}  // namespace
}  // namespace rsphere

int main(int argc, char** argv) { return rsphere::benchMain("bench_stopping", rsphere::run, argc, argv); }
