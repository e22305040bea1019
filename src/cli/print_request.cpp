#include "cli/print_request.h"

#include "answer/header.h"
#include "answer/record_writer.h"
#include "cli/option_table.h"

namespace rsphere {

int printRequest(const Options& options, const Messages& messages) {
  RecordWriter writer(1);
  if (options.request == Request::version) writer.write(versionAnswer(options.program) + "\n");
  if (options.request == Request::defaults) writer.write(defaultsText(options));
  if (options.request == Request::help) writer.write(helpText(options));
  if (options.request == Request::features) {
    const FeatureReport report = featureReport(options.features);
    writer.write(report.text);
    if (!report.missing.empty()) {
      writer.flush();
      messages.report("missing feature - " + report.missing);
      return static_cast<int>(rad::Status::input);
    }
  }
  writer.flush();
  return 0;
}

int printRequest(const Companion& companion, Options& options, const Messages& messages) {
  RecordWriter writer(1);
  if (options.request == Request::defaults)
    writer.write(companionDefaults(companion, options));
  else if (options.request == Request::help)
    writer.write(companionHelp(companion, options));
  else
    return printRequest(options, messages);
  writer.flush();
  return 0;
}

}  // namespace rsphere
