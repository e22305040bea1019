#include "rcontrib/contribution_outputs.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <ctime>
#include <functional>

#include "answer/header.h"
#include "rad_parser/open_file.h"
#include "rcontrib/recovered_header.h"
#include "records/record_text.h"

namespace rsphere {
namespace {

// Number of bytes that are collected in all outputs together before they are written: a run may have
// thousands of pictures.
constexpr size_t kMostPending = size_t{16} << 20;

[[noreturn]] void systemError(const std::string& name, std::string_view what) {
  throw rad::systemError(fmt::format("{}: {}", rad::printableName(name), what));
}

// Each output of a run takes a file descriptor.
void allowDescriptors(size_t outputs) {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0 || outputs + 64 <= limit.rlim_cur) return;
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, outputs + 64);
  setrlimit(RLIMIT_NOFILE, &limit);
}

// The header lines that describe the records of an output.
RecordLayout layoutOf(const ContributionOptions& options, const OutputPlan& plan, int components) {
  RecordLayout layout{components};
  const bool named = !plan.name.empty();
  if (named && !plan.modifier.empty()) layout.lines += fmt::format("MODIFIER={}\n", plan.modifier);
  if (named && !plan.bin.empty()) layout.lines += fmt::format("BIN={}\n", plan.bin);
  if (plan.errors) layout.lines += "STANDARD_ERRORS=yes\n";
  if (options.countsRecords() && options.height > 0)
    layout.lines += fmt::format("NROWS={}\n", options.height * std::max<int64_t>(options.width, 1));
  // As in RADIANCE, only an output with one value per pixel has a resolution. rmtxop and dctimestep read the
  // records of any other output as a matrix, directly after the header. With -x, one value is one pixel.
  const bool pixels = options.countsRecords() && options.width > 0 && plan.columnCount() == 1;
  layout.resolution = pixels && options.hasResolution();
  if (!pixels) layout.lines += fmt::format("NCOLS={}\n", plan.columnCount());
  return layout;
}

size_t recordBytes(const ContributionOptions& options, const OutputPlan& plan, size_t components) {
  const size_t columns = plan.columnCount();
  switch (options.out) {
    case NumberFormat::float32: return columns * components * sizeof(float);
    case NumberFormat::float64: return columns * components * sizeof(double);
    default: return columns * (components + 1);
  }
}

}  // namespace

class ContributionOutputs::Output {
 public:
  explicit Output(const OutputPlan& planned) : plan(planned) {}
  ~Output() {
    if (pipe_) pclose(pipe_);
    if (!pipe_ && descriptor_ > 2) ::close(descriptor_);
  }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  // Opens an output that is written from the start.
  void open(const ContributionOptions& options) {
    if (plan.name.empty()) {
      descriptor_ = 1;
    } else if (plan.name[0] == '!') {
      pipe_ = popen(plan.name.c_str() + 1, "we");
      if (!pipe_) systemError(plan.name, "cannot run");
      descriptor_ = fileno(pipe_);
    } else {
      openFile(options);
    }
    writer = std::make_unique<RecordWriter>(descriptor_, plan.name);
  }

  // Opens a file with records, to complete it. Returns their number; empty if the file does not exist or has
  // no bytes.
  std::optional<uint64_t> openToComplete(const ContributionOptions& options, int components) {
    descriptor_ = ::open(plan.name.c_str(), O_RDWR | O_CLOEXEC);
    if (descriptor_ < 0 && errno == ENOENT) return std::nullopt;
    if (descriptor_ < 0) systemError(plan.name, "cannot open");
    struct stat state {};
    fstat(descriptor_, &state);
    if (state.st_size == 0) {
      ::close(std::exchange(descriptor_, -1));
      return std::nullopt;
    }
    const rad::OpenFile file(plan.name);
    begin_ =
        recordsBeginIn(plan.name, file.contents(plan.name), options, layoutOf(options, plan, components));
    record_ = recordBytes(options, plan, static_cast<size_t>(components));
    writer = std::make_unique<RecordWriter>(descriptor_, plan.name);
    return (static_cast<size_t>(state.st_size) - begin_) / record_;
  }

  // Continues after this number of records.
  void completeAfter(uint64_t records) {
    const auto end = static_cast<off_t>(begin_ + records * record_);
    if (ftruncate(descriptor_, end) != 0 || lseek(descriptor_, end, SEEK_SET) < 0)
      systemError(plan.name, "cannot be completed");
  }

