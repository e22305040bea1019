#pragma once

namespace rsphere {

// As in the top CMakeLists.txt; a test compares them.
inline constexpr const char* kVersion = "0.1.0";

}  // namespace rsphere
