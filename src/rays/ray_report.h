#pragma once
// Computes the quantities of a ray that rtrace's output letters report.
#include <string_view>

#include "rays/path_observer.h"
#include "rays/prepared_scene.h"
#include "rays/ray_answer.h"

namespace rsphere {

RayAnswer answerOf(const Scene& scene, const TracedRay& ray);

// The answer for a ray that was passed to an observer (RayObserver): answerOf() with the ray's weight and
// contribution. The contribution is 0 for a shadow ray that receives no light from its source.
RayAnswer branchAnswer(const PreparedScene& prepared, const RayEnd& end, const RayResult& result);

// Whether the letters require a ray's radiance, or only its hit.
bool needsValue(std::string_view letters);

}  // namespace rsphere
