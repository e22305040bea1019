// Parses command lines, one word on each line. The text behind an empty line is a file,
// which the word "@file" names.
#include <algorithm>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "cli/option_table.h"
#include "memory_file.h"
#include "rad_parser/error.h"

namespace {

const uint8_t* bytes(std::string_view text) { return reinterpret_cast<const uint8_t*>(text.data()); }

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view all(reinterpret_cast<const char*>(data), size);
  const size_t end = std::min(all.find("\n\n"), all.size());
  const std::string_view lines = all.substr(0, end);
  const std::string_view inFile = all.substr(std::min(end + 2, all.size()));
  const MemoryFile file(bytes(inFile), inFile.size());
  std::vector<std::string> words;
  for (size_t at = 0; at <= lines.size();) {
    const size_t next = std::min(lines.find('\n', at), lines.size());
    const std::string_view word = lines.substr(at, next - at);
    words.push_back(word == "@file" ? "@" + file.path() : std::string(word));
    at = next + 1;
  }
  try {
    const rsphere::Options options = rsphere::parseOptions(words);
    static_cast<void>(rsphere::helpText(options));
    static_cast<void>(rsphere::featureReport(options.features));
    static_cast<void>(rsphere::defaultsText(options));
  } catch (const rad::Error&) {
  }
  return 0;
}
