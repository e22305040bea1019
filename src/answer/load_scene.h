#pragma once
#include "answer/answer_options.h"
#include "scene/scene.h"

namespace rsphere {

// Reads the scene given in the options and converts it for tracing. Commands in the scene are run, unless the
// scene is untrusted (-Sc-): then no command is run, and the scene may only name files below the folders
// named on the command line or in RAYPATH. Throws rad::Error like rad::readScene() and buildScene().
Scene loadScene(const AnswerOptions& options, const rad::Warn& warn);

}  // namespace rsphere
