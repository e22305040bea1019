#pragma once
// What the tests of highlights on balls and cylinders have in common: materials, a source and a floor.
#include <string>

namespace rsphere {
namespace highlight_scene {

inline const std::string kMaterials =
    "void metal chrome 0 0 5 .9 .9 .9 1 .05\nvoid metal mirroring 0 0 5 .9 .9 .9 1 0\n"
    "void plastic matt 0 0 5 .5 .5 .5 0 0\nvoid plastic glossy 0 0 5 .5 .5 .5 .05 .05\n"
    "void light lamp 0 0 3 100 100 100\n";
inline const std::string kBulb = "lamp sphere bulb 0 0 4 3 2.5 2.5 .05\n";
inline const std::string kFloor = "matt polygon floor 0 0 12 0 0 0 4 0 0 4 4 0 0 4 0\n";

}  // namespace highlight_scene
}  // namespace rsphere
