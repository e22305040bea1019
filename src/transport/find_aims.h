#pragma once
// Finds the places that directions are aimed at (aims.h). Only this file decides which estimate uses which
// aims.
#include "transport/aims.h"
#include "transport/prepared_scene.h"

namespace rsphere {

// The aims of gathers of indirect light; none without indirect light (-ab 0, -ad 0). They are openings,
// except in scenes with goals; bright spots, if light is interpolated (-aa above 0) or daylight enters; and
// highlights. Traces some paths to see where daylight enters.
FoundAims findAimsOfGathers(const PreparedScene& prepared);

// The aims of the directions of a point if there are no gathers, because there is no indirect light:
// openings, and spots of the light that enters through them.
FoundAims findAimsOfPoints(const PreparedScene& prepared);

}  // namespace rsphere
