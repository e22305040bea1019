#pragma once
#include "cli/options.h"
#include "rad_parser/scene_file.h"

namespace rsphere {

// How the scene is to be read: with its commands, or, where it comes from a stranger (-Sc-), without them, and with
// such files only as lie where the command line and RAYPATH point.
rad::ReadOptions readOptions(const Options& options, rad::Warn warn);

}  // namespace rsphere
