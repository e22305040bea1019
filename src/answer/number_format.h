#pragma once

namespace rsphere {

// How the numbers of records are written: as text, as native floats or doubles, or,
// colors alone, as RGBE pixels.
enum class NumberFormat : char { ascii = 'a', float32 = 'f', float64 = 'd', rgbe = 'c' };

}  // namespace rsphere
