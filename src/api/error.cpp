#include "rsphere/error.h"

#include <charconv>

#include "base/version.h"

namespace rsphere::v1 {

const char* version() { return kVersion; }

namespace {

// The file in a message "FILE: cannot open scene file: ..." or "FILE (from OTHER:12): cannot open ...", which
// contains no line; empty for any other message.
std::string fileNotOpened(const std::string& text) {
  const size_t end = text.find(": cannot open ");
  if (end == std::string::npos) return "";
  const std::string place = text.substr(0, end), file = place.substr(0, place.find(" (from "));
  return file.find(": ") == std::string::npos ? file : "";
}

}  // namespace

Error::Error(const std::string& text, Cause cause) : std::runtime_error(text), cause_(cause) {
  // The place is "FILE:LINE: ". The name of the file may contain colons.
  for (size_t colon = text.find(':'); colon != std::string::npos; colon = text.find(':', colon + 1)) {
    int line = 0;
    const char* const end = text.data() + text.size();
    const auto [after, fault] = std::from_chars(text.data() + colon + 1, end, line);
    if (colon == 0 || fault != std::errc() || line < 1 || after == end || *after != ':') continue;
    file_ = text.substr(0, colon);
    line_ = line;
    return;
  }
  file_ = fileNotOpened(text);
}

Error::~Error() = default;

}  // namespace rsphere::v1
