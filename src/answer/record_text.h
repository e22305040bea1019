#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "answer/number_format.h"
#include "base/color.h"

namespace rsphere {

// Appends numbers, names and colours to a record as rtrace writes them: as text followed by a TAB, or as
// native floats or doubles. Names are text in every format.
class RecordText {
 public:
  // `bytes` must live as long.
  RecordText(std::string& bytes, NumberFormat format) : bytes_(bytes), format_(format) {}

  void number(double x);
  void integer(uint64_t n);    // in text: all its digits, where "%e" has only seven
  void vector(const V3d& v);   // three numbers
  void color(const Color& c);  // three numbers, or one RGBE pixel where the format is rgbe
  // A number for each band. Where the format is rgbe, one pixel: a byte for each band, and the exponent.
  void spectrum(std::span<const double> bands);
  void name(std::string_view n);  // the name and a TAB
  void end();                     // in text: a line end

 private:
  std::string& bytes_;
  NumberFormat format_;
};

}  // namespace rsphere
