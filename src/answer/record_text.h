#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "answer/number_format.h"
#include "base/rgb.h"

namespace rsphere {

// The bytes of one number, name or colour after another, as rtrace writes them: in text each followed by a
// TAB, in binary native floats or doubles; names are text in every format.
class RecordText {
 public:
  // Appends to `bytes`, which must live as long.
  RecordText(std::string& bytes, NumberFormat format) : bytes_(bytes), format_(format) {}

  void number(double x);
  void integer(uint64_t n);   // in text: all its digits, where "%e" has only seven
  void vector(const V3d& v);  // three numbers
  void color(const Rgb& c);   // three numbers, or one RGBE pixel where the format is rgbe
  // The value of each band's channel (0 red, 1 green, 2 blue), or one pixel with a byte for each band and the
  // exponent, made as RGBE ones are.
  void spectrum(const Rgb& c, std::span<const int> channels);
  void name(std::string_view n);  // the name and a TAB
  void end();                     // in text: a line end

 private:
  std::string& bytes_;
  NumberFormat format_;
};

}  // namespace rsphere
