#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "answer/record_writer.h"
#include "rcontrib/output_names.h"

namespace rsphere {

// The files, commands and standard output of a run.
class ContributionOutputs {
 public:
  // Opens them and writes their headers. With -r, files are completed after the last record that all of them
  // have. sceneHeader: as for writeHeader(). Keeps a reference to the options. Throws rad::Error (mostly with
  // Status::system) if a file exists and is neither to be overwritten nor completed, if it cannot be opened,
  // or if it does not fit.
  ContributionOutputs(const ContributionOptions& options, const Tracked& tracked,
                      std::span<const std::string> sceneHeader);
  ~ContributionOutputs();

  // The number of records that the files had already.
  uint64_t recovered() const { return recovered_; }

  // Appends a record: sums of all columns, times factor. Throws as RecordWriter does.
  void write(std::span<const double> sums, double factor);
  void flush();
  void holdUntilFlush(bool hold);

  // Flushes, and waits for commands. Throws rad::Error if one of them failed.
  void close();

 private:
  class Output;

  const ContributionOptions& options_;
  const size_t components_;
  std::vector<std::unique_ptr<Output>> outputs_;
  uint64_t recovered_ = 0;
  size_t pending_ = 0;  // bytes that may wait in the outputs
  bool holds_ = false;
  std::string bytes_;
};

}  // namespace rsphere
