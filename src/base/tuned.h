#pragma once
// Tuning constants: numbers that trade error for time, or that approximate an unknown quantity. Each folder
// that has some declares them in its tuning.h, in one struct for each subsystem, with meaning, unit and
// origin. Physical and geometric constants, limits that RADIANCE documents and tolerances for rounding are no
// tuning constants; they are where they are used.
//
//   struct Group {
//     // ...
//     RSPHERE_TUNED(Group, double, kName, 3);
//   };
//
// declares the constant Group::kName, of the type and value given. Each declaration takes one line, because
// tests/bench/sensitivity finds the constants of the program by this pattern.
//
// With the CMake option RSPHERE_SENSITIVITY, which that benchmark uses for a build of its own, the value is
// instead read when the program starts, from the environment variable RSPHERE_TUNING: "Group.kName=2.1
// Other.kName=7". Names that no constant has are ignored.
//
// RSPHERE_TUNED_ROOM also declares kNameRoom for the bounds of arrays that hold up to kName elements. It
// equals kName, but leaves room for larger values in the build of the benchmark.
#ifndef RSPHERE_SENSITIVITY

#define RSPHERE_TUNED(group, type, name, value) static constexpr type name = value
#define RSPHERE_TUNED_ROOM(group, type, name, value) static constexpr type name = value, name##Room = name

#else

#include <cstdlib>
#include <cstring>

namespace rsphere::tuning {

// The value of a constant (Group.kName) in RSPHERE_TUNING, or the usual value if it is not listed there.
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
