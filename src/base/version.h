#pragma once

namespace rsphere {

// A test compares it with the top CMakeLists.txt.
inline constexpr const char* kVersion = "1.0.0";

// The version of RADIANCE with whose rtrace options, records, header and messages of ray mode were compared.
inline constexpr const char* kRadianceVersion = "6.1a";

}  // namespace rsphere
