#pragma once
#include <string>

namespace rsphere {

// Appends x as printf's "%e" writes it, byte for byte ("-1.500000e+00", "inf", "-nan"), in every locale.
// 7 decimal digits: half a unit of the last is the rounding. 15 ns where 1e-16 < |x| < 1e22, else that of
// std::to_chars.
void appendScientific(std::string& text, double x);

}  // namespace rsphere
