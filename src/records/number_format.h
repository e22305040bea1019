#pragma once

namespace rsphere {

// The format of numbers in records: text, native floats or doubles, or (for colors only) RGBE pixels.
enum class NumberFormat : char { ascii = 'a', float32 = 'f', float64 = 'd', rgbe = 'c' };

}  // namespace rsphere
