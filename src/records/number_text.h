#pragma once
#include <string>

namespace rsphere {

// The format of numbers in records: text, native floats or doubles, or (for colors only) RGBE pixels.
enum class NumberFormat : char { ascii = 'a', float32 = 'f', float64 = 'd', rgbe = 'c' };

// Appends x, byte for byte as written by printf's "%e" ("-1.500000e+00", "inf", "-nan") in any locale: 7
// decimal digits, with a rounding error of at most half a unit of the last digit. Takes 15 ns for 1e-16 < |x|
// < 1e22, otherwise the time of std::to_chars.
void appendScientific(std::string& text, double x);

}  // namespace rsphere
