#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "rcontrib/output_names.h"

namespace rsphere {

// All outputs of a run: files, commands and standard output.
class ContributionOutputs {
 public:
  // Opens the outputs and writes their headers. With -r, files are completed after the last record that all
  // of them contain. sceneHeader: as for writeHeader(). Keeps a reference to the options. Throws rad::Error
  // (mostly with Status::system) if a file exists and may neither be overwritten nor completed, if it cannot
  // be opened, or if its contents do not match this run.
  ContributionOutputs(const ContributionOptions& options, const Tracked& tracked,
                      std::span<const std::string> sceneHeader);
  ~ContributionOutputs();

  // The number of records that the files already contained.
  uint64_t recovered() const { return recovered_; }

  // Appends a record: the values of all columns, and their standard errors if an output has them (-oe).
  // Throws like RecordWriter.
  void write(std::span<const double> values, std::span<const double> errors);
  void flush();
  void holdUntilFlush(bool hold);

  // Flushes all outputs, and waits for commands. Throws rad::Error if a command failed.
  void close();

 private:
  class Output;

  const ContributionOptions& options_;
  const size_t components_;
  std::vector<std::unique_ptr<Output>> outputs_;
  uint64_t recovered_ = 0;
  size_t pending_ = 0;  // bytes collected in the outputs
  bool holds_ = false;
  std::string bytes_;
};

}  // namespace rsphere
