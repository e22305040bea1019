#include "rad_parser/printable.h"

namespace rad {

std::string printable(std::string_view text, size_t longest) {
  std::string line(text.substr(0, longest));
  for (char& c : line)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
  if (text.size() > longest) line += "...";
  return line;
}

}  // namespace rad
