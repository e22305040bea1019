#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace rsphere {

struct OptionEntry;

// Throws rtrace's error for a word of the command line, with a reason and a reference to -help.
[[noreturn]] void commandLineError(std::string_view at, std::string_view why);

// Throw commandLineError() for a word that should be a number or a whole number. range: the accepted numbers,
// such as " from 1 to 9", or nothing.
[[noreturn]] void notReal(std::string_view option, std::string_view word, std::string_view range = {});
[[noreturn]] void notInteger(std::string_view option, std::string_view word, std::string_view range = {});

// A number in the range of an option. Throws commandLineError() otherwise.
double realWord(const OptionEntry& entry, const std::string& word);

// The state of a switch with these characters after its name; without characters, the opposite of `before`.
// Empty if they are not one of + 1 y Y t T - 0 n N f F.
std::optional<bool> switched(std::string_view suffix, bool before);

}  // namespace rsphere
