#pragma once
#include <optional>
#include <string_view>

namespace rsphere {

// Throws rtrace's error for a word of the command line, and why, if there is more to say than where.
[[noreturn]] void commandLineError(std::string_view at, std::string_view why = {});

// What a switch is after the characters behind its name: the other way round if there are none. Empty if they
// are not one of + 1 y Y t T - 0 n N f F.
std::optional<bool> switched(std::string_view suffix, bool before);

}  // namespace rsphere
