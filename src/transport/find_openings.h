#pragma once
#include "openings/openings.h"
#include "rays/prepared_scene.h"

namespace rsphere {

// Finds panes and holes in walls (holes.h), and traces some paths on both sides of each to determine whether
// daylight enters through it. Empty if there are no openings.
Openings findOpenings(const PreparedScene& prepared);

}  // namespace rsphere
