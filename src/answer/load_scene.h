#pragma once
#include "answer/answer_options.h"
#include "scene/scene.h"

namespace rsphere {

// Reads the scene that the options name and converts it for tracing. Commands in the scene are run, unless it
// is untrusted (-Sc-): then none is run, and the scene may name only files below the folders that the command
// line and RAYPATH name. Throws rad::Error as rad::readScene() and buildScene() do.
Scene loadScene(const AnswerOptions& options, const rad::Warn& warn);

}  // namespace rsphere
