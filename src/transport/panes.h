#pragma once
// Panes of all materials that let light through, and straight lines through them.
#include <optional>

#include "scene/scene.h"
#include "trace/tracer.h"
#include "transport/function_ref.h"

namespace rsphere {

class PreparedScene;

// Whether light from behind may come through a surface: of a transparent or diffusing material, a BSDF or a
// prism. False for volumes, light sources, surfaces without a material, and BSDFs whose files cannot be read.
bool lightPasses(const PreparedScene& prepared, const Surface& surface);

// The last part of a straight line: from the last pane, or from its origin, to what it hits (surface kNone:
// nothing).
struct LastPart {
  V3d origin{0, 0, 0};
  Hit hit;
};

// Follows a straight line through surfaces without a material and through those that `passes` accepts.
// direction: unit. Empty if it meets more than 1000 of them, which only rounding can cause.
std::optional<LastPart> beyondPanes(const Scene& scene, const Tracer& tracer, V3d origin,
                                    const V3d& direction, FunctionRef<bool(const Surface&)> passes);

}  // namespace rsphere
