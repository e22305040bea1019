#include <fmt/format.h>

#include <ctime>
#include <memory>
#include <vector>

#include "cli/answer_writer.h"
#include "cli/batch.h"
#include "cli/header.h"
#include "cli/messages.h"
#include "cli/option_table.h"
#include "cli/print_request.h"
#include "cli/records.h"
#include "cli/stop_signals.h"
#include "importance/distribution.h"
#include "importance/estimator.h"
#include "rad_parser/scene_file.h"
#include "transport/path_tracer.h"

namespace rsphere {
namespace {

// Rays in, what rtrace answers out, with their trees (-ot).
AnswerRecord answerRays(const Transport& transport, const Options& options, const AnswerWriter& writer) {
  auto tracers = std::make_shared<std::vector<PathTracer>>(threadCount(options), PathTracer(transport));
  const bool trees = !options.treeOutputs.empty(), value = trees || needsValue(options.outputs);
  return [&, tracers, trees, value](const Record& record, unsigned worker, std::string& bytes) {
    const InputRay in = inputRay(record.numbers.data(), options.irradiance);
    if (record.bogus) return writer.write(bytes, bogusAnswer(in), record.index);
    PathTracer& tracer = (*tracers)[worker];
    const auto writeBranch = [&](const Ray& ray) {
      writer.writeBranch(bytes, branchAnswer(transport, ray), ray.depth);
    };
    if (trees) tracer.observe(writeBranch, options.treeShadows);
    const double farthest = options.limitDistance ? in.length : 0;
    const Ray ray = value ? tracer.trace(in.origin, in.direction, farthest, seedOf(record.numbers))
                          : tracer.cast(in.origin, in.direction, farthest);
    writer.write(bytes, answerOf(transport.scene(), ray), record.index);
  };
}

// Points in, spherical means out, or every direction of them (-Sd); pictures of them (-Si).
AnswerRecord answerPoints(const SphereEstimator& estimator, const Scene& scene, const Options& options,
                          const AnswerWriter& writer, const rad::Warn& warn) {
  auto workspaces = std::make_shared<std::vector<SphereEstimator::Workspace>>();
  for (unsigned i = 0; i < threadCount(options); ++i) workspaces->emplace_back(estimator);
  return [&, workspaces](const Record& record, unsigned worker, std::string& bytes) {
    SphereEstimator::Workspace& workspace = (*workspaces)[worker];
    const V3d point(record.numbers[0], record.numbers[1], record.numbers[2]);
    const PointAnswer answer = estimator.estimate(point, workspace);
    if (!answer.reached) warn(fmt::format("record {}: -Sa not reached within -Sx", record.index + 1));
    writeDistribution(options.sphere.picture, record.index, workspace.samples);
    if (!options.sphere.everyDirection) return writer.write(bytes, answer);
    for (size_t i = 0; i < workspace.samples.size(); ++i)
      writer.write(bytes, directionAnswer(scene, workspace.samples[i], workspace.rays[i]), record.index);
  };
}

void answer(const Options& options, const Messages& messages, StopSignals& signals) {
  const rad::Warn warn = [&](std::string_view text) { messages.warning(text); };
  const rad::ReadOptions read{options.commands, warn};
  const Scene scene = buildScene(rad::readScene(options.scene, read), read, options.sphere.goals);
  RecordWriter writer(1);
  if (options.sphere.listSpecial) {
    writer.write(specialObjectsText(scene, findSpecialObjects(scene, options.sphere.densityFactor)));
    return writer.flush();
  }
  const Transport transport(scene, options.ray, options.irradiance, options.sphere.basicRadiance, warn);

  RecordReader reader(0, options.in, options.sphere.on ? 3 : 6);
  const AnswerWriter answers(options);
  writeHeader(writer, options, scene.description.header, std::time(nullptr));
  if (options.sphere.on) {
    const SphereEstimator estimator(transport, options.sphere,
                                    options.outputs.find('e') != std::string::npos);
    runRecords(reader, writer, options, messages, &signals,
               answerPoints(estimator, scene, options, answers, warn));
  } else {
    runRecords(reader, writer, options, messages, &signals, answerRays(transport, options, answers));
  }
}

}  // namespace
}  // namespace rsphere

int main(int argc, char** argv) {
  using namespace rsphere;
  const std::string called = argc > 0 ? argv[0] : "rsphere";
  const std::string program = called.substr(called.rfind('/') + 1);
  Messages messages(program);
  try {
    StopSignals signals(program);
    const Options options = parseOptions(argc, argv);
    messages.use(options);
    signals.reportTo(messages.descriptor());
    if (options.request != Request::answers) return printRequest(options, messages);
    answer(options, messages, signals);
    return 0;
  } catch (const rad::Error& error) {
    return messages.error(error);
  } catch (const std::bad_alloc&) {
    return messages.error(rad::Error("out of memory", rad::Status::system));
  }
}
