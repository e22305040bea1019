#pragma once

namespace rsphere {

// A test compares it with the top CMakeLists.txt.
inline constexpr const char* kVersion = "1.0.0";

// The version of RADIANCE that ray mode matches. Options, records, header and messages were compared with its
// rtrace.
inline constexpr const char* kRadianceVersion = "6.1a";

}  // namespace rsphere
