#pragma once
#include "rad_parser/scene_file.h"
#include "scene/scene.h"

namespace rsphere {

// Validates and converts the parts of the description that surfaces use. Reads each octree and mesh that it
// names once, with these options. The description is kept for names and places in files. Vertices keep the
// double precision of the files.
// - Warns where RADIANCE does: negative radii, surfaces without area, vertices out of the plane.
// - Leaves out surfaces without area, and distant sources in octrees.
// - goals (-Sg): surfaces whose modifier has one of these names emit importance.
// - Throws rad::Error with the file and line of the primitive for: wrong arguments, a type in use that is not
//   supported yet, mixtures nested too deeply, octrees that contain themselves or are nested deeper than
//   PlacementPath::kDeepest, a goal that is the modifier of no surface, and all errors of rad::readOctree()
//   and rad::readMesh().
Scene buildScene(rad::Description description, const rad::ReadOptions& options = {},
                 std::span<const std::string> goals = {});

}  // namespace rsphere
