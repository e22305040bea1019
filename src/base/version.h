#pragma once

namespace rsphere {

// The same as in the top CMakeLists.txt; a test compares them.
inline constexpr const char* kVersion = "1.0.0";

// The version of RADIANCE whose rtrace is matched by ray mode. Options, records, header and messages were
// compared with it.
inline constexpr const char* kRadianceVersion = "6.1a";

}  // namespace rsphere
