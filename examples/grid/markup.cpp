#include "markup.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "rad_parser/error.h"

namespace rsphere {
namespace {

// The number of bytes of the UTF-8 character at the start of `text`; 0 if there is none, or if XML does not
// allow it. Overlong forms, surrogates and numbers above U+10FFFF are not characters (RFC 3629, section 4);
// XML 1.0 excludes U+FFFE and U+FFFF.
size_t characterLength(std::string_view text) {
  const auto byte = [&](size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const auto within = [&](size_t i, unsigned low, unsigned high) {
    return byte(i) >= low && byte(i) <= high;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  if (first >= 0xc2 && first <= 0xdf) return within(1, 0x80, 0xbf) ? 2 : 0;
  if (text.starts_with("\xef\xbf\xbe") || text.starts_with("\xef\xbf\xbf")) return 0;
  if (first >= 0xe0 && first <= 0xef)
    return within(1, first == 0xe0 ? 0xa0 : 0x80, first == 0xed ? 0x9f : 0xbf) && within(2, 0x80, 0xbf) ? 3
                                                                                                        : 0;
  if (first >= 0xf0 && first <= 0xf4)
    return within(1, first == 0xf0 ? 0x90 : 0x80, first == 0xf4 ? 0x8f : 0xbf) && within(2, 0x80, 0xbf) &&
                   within(3, 0x80, 0xbf)
               ? 4
               : 0;
  return 0;
}

bool isControl(char c) {
  return (static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n') || c == 0x7f;
}

// errno as `why`; 0 if the stream has not kept it.
rad::Error cannotWrite(const std::string& name, int why) {
  return rad::Error(
      fmt::format("cannot write \"{}\"{}{}", name, why ? ": " : "", why ? std::strerror(why) : ""),
      rad::Status::system);
}

}  // namespace

std::string escaped(std::string_view text) {
  constexpr std::string_view kReplacement = "\xef\xbf\xbd";
  std::string out;
  for (size_t i = 0; i < text.size();) {
    const size_t length = characterLength(text.substr(i));
    const char c = text[i];
    if (length == 0 || isControl(c))
      out += kReplacement;
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else if (c == '"')
      out += "&quot;";
    else if (c == '\'')
      out += "&#39;";
    else
      out += text.substr(i, length);
    i += std::max<size_t>(1, length);
  }
  return out;
}

void requireWritable(const std::string& name) {
  if (name.empty()) return;
  const std::filesystem::path path(name);
  std::error_code unknown;
  if (std::filesystem::is_directory(path, unknown)) throw cannotWrite(name, EISDIR);
  const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".";
  if (access(folder.c_str(), F_OK) != 0) throw cannotWrite(name, errno);
  if (!std::filesystem::is_directory(folder, unknown)) throw cannotWrite(name, ENOTDIR);
  const bool there = access(name.c_str(), F_OK) == 0;
  if (access(there ? name.c_str() : folder.c_str(), there ? W_OK : W_OK | X_OK) != 0)
    throw cannotWrite(name, errno);
}

void writeTextFile(const std::string& name, std::string_view text) {
  errno = 0;
  std::ofstream file(name, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw cannotWrite(name, errno);
}

void requireSvgName(std::string_view option, const std::string& name, std::string_view what) {
  constexpr std::array<std::string_view, 12> kOthers = {".png", ".jpg", ".jpeg", ".tif", ".tiff", ".gif",
                                                        ".bmp", ".hdr", ".exr",  ".pdf", ".eps",  ".ps"};
  const size_t dot = std::min(name.rfind('.'), name.size());
  std::string ending = name.substr(dot);
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (std::ranges::find(kOthers, ending) != kOthers.end())
    throw rad::Error(fmt::format("{} \"{}\": {} is an SVG file; use the name {}.svg", option, name, what,
                                 name.substr(0, dot)));
}

}  // namespace rsphere
