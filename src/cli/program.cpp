#include "cli/program.h"

#include <new>

#include "answer/header.h"
#include "records/record_writer.h"

namespace rsphere {

int exitStatus(const Messages& messages, const std::function<int()>& program) {
  try {
    return program();
  } catch (const rad::Error& error) {
    return messages.error(error);
  } catch (const std::bad_alloc&) {
    return messages.error(rad::Error("out of memory", rad::Status::system));
  }
}

int printRequest(Options& options, const Messages& messages, const Companion* companion) {
  RecordWriter writer(1);
  FeatureReport report;
  switch (options.request) {
    case Request::version: writer.write(versionAnswer(options.program) + "\n"); break;
    case Request::defaults:
      writer.write(companion ? companionDefaults(*companion, options) : defaultsText(options));
      break;
    case Request::help:
    case Request::helpAll:
      writer.write(companion                          ? companionHelp(*companion, options)
                   : options.request == Request::help ? usualHelp(options)
                                                      : helpText(options));
      break;
    case Request::features:
      report = featureReport(options.features, (companion ? *companion : Companion{}).features);
      writer.write(report.text);
      break;
    case Request::answers: break;
  }
  writer.flush();
  if (report.missing.empty()) return 0;
  messages.report("missing feature - " + report.missing);
  return static_cast<int>(rad::Status::input);
}

}  // namespace rsphere
