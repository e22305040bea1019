#pragma once
#include "answer/answer_options.h"
#include "scene/scene.h"

namespace rsphere {

// Reads the scene of the options and converts it for tracing. Runs the commands in it, unless the scene is
// untrusted
// (-Sc-): then no command runs, and only files below the folders that the command line and RAYPATH name are
// read. Throws rad::Error as rad::readScene() and buildScene() do.
Scene loadScene(const AnswerOptions& options, const rad::Warn& warn);

}  // namespace rsphere
