#include "answer/answer_rays.h"

#include <memory>

#include "process/threads.h"
#include "rays/ray_report.h"
#include "scene/modifier_names.h"

namespace rsphere {

uint64_t seedOfRay(std::span<const double> numbers, uint64_t index, const AnswerOptions& options) {
  const uint64_t seed = seedOf(numbers, rotationBits(options.ray));
  return options.numberedRays ? mixBits(seed ^ mixBits(index)) : seed;
}

AnswerRecord answerRays(const Transport& transport, const AnswerOptions& options, const AnswerWriter& writer,
                        const rad::Warn& warn, RunSummary& summary) {
  const auto tracers = forThreads(options.threads, [&] { return transport.pathTracer(); });
  const RayEstimator::Options how{options.sphere.accuracy, options.sphere.accuracyFloor};
  const auto estimator =
      options.estimatesRays() ? std::make_shared<const RayEstimator>(transport, how) : nullptr;
  const auto ofSets = estimator ? forThreads(options.threads, [&] { return estimator->tracers(); }) : nullptr;
  const bool trees = !options.treeOutputs.empty(), value = trees || needsValue(options.outputs);
  const ShownShadows shadows = options.treeShadows ? ShownShadows::all : ShownShadows::thatPassSurfaces;
  const bool valueAlone = options.outputs == "v";
  if (value && lacksSources(transport.prepared())) warn("no light sources found");
  warnOfMissingModifiers(transport.prepared().scene(), options.treeExcluded, "-te", warn);
  warnOfMissingModifiers(transport.prepared().scene(), options.treeIncluded, "-ti", warn);
  const AnswerRecord answerRay = [&, tracers, estimator, ofSets, trees, value, valueAlone, shadows](
                                     const Record& record, unsigned worker, std::string& bytes) {
    const InputRay in =
        inputRay(record.numbers.data(), options.irradiance, transport.prepared().scene().samePlace);
    if (record.bogus) return writer.write(bytes, bogusAnswer(in), record.index);
    PathTracer& tracer = (*tracers)[worker];
    const auto writeBranch = [&](const RayEnd& end, const RayResult& result) {
      writer.writeBranch(bytes, branchAnswer(transport.prepared(), end, result), end.context.depth);
    };
    const RayObserver observer = trees ? RayObserver(writeBranch) : RayObserver();
    const PathRequest request{trees ? &observer : nullptr, shadows};
    const double farthest = options.limitDistance ? in.length : 0;
    const uint64_t seed = seedOfRay(record.numbers, record.index, options);
    if (estimator) {
      const RayEstimator::Estimate estimate =
          estimator->estimate((*ofSets)[worker], in.origin, in.direction, farthest, seed);
      RayAnswer answer = answerOf(transport.prepared().scene(), estimate.ray);
      answer.standardError = estimate.standardError;
      answer.brightnessError = estimate.brightnessError;
      summary.add(record.index, estimate);
      return writer.write(bytes, answer, record.index);
    }
    const TracedRay ray = value ? tracer.trace(in.origin, in.direction, farthest, seed, request)
                                : tracer.cast(in.origin, in.direction, farthest);
    if (!valueAlone) return writer.write(bytes, answerOf(transport.prepared().scene(), ray), record.index);
    RayAnswer answer;
    answer.value = ray.value;
    writer.write(bytes, answer, record.index);
  };
  return withSensors(answerRay, options, transport.prepared(), summary);
}

}  // namespace rsphere
