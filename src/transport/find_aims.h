#pragma once
// Finds the places at which directions are aimed (aims.h): for gathers, or for the directions of points.
// Users leave out aims whose light paths from both ends bring (SphereEstimator, IndirectLight).
#include "rays/prepared_scene.h"
#include "transport/aims.h"

namespace rsphere {

// The aims of gathers; none without indirect light (-ab 0, -ad 0). Looks for these kinds of places:
// - openings, except in scenes with importance goals, and their images in flat mirrors;
// - bright spots;
// - highlights.
// Traces some paths to determine where daylight enters.
FoundAims findAimsOfGathers(const PreparedScene& prepared);

// Without indirect light: the aims of the directions of a point, which are openings and the spots of light
// that enters through them. With indirect light: none, because its gathers have aims.
FoundAims findAimsOfPoints(const PreparedScene& prepared);

// Finds panes and holes in walls (openings/holes.h), and traces some paths on both sides of each to determine
// whether daylight enters through it (find_openings.cpp). Empty if there are no openings.
Openings findOpenings(const PreparedScene& prepared);

}  // namespace rsphere
