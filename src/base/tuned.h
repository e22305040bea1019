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
// The program refuses names of other constants than those in its source files (unknownName()).
//
// "Chosen by experiment" means that the value was the best of some that were tried on furnished rooms, or on
// scenes like those of tests/bench/importance; the results of the others were not kept. "Insensitive" means
// that changing the value by 30% had no effect beyond noise in tests/bench/sensitivity (runs/2026-11-24.txt,
// or 2026-11-22.txt if it was not measured again).
//
// RSPHERE_DERIVED declares a constant whose value is derived or insensitive, by which tests/bench/mechanisms
// switches a mechanism off, and which tests/bench/sensitivity does not vary. Other constants of these kinds
// are plain.
//
// RSPHERE_TUNED_ROOM also declares kNameRoom, a bound for arrays of up to kName elements. It equals kName,
// but is larger in the build for the benchmark.
#include <string>

#ifndef RSPHERE_SENSITIVITY

#define RSPHERE_TUNED(group, type, name, value) static constexpr type name = value
#define RSPHERE_TUNED_ROOM(group, type, name, value) static constexpr type name = value, name##Room = name

namespace rsphere::tuning {
inline std::string unknownName() { return {}; }
}  // namespace rsphere::tuning

#else

#include <cstdlib>
#include <cstring>
#include <set>
#include <sstream>

namespace rsphere::tuning {

// The names of all constants of the program (Group.kName), complete when main() begins.
inline std::set<std::string>& knownNames() {
  static std::set<std::string> names;
  return names;
}

// The value of a constant (Group.kName) in RSPHERE_TUNING, or `usual` if it is not listed there.
inline double tuned(const char* name, double usual) {
  knownNames().insert(name);
  const char* const all = std::getenv("RSPHERE_TUNING");
  const size_t length = std::strlen(name);
  for (const char* at = all; at && (at = std::strstr(at, name)); at += length)
    if ((at == all || at[-1] == ' ') && at[length] == '=') return std::strtod(at + length + 1, nullptr);
  return usual;
}

// The first setting in RSPHERE_TUNING that names no constant of the program; "" if there is none.
inline std::string unknownName() {
  const char* const all = std::getenv("RSPHERE_TUNING");
  std::istringstream settings(all ? all : "");
  for (std::string setting; settings >> setting;)
    if (const size_t end = setting.find('=');
        end == setting.npos || !knownNames().contains(setting.substr(0, end)))
      return setting;
  return {};
}

}  // namespace rsphere::tuning

#define RSPHERE_TUNED(group, type, name, value) \
  static inline const type name = static_cast<type>(::rsphere::tuning::tuned(#group "." #name, value))
#define RSPHERE_TUNED_ROOM(group, type, name, value) \
  static constexpr type name##Room = 2 * (value);    \
  RSPHERE_TUNED(group, type, name, value)

#endif

#define RSPHERE_DERIVED(group, type, name, value) RSPHERE_TUNED(group, type, name, value)