  void write(std::string_view bytes) {
    orSayWhyNot([&] { writer->write(bytes); });
  }
  void flush() {
    orSayWhyNot([&] { writer->flush(); });
  }

  void close() {
    flush();
    if (pipe_) waitForCommand();
  }

  const OutputPlan plan;
  std::unique_ptr<RecordWriter> writer;

 private:
  // A command that stops reading has usually failed; its status is a better message than a broken pipe.
  void orSayWhyNot(const std::function<void()>& writing) {
    try {
      writing();
    } catch (const ClosedPipe&) {
      if (!pipe_) throw;
      waitForCommand();
      throw rad::Error(
          fmt::format("the command '{}' did not read all records", rad::printableName(plan.name.substr(1))),
          rad::Status::signal);
    }
  }

  void waitForCommand() {
    const int status = pclose(std::exchange(pipe_, nullptr));
    if (status != 0)
      throw rad::Error(fmt::format("the command '{}' ended with {}", rad::printableName(plan.name.substr(1)),
                                   WIFEXITED(status) ? fmt::format("status {}", WEXITSTATUS(status))
                                                     : fmt::format("signal {}", WTERMSIG(status))),
                       rad::Status::system);
  }

  void openFile(const ContributionOptions& options) {
    struct stat state {};
    const bool exists = stat(plan.name.c_str(), &state) == 0;
    if (exists && S_ISREG(state.st_mode) && state.st_size > 0 && !options.overwrites)
      throw rad::Error(fmt::format("output file '{}' already exists: -fo overwrites it, -r completes it",
                                   rad::printableName(plan.name)),
                       rad::Status::system);
    descriptor_ = ::open(plan.name.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor_ < 0) systemError(plan.name, "cannot open for output");
  }

  int descriptor_ = -1;
  FILE* pipe_ = nullptr;
  size_t begin_ = 0, record_ = 0;  // of a file that is being completed
};

ContributionOutputs::~ContributionOutputs() = default;

ContributionOutputs::ContributionOutputs(const ContributionOptions& options, const Tracked& tracked,
                                         std::span<const std::string> sceneHeader)
    : options_(options), components_(static_cast<size_t>(tracked.components())) {
  for (const OutputPlan& plan : planOutputs(options, tracked))
    outputs_.push_back(std::make_unique<Output>(plan));
  allowDescriptors(outputs_.size());
  const std::time_t now = std::time(nullptr);
  std::vector<Output*> completed;
  for (const auto& output : outputs_) {
    if (options.recovers && output->plan.name.empty())
      throw rad::Error("-r: cannot recover from the standard output; -o names files");
    const bool mayHaveRecords = options.recovers && output->plan.name[0] != '!';
    if (const auto records =
            mayHaveRecords ? output->openToComplete(options, tracked.components()) : std::nullopt) {
      recovered_ = completed.empty() ? *records : std::min(recovered_, *records);
      completed.push_back(output.get());
      continue;
    }
    output->open(options);
    writeHeader(*output->writer, options, sceneHeader, now,
                layoutOf(options, output->plan, tracked.components()));
    output->flush();  // a communicating program may read the header before it sends a ray
  }
  if (completed.size() < outputs_.size()) recovered_ = 0;
  for (Output* output : completed) output->completeAfter(recovered_);
}

void ContributionOutputs::write(std::span<const double> values, std::span<const double> errors) {
  for (const auto& output : outputs_) {
    bytes_.clear();
    RecordText text(bytes_, options_.out);
    for (const ColumnRange& range : output->plan.columns)
      for (uint32_t i = 0; i < range.count; ++i) {
        const auto from = (output->plan.errors ? errors : values).subspan((range.first + i) * components_);
        if (components_ == 3)
          text.color(Color(from[0], from[1], from[2]));
        else
          text.spectrum(from.first(components_));
      }
    text.end();
    output->write(bytes_);
    pending_ += bytes_.size();
  }
  if (pending_ > kMostPending && !holds_) flush();
}

void ContributionOutputs::flush() {
  for (const auto& output : outputs_) output->flush();
  pending_ = 0;
}

void ContributionOutputs::holdUntilFlush(bool hold) {
  holds_ = hold;
  for (const auto& output : outputs_) output->writer->holdUntilFlush(hold);
}

void ContributionOutputs::close() {
  for (const auto& output : outputs_) output->close();
}

}  // namespace rsphere
