#pragma once
// Finds what directions are aimed at. This is the one place that knows which estimate wants which aims.
#include "transport/aims.h"
#include "transport/prepared_scene.h"

namespace rsphere {

// For the gathers of indirect light: nothing without indirect light (-ab 0, -ad 0). Openings, not in scenes
// with goals; bright spots where light is interpolated (-aa above 0) or daylight enters; highlights. Traces
// some paths to see where daylight enters.
FoundAims findAimsOfGathers(const PreparedScene& prepared);

// What the directions of a point are aimed at where there are no gathers, without indirect light: openings,
// and spots of the light that enters by them.
FoundAims findAimsOfPoints(const PreparedScene& prepared);

}  // namespace rsphere
