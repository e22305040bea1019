#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "base/color.h"
#include "records/number_text.h"

namespace rsphere {

// Appends numbers, names and colors to a record in rtrace's formats: as text followed by a TAB, or as native
// floats or doubles. Names are text in all formats.
class RecordText {
 public:
  // `bytes` must exist as long as this object.
  RecordText(std::string& bytes, NumberFormat format) : bytes_(bytes), format_(format) {}

  void number(double x);
  void integer(uint64_t n);    // in text with all digits, because "%e" has only seven
  void vector(const V3d& v);   // three numbers
  void color(const Color& c);  // three numbers, or one pixel if the format is rgbe
  // One number for each band. If the format is rgbe, a pixel: one byte for each band, then the exponent.
  void spectrum(std::span<const double> bands);
  void name(std::string_view n);  // the name and a TAB
  void end();                     // in text: a line end

 private:
  std::string& bytes_;
  NumberFormat format_;
};

}  // namespace rsphere
