// Reads data and font files and evaluates them.
#include <cmath>
#include <string>

#include "rad_parser/error.h"
#include "rad_parser/tables/data_file.h"
#include "rad_parser/tables/font_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const rad::DataFile file = rad::DataFile::parse(text, "fuzz.dat");
    std::vector<double> point(file.dimensions());
    for (double first : {-1e300, -3., 0., .7, 5., 1e30}) {
      for (size_t i = 0; i < point.size(); ++i) point[i] = first + static_cast<double>(i);
      static_cast<void>(file.value(point));
    }
  } catch (const rad::Error&) {
  }
  try {
    const rad::FontFile font = rad::FontFile::parse(text, "fuzz.fnt");
    const std::string lines[] = {"AB  C\1\2\3", std::string(text.substr(0, 40))};
    for (double spacing : {-.3, 0., .4, 1e9}) {
      const rad::TextLayout layout(font, lines, spacing);
      for (double x = 0; x < 12; x += .37) static_cast<void>(layout.covers(x, x / 6));
    }
  } catch (const rad::Error&) {
  }
  return 0;
}
