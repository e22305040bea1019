#include "cli/print_request.h"

#include "answer/header.h"
#include "records/record_writer.h"

namespace rsphere {

namespace {

int print(const Options& options, std::span<const std::string_view> features, const Messages& messages) {
  RecordWriter writer(1);
  if (options.request == Request::version) writer.write(versionAnswer(options.program) + "\n");
  if (options.request == Request::defaults) writer.write(defaultsText(options));
  if (options.request == Request::help) writer.write(usualHelp(options));
  if (options.request == Request::helpAll) writer.write(helpText(options));
  if (options.request == Request::features) {
    const FeatureReport report = featureReport(options.features, features);
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

}  // namespace

int printRequest(const Options& options, const Messages& messages) { return print(options, {}, messages); }

int printRequest(const Companion& companion, Options& options, const Messages& messages) {
  RecordWriter writer(1);
  if (options.request == Request::defaults)
    writer.write(companionDefaults(companion, options));
  else if (options.request == Request::help || options.request == Request::helpAll)
    writer.write(companionHelp(companion, options));
  else
    return print(options, companion.features, messages);
  writer.flush();
  return 0;
}

}  // namespace rsphere
