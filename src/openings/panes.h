#pragma once
// Recognizes panes of all materials that transmit light, and follows straight lines through them.
#include <optional>

#include "base/function_ref.h"
#include "scene/scene.h"
#include "trace/tracer.h"

namespace rsphere {

class PreparedScene;

// Whether light may pass a surface from behind: true for transparent and diffusely transmitting materials,
// BSDFs and prisms. False for volumes, light sources, surfaces without a material, and BSDFs whose files
// cannot be read.
bool lightPasses(const PreparedScene& prepared, const Surface& surface);

// The last segment of a straight line: from the last pane, or from the line's origin, to the first surface
// that is not a pane (kNone if there is none).
struct LastPart {
  V3d origin{0, 0, 0};
  Hit hit;
};

// Follows a straight line through surfaces without a material, and through those for which `passes` is true.
// direction: unit. Empty if the line crosses more than 1000 of them, which only rounding errors can cause.
std::optional<LastPart> beyondPanes(const Scene& scene, const Tracer& tracer, V3d origin,
                                    const V3d& direction, FunctionRef<bool(const Surface&)> passes);

}  // namespace rsphere
