#include "rcontrib/contribution_run.h"

#include <unistd.h>

#include <optional>
#include <span>

#include "answer/answer_rays.h"
#include "answer/batch.h"
#include "answer/load_scene.h"
#include "cli/program.h"
#include "contrib/tracked.h"
#include "estimate/contribution_estimator.h"
#include "process/threads.h"
#include "rays/prepared_scene.h"
#include "rcontrib/contribution_outputs.h"
#include "rcontrib/record_sums.h"
#include "transport/transport.h"

namespace rsphere {
namespace {

// Converts -x and -y from numbers of records to numbers of rays, for runRecords().
AnswerOptions pacedByRays(const ContributionOptions& options) {
  AnswerOptions paced = options;
  const int64_t rays = options.raysPerRecord;
  if (rays == 0) {
    paced.width = paced.height = 0;
  } else if (options.height > 0) {
    paced.width = std::max<int64_t>(options.width, 1);
    paced.height = options.height * rays;
  } else {
    paced.width = options.width * rays;
  }
  return paced;
}

// estimator: null if a ray needs neither standard errors nor an accuracy. traced: index of the first ray to
// be traced; the rays before it were answered by an earlier run.
AnswerRecord answerContributions(std::vector<ContributionTracer>& tracers,
                                 const ContributionEstimator* estimator, const ContributionOptions& options,
                                 double samePlace, uint64_t traced, RunSummary& summary) {
  return [&tracers, estimator, &options, samePlace, traced, &summary](const Record& record, unsigned worker,
                                                                      std::string& bytes) {
    if (record.bogus || record.index < traced)
      return appendContributions(bytes, ContributionList(tracers[worker].components()));
    const InputRay in = inputRay(record.numbers.data(), options.irradiance, samePlace);
    const double farthest = options.limitDistance ? in.length : 0;
    const uint64_t seed = seedOfRay(record.numbers, record.index, options);
    if (!estimator)
      return appendContributions(bytes, tracers[worker].trace(in.origin, in.direction, farthest, seed));
    const ContributionEstimator::Estimate estimate =
        estimator->estimate(tracers[worker], in.origin, in.direction, farthest, seed);
    summary.add(record.index, estimate.sum);
    appendContributions(
        bytes, estimate.means,
        options.hasErrors() ? std::span<const double>(estimate.variances) : std::span<const double>());
  };
}

}  // namespace

void runContributions(const ContributionOptions& options, const Messages& messages, StopSignals& signals) {
  const rad::Warn warn = [&](std::string_view text) { messages.warning(text); };
  for (const std::string& warning : warningsOfUnused(options)) warn(warning);
  std::vector<TrackedModifier> modifiers = trackedModifiers(options);
  const Scene scene = loadScene(options, warn);
  const Transport transport(scene, options.ray, options.irradiance, false, warn);
  if (lacksSources(transport.prepared())) warn("no light sources found");
  const Contributed what = options.values ? Contributed::values : Contributed::coefficients;
  const Tracked tracked(transport.prepared(), std::move(modifiers), what, warn);
  std::vector<ContributionTracer> tracers;
  for (unsigned i = 0; i < threadCount(options.threads); ++i)
    tracers.emplace_back(transport.pathTracer(), tracked);

  // The error of a record of several rays is that of their spread.
  std::optional<const ContributionEstimator> estimator;
  if (options.sphere.accuracy > 0 || (options.hasErrors() && options.raysPerRecord == 1))
    estimator.emplace(transport, RayEstimator::Options{options.sphere.accuracy, options.sphere.accuracyFloor},
                      what);

  RecordReader reader = readerOf(0, options);
  ContributionOutputs outputs(options, tracked, scene.description.header);
  const auto rays = static_cast<uint64_t>(options.raysPerRecord);
  RecordSums sums(outputs, tracked.columns(), static_cast<size_t>(tracked.components()), rays,
                  outputs.recovered(), options.hasErrors());
  const AnswerOptions paced = pacedByRays(options);
  RunSummary summary;
  RunEnd end;
  end.ended = [&] { summary.tell(messages, options, transport.prepared()); };
  end.leave = [&](const std::exception_ptr& fault) {
    _exit(exitStatus(messages, [&]() -> int { std::rethrow_exception(fault); }));
  };
  bool shortInput = false;
  end.shortInput = [&shortInput] { shortInput = true; };
  runRecords(reader, sums, paced, messages, &signals,
             withSensors(answerContributions(tracers, estimator ? &*estimator : nullptr, options,
                                             scene.samePlace, outputs.recovered() * rays, summary),
                         options, transport.prepared(), summary),
             end);
  if (sums.end() > 0)
    warn("partial record: the last one is the mean over the rays that are left, fewer than -c");
  outputs.close();
  if (shortInput) throw rad::Error("unexpected EOF on input");
}

}  // namespace rsphere
