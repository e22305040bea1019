#pragma once
// The rays of sites of the irradiance cache and of patches of the coarse solution.
#include "field/hemisphere.h"
#include "transport/path_state.h"
#include "transport/prepared_scene.h"
#include "transport/ray_follower.h"

namespace rsphere {

// The indirect light of a site, estimated with -ad + -as rays. state: of a path that has just begun. nearest: of
// HemisphereCells::sum(). depth: of the ray that requests it; only the limit of nesting depends on it.
GatheredLight gatherLight(const PreparedScene& prepared, PathState& state, const PathSettings& settings,
                          RayFollower& follower, const GatherSite& site, double nearest, int depth);

// Sends about `rays` rays from a patch of the coarse solution. Adds the light that they find, and links to
// the patches that they find, to state.links.
void linkPatch(const PreparedScene& prepared, PathState& state, const PathSettings& settings,
               RayFollower& follower, const GatherSite& site, int rays, int depth);

}  // namespace rsphere
