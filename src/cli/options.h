#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "answer/answer_options.h"
#include "answer/messages.h"

namespace rsphere {

// Whether the command line requests answers or a text about the program. help: of the usual options.
enum class Request : uint8_t { answers, version, defaults, help, helpAll, features };

// The command line. It is checked, but neither the scene nor a record has been read.
struct Options : AnswerOptions {
  MessageOptions messages;
  bool irradianceAtHit = false,
       irradianceAtPoint = false;  // -i and -I as given; if both are on, `irradiance` follows -I
  Request request = Request::answers;
  std::vector<std::string> features;  // words after -features
  double photonRadius = 0;            // -am  accepted and printed by -defaults; photon maps are not read
};

}  // namespace rsphere
