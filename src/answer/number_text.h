#pragma once
#include <string>

namespace rsphere {

// Appends x byte for byte as printf's "%e" writes it ("-1.500000e+00", "inf", "-nan"), in every locale: 7
// decimal digits, with a rounding error of at most half a unit of the last. Takes 15 ns where 1e-16 < |x| <
// 1e22, elsewhere the time of std::to_chars.
void appendScientific(std::string& text, double x);

}  // namespace rsphere
