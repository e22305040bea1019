#include <unistd.h>

#include <ctime>
#include <exception>

#include "answer/answer_glare.h"
#include "answer/answer_points.h"
#include "answer/answer_rays.h"
#include "answer/answer_writer.h"
#include "answer/batch.h"
#include "answer/header.h"
#include "answer/load_scene.h"
#include "answer/messages.h"
#include "answer/progress.h"
#include "base/tuned.h"
#include "cli/option_table.h"
#include "cli/program.h"
#include "process/memory_limit.h"
#include "process/stop_signals.h"
#include "rcontrib/contribution_run.h"
#include "records/record_reader.h"
#include "records/record_writer.h"
#include "silhouettes/special_objects.h"

namespace rsphere {
namespace {

// An object that exists until the process ends. The system frees its memory faster than destructors would.
template <typename T>
const T& lasting(const T* object) {
  static const T* const kept = object;  // a leak checker finds the object here
  return *kept;
}

// The progress of pictures is reported if -t is given, or if messages go to a terminal; otherwise not,
// because a program may read the messages.
PictureProgress::Report pictureReport(const Options& options, const Messages& messages) {
  if (options.progressSeconds <= 0 && isatty(messages.descriptor()) == 0) return {};
  return [&messages](std::string_view text) { messages.report(text); };
}

void answer(const Options& given, const Messages& messages, StopSignals& signals) {
  const rad::Warn warn = [&](std::string_view text) { messages.warning(text); };
  const Scene& scene = lasting(new Scene(loadScene(given, warn)));
  Options options = given;
  options.contributors = scene.contributors;
  options.progressSeconds = reportSeconds(
      given.progressSeconds, given.progressGiven,
      {.input = isatty(0) != 0, .output = isatty(1) != 0, .messages = isatty(messages.descriptor()) != 0});
  RecordWriter writer(1);
  if (options.listSpecial) {
    writer.write(specialObjectsText(scene, findSpecialObjects(scene, options.sphere.densityFactor)));
    return writer.flush();
  }
  const Transport& transport =
      lasting(new Transport(scene, options.ray, options.irradiance, options.sphere.basicRadiance, warn));

  RecordReader reader = readerOf(0, options);
  const AnswerWriter answers(options);
  writeHeader(writer, options, scene.description.header, std::time(nullptr));
  writer.flush();  // a communicating program may read the header before it sends a record
  requirePictureNames(options, reader);
  RunSummary summary;
  RunEnd end;
  end.leave = [&](const std::exception_ptr& fault) {
    _exit(exitStatus(messages, [&]() -> int { std::rethrow_exception(fault); }));
  };
  end.ended = [&] { summary.tell(messages, options, transport.prepared()); };
  runRecords(reader, writer, options, messages, &signals,
             !options.sphereMode ? answerRays(transport, options, answers, warn, summary)
             : options.sphere.glare.wanted
                 ? answerGlare(transport, options, answers, warn, summary)
                 : answerPoints(transport, options, answers, warn, summary, pictureReport(options, messages)),
             end);
}

}  // namespace
}  // namespace rsphere

int main(int argc, char** argv) {
  using namespace rsphere;
  const std::vector<std::string> words(argv, argv + argc);
  const std::string called = words.empty() ? "rsphere" : words[0];
  const std::string program = called.substr(called.rfind('/') + 1);
  const Companion* const companion = program == "rcontrib" ? &contributionCompanion() : nullptr;
  Messages messages(program);
  return exitStatus(messages, [&] {
    limitMemory();
    if (const std::string unknown = tuning::unknownName(); !unknown.empty())
      throw rad::Error("RSPHERE_TUNING: no tuning constant \"" + unknown + "\"");
    StopSignals signals(program);
    ContributionOptions options;
    if (companion)
      parseCompanion(words, *companion, options);
    else
      static_cast<Options&>(options) = parseOptions(words);
    messages.use(options.messages, commandLine(options, true));
    signals.reportTo(messages.descriptor());
    if (options.request != Request::answers) return printRequest(options, messages, companion);
    if (companion) {
      finish(options);
      runContributions(options, messages, signals);
    } else {
      answer(options, messages, signals);
    }
    return 0;
  });
}
