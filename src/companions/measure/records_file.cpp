#include "companions/measure/records_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string_view>

#include "answer/batch.h"
#include "rad_parser/error.h"

namespace rsphere {

std::vector<double> readRecords(const std::string& name, const AnswerOptions& options) {
  struct Descriptor {
    int fd;
    ~Descriptor() {
      if (fd > 0) close(fd);
    }
  };
  const Descriptor file{name == "-" ? 0 : open(name.c_str(), O_RDONLY | O_CLOEXEC)};
  if (file.fd < 0)
    throw rad::Error(fmt::format("cannot open \"{}\": {}", name, std::strerror(errno)), rad::Status::system);
  RecordReader reader = readerOf(file.fd, options, name == "-" ? "stdin" : name);
  std::vector<double> numbers;
  constexpr size_t kAtOnce = 4096;
  try {
    while (reader.read(numbers, kAtOnce) > 0) {
    }
  } catch (const rad::Error& error) {
    // The first word is none of the numbers: the file may be the scene.
    if (!numbers.empty() || error.status() != rad::Status::input ||
        !std::string_view(error.what()).ends_with('"'))
      throw;
    throw rad::Error(
        fmt::format("{}; the file of records is the last argument, after the scene", error.what()));
  }
  if (reader.firstRecordIsText())
    throw rad::Error(
        fmt::format("{}: the first record of -f{} consists of printable characters: use -fa to read text",
                    name, static_cast<char>(options.in)));
  if (numbers.empty()) throw rad::Error(fmt::format("{}: no records", name));
  return numbers;
}

}  // namespace rsphere
