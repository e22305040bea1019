#pragma once
#include <string>

namespace rsphere {

// A room of 4 x 4 x 3 m of the material "gray", with a hole of 2 x 1 m in its south wall.
inline const std::string kRoomWithHole = R"(
gray polygon floor 0 0 12 0 0 0 4 0 0 4 4 0 0 4 0
gray polygon west 0 0 12 0 0 0 0 4 0 0 4 3 0 0 3
gray polygon east 0 0 12 4 0 0 4 0 3 4 4 3 4 4 0
gray polygon north 0 0 12 0 4 0 4 4 0 4 4 3 0 4 3
gray polygon roof 0 0 12 0 0 3 4 0 3 4 4 3 0 4 3
gray polygon south 0 0 30 0 0 0 4 0 0 4 0 3 0 0 3 0 0 0 1 0 1 1 0 2 3 0 2 3 0 1 1 0 1
)";

}  // namespace rsphere
