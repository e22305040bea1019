#include "api/ray_contributions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "answer/answer_rays.h"
#include "answer/answer_writer.h"
#include "base/random.h"
#include "process/threads.h"

namespace rsphere::v1 {
namespace {

constexpr double kMostBins = 1e6;

// Sets bins that are numbered by function files. Throws rad::Error if these are invalid.
void setFunction(const Bins& bins, TrackedModifier& modifier) {
  BinDefinitions definitions;
  for (const std::string& file : bins.files) definitions.shared.push_back({true, file});
  definitions.parameters = bins.parameters;
  BinFunctions functions;
  modifier.bin = functions.compile("bin", bins.expression, definitions);
  const BinFunction count =
      functions.compile("count of bins", bins.count.empty() ? "0" : bins.count, definitions);
  const double number = count.isConstant() ? std::floor(count.constant() + .5) : 0;
  if (!(number >= 1 && number <= kMostBins))
    throw rad::Error(
        fmt::format("the count of bins, '{}', must be a constant from 1 to {:.0f}", bins.count, kMostBins));
  modifier.bins = static_cast<uint32_t>(number);
}

}  // namespace

std::vector<TrackedModifier> trackedModifiers(const std::vector<std::string>& of, const Bins& bins) {
  if (of.empty()) throw rad::Error("contributions() needs at least one modifier");
  if (bins.zones < 1 || bins.zones > kMostBins)
    throw rad::Error(fmt::format("{} zones: expected 1 to {:.0f}", bins.zones, kMostBins));
  TrackedModifier one;
  if (!bins.expression.empty()) {
    if (bins.zones > 1) throw rad::Error("zones and an expression of bins exclude each other");
    setFunction(bins, one);
  } else if (!bins.count.empty() || !bins.parameters.empty() || !bins.files.empty()) {
    throw rad::Error("bins need an expression of the number of a bin");
  } else if (bins.zones > 1) {
    one.bins = static_cast<uint32_t>(bins.zones);
    one.zones = std::make_shared<const EqualZones>(one.bins);
  }
  std::vector<TrackedModifier> modifiers;
  for (const std::string& name : of) {
    if (name == "void") throw rad::Error("cannot track 'void' modifier");
    const auto same = [&](const TrackedModifier& m) { return m.name == name; };
    if (std::ranges::any_of(modifiers, same)) throw rad::Error(fmt::format("duplicate modifier '{}'", name));
    modifiers.push_back(one);
    modifiers.back().name = name;
  }
  return modifiers;
}

RayContributions::RayContributions(const Transport& transport, const AnswerOptions& options,
                                   std::vector<TrackedModifier> modifiers, Contributed what, int samples,
                                   rad::Warn warn)
    : options_(options),
      samePlace_(transport.prepared().scene().samePlace),
      tracked_(transport.prepared(), std::move(modifiers), what, std::move(warn)),
      components_(static_cast<size_t>(tracked_.components())),
      samples_(samples) {
  for (unsigned i = 0; i < threadCount(options.threads); ++i)
    tracers_.emplace_back(transport.pathTracer(), tracked_);
  if (options.sphere.accuracy > 0)
    estimator_.emplace(transport,
                       RayEstimator::Options{options.sphere.accuracy, options.sphere.accuracyFloor}, what);
}

void RayContributions::answer(const Record& record, unsigned worker, std::string& bytes,
                              RunSummary& summary) {
  std::vector<double> sums(numbers()), errors(hasErrors() ? numbers() : 0);
  if (!record.bogus) {
    const InputRay in = inputRay(record.numbers.data(), options_.irradiance, samePlace_);
    const double farthest = options_.limitDistance ? in.length : 0;
    const uint64_t seed = seedOfRay(record.numbers, record.index, options_);
    const auto at = [&](const ContributionList& list, size_t i) {
      return list.columns()[i / components_] * components_ + i % components_;
    };
    if (estimator_) {
      const auto estimate = estimator_->estimate(tracers_[worker], in.origin, in.direction, farthest, seed);
      summary.add(record.index, estimate.sum);
      for (size_t i = 0; i < estimate.variances.size(); ++i) {
        sums[at(estimate.means, i)] = estimate.means.values()[i];
        errors[at(estimate.means, i)] = std::sqrt(estimate.variances[i]);
      }
    } else {
      const double n = samples_;
      for (int sample = 0; sample < samples_; ++sample) {
        const uint64_t own = sample == 0 ? seed : mixBits(seed + static_cast<uint64_t>(sample));
        const ContributionList& list = tracers_[worker].trace(in.origin, in.direction, farthest, own);
        for (size_t i = 0; i < list.values().size(); ++i) {
          sums[at(list, i)] += list.values()[i];
          if (samples_ > 1) errors[at(list, i)] += list.values()[i] * list.values()[i];
        }
      }
      for (double& sum : sums) sum /= n;
      for (size_t i = 0; i < errors.size(); ++i)
        errors[i] = std::sqrt(std::max(0., errors[i] / n - sums[i] * sums[i]) / (n - 1));
    }
  }
  for (const std::vector<double>* all : {&sums, &errors})
    bytes.append(reinterpret_cast<const char*>(all->data()), all->size() * sizeof(double));
}

}  // namespace rsphere::v1
