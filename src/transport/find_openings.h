#pragma once
#include "transport/openings.h"
#include "transport/prepared_scene.h"

namespace rsphere {

// Finds panes and holes in walls (holes.h), and traces some paths from both sides of each to see whether
// daylight enters through it. Empty if there are none.
Openings findOpenings(const PreparedScene& prepared);

}  // namespace rsphere
