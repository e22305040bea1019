#include "rsphere/error.h"

#include <charconv>
#include <cstring>

#include "base/version.h"

namespace rsphere::v1 {

const char* version() { return kVersion; }

Error::Error(const std::string& text, Cause cause) : std::runtime_error(text), cause_(cause) {
  // The place is "FILE:LINE: ". A name of a file may itself contain colons.
  for (size_t colon = text.find(':'); colon != std::string::npos; colon = text.find(':', colon + 1)) {
    int line = 0;
    const char* const end = text.data() + text.size();
    const auto [after, fault] = std::from_chars(text.data() + colon + 1, end, line);
    if (colon == 0 || fault != std::errc() || line < 1 || after == end || *after != ':') continue;
    file_ = text.substr(0, colon);
    line_ = line;
    return;
  }
}

Error::~Error() = default;

}  // namespace rsphere::v1
