#include "cli/print_request.h"

#include "answer/header.h"
#include "records/record_writer.h"

namespace rsphere {

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
      report =
          companion ? featureReport(options.features, companion->features) : featureReport(options.features);
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
