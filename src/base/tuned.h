#pragma once
// Tuning constants: numbers that trade error for time, or that approximate an unknown quantity. Each folder
// declares its own in its tuning.h, in one struct for each subsystem, with meaning, unit and origin. Physical
// and geometric constants, limits documented by RADIANCE, and tolerances for rounding are not tuning
// constants; they are declared where they are used.
//
//   struct Group {
//     // ...
//     RSPHERE_TUNED(Group, double, kName, 3);
//   };
//
// This declares the constant Group::kName, of the given type and value. Each declaration takes one line,
// because tests/bench/sensitivity searches for this pattern.
//
// With the CMake option RSPHERE_SENSITIVITY, used by a separate build for that benchmark, values are read
// from the environment variable RSPHERE_TUNING when the program starts: "Group.kName=2.1 Other.kName=7".
// Unknown names are ignored.
//
// RSPHERE_TUNED_ROOM also declares kNameRoom, a bound for arrays of up to kName elements. It equals kName,
// but is larger in the build for the benchmark.
#ifndef RSPHERE_SENSITIVITY

#define RSPHERE_TUNED(group, type, name, value) static constexpr type name = value
#define RSPHERE_TUNED_ROOM(group, type, name, value) static constexpr type name = value, name##Room = name

#else

#include <cstdlib>
#include <cstring>

namespace rsphere::tuning {

// The value of a constant (Group.kName) in RSPHERE_TUNING, or `usual` if it is not listed there.
inline double tuned(const char* name, double usual) {
  const char* const all = std::getenv("RSPHERE_TUNING");
  const size_t length = std::strlen(name);
  for (const char* at = all; at && (at = std::strstr(at, name)); at += length)
    if ((at == all || at[-1] == ' ') && at[length] == '=') return std::strtod(at + length + 1, nullptr);
  return usual;
}

}  // namespace rsphere::tuning

#define RSPHERE_TUNED(group, type, name, value) \
  static inline const type name = static_cast<type>(::rsphere::tuning::tuned(#group "." #name, value))
#define RSPHERE_TUNED_ROOM(group, type, name, value) \
  static constexpr type name##Room = 2 * (value);    \
  RSPHERE_TUNED(group, type, name, value)

#endif
