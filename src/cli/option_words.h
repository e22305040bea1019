#pragma once
#include <optional>
#include <string_view>

namespace rsphere {

// Throws rtrace's error for a word of the command line, and says why, and that -help tells more.
[[noreturn]] void commandLineError(std::string_view at, std::string_view why);

// The same for a word behind an option that is not the number, or the whole number, that it takes. range:
// which numbers it takes, as " from 1 to 9", or nothing.
[[noreturn]] void notReal(std::string_view option, std::string_view word, std::string_view range = {});
[[noreturn]] void notInteger(std::string_view option, std::string_view word, std::string_view range = {});

// What a switch is after the characters behind its name: the other way round if there are none. Empty if they
// are not one of + 1 y Y t T - 0 n N f F.
std::optional<bool> switched(std::string_view suffix, bool before);

}  // namespace rsphere
