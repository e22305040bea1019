#pragma once
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "cli/options.h"

namespace rsphere {

// The section of an option in -help and in the manual. Those of companion programs have no sections.
enum class Group : uint8_t {
  records,
  sphere,
  direct,
  specular,
  indirect,
  limits,
  medium,
  color,
  trees,
  program,
  companion
};
constexpr std::pair<Group, std::string_view> kGroups[] = {
    {Group::records, "Records"},         {Group::sphere, "Sphere mode"},
    {Group::direct, "Direct light"},     {Group::specular, "Highlights"},
    {Group::indirect, "Indirect light"}, {Group::limits, "Limits of a path"},
    {Group::medium, "Medium"},           {Group::color, "Colors"},
    {Group::trees, "Ray trees"},         {Group::program, "Program"}};

// How an option is supported: fully; accepted without effect; or refused with a reason.
enum class Support : uint8_t { full, unused, refused };

// The mode in which an option has an effect.
enum class Mode : uint8_t { both, points, rays };

// The range of numbers that an option accepts, including both ends. Others are errors of the command line.
struct Range {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
};

struct OptionEntry;

// Access to the value of an option. The type determines how its words are read and how -defaults prints it.
using SwitchValue = bool& (*)(Options&);
using IntegerValue = int& (*)(Options&);
using CountValue = int64_t& (*)(Options&);
using RealValue = double& (*)(Options&);
using ColorValue = Color& (*)(Options&);
using WordValue = std::string& (*)(Options&);
using WordsValue = std::vector<std::string>& (*)(Options&);  // each use appends a word
// For options of other types. `words` are the words after the name; `rest` is the part of the first word that
// follows the name.
struct Custom {
  void (*set)(Options& options, const OptionEntry& entry, std::span<const std::string> words,
              std::string_view rest);
};
using OptionValue = std::variant<std::monostate, SwitchValue, IntegerValue, CountValue, RealValue, ColorValue,
                                 WordValue, WordsValue, Custom>;

// The member of Options, or of a struct derived from it, as the value of an option.
template <class Owner, class Member>
Owner structOf(Member Owner::*);
template <auto kMember>
auto& of(Options& o) {
  return static_cast<decltype(structOf(kMember))&>(o).*kMember;
}

// What every option has.
struct OptionForm {
  std::string_view name{};       // "-ab"
  std::string_view arguments{};  // names of the words after it: "N", "red grn blu"; or nothing
  std::string_view remark{};     // one line for -defaults; for switches "on|off"
  Group group = Group::program;
  OptionValue value{};
  Range range{};            // of each of its numbers
  std::string_view unit{};  // unit of the numbers, if any
};

// What few options have.
struct OptionExtras {
  std::string_view help{};  // used instead of the remark in -help, where rtrace's remark is unclear
  // The only mode in which the option works, and a remark for the message that refuses it in the other mode.
  // A switch that is off is accepted in both.
  Mode mode = Mode::both;
  std::string_view elsewhere{};
  Support support = Support::full;
  std::string_view reason{};  // why it is refused
  bool glued = false;         // its value follows without a blank: -fio -ospec
  bool alsoGlued = false;     // its value may follow without a blank: -te mod, -temod
  // Whether a switch is in effect, as -help and the manual say, if that is not its value: like rtrace,
  // -defaults prints the value.
  bool (*inEffect)(const Options&) = nullptr;
  // The line of -defaults without its remark, if it does not follow from the type; "" for no line.
  std::string (*line)(const Options&) = nullptr;
};
constexpr OptionExtras pointsOnly(std::string_view elsewhere = {}) {
  return {.mode = Mode::points, .elsewhere = elsewhere};
}

// One option. The parser, -defaults, -help and the manual are generated from these entries, together with
// the paragraphs of the manual in man/*.options.
struct OptionEntry : OptionForm, OptionExtras {
  constexpr OptionEntry(const OptionForm& form, const OptionExtras& extras = {})
      : OptionForm(form), OptionExtras(extras) {}
};

// All options in the order of -defaults: those of rtrace in rtrace's order, then those of rsphere.
std::span<const OptionEntry> optionTable();

// Whether the option has an effect in the mode.
inline bool worksIn(const OptionEntry& entry, bool sphereMode) {
  return entry.mode == Mode::both || (entry.mode == Mode::points) == sphereMode;
}

// The number of words that follow the option.
int arity(const OptionEntry& entry);

// The values before the first option: in ray mode rtrace's defaults; in sphere mode defaults for means of
// thousands of directions.
Options modeDefaults(bool sphereMode);

// Sets the defaults of rays whose standard errors are computed: nothing is left out but bounces beyond -ab.
// reachAccuracy: these are not left out, either (-Sa).
void setErrorDefaults(RayOptions& ray, bool reachAccuracy);

// The defaults for the rays of pictures (-Si).
RayOptions pictureDefaults();

// Reads a command line; words[0] is the name of the program.
// - "@file" and "$VARIABLE", if they occur instead of an option or a word of the scene, are replaced by the
//   words that they contain, at most 4096.
// - Sphere mode is on unless the program is called rtrace; -S overrides this. The defaults of the mode are
//   set first, then the options in order. A switch without state toggles; + 1 y Y t T switch on, - 0 n N f F
//   off. Switches that begin with -S take no letters, so that -SN 8 is not a switch before a scene called 8.
// - An option that only works in the other mode is an error.
// - The scene begins at the first word that is not an option, and consists of all remaining words.
// - The command line ends at -version (or --version), -defaults or -help (or --help), which "all" may follow.
//   -features is an option only as the first word.
// Opens only the files of @file, -aE, -aI, -tE and -tI.
// Throws rad::Error with rtrace's texts, such as "command line error at '-ab'", "cannot expand '@x': No such
// file or directory" (Status::system) or "missing octree argument"; and with "option '-ap' is not supported:
// ..." for an option of rtrace that rsphere does not have.
Options parseOptions(std::span<const std::string> words);

// A companion program, which accepts options of rsphere and others. Values of the latter are members of a
// struct derived from Options; an object of that struct must be passed to parseCompanion().
struct Companion {
  std::span<const OptionEntry> own{};
  std::string_view usage{};  // its command line after the name
  bool sphereMode = true;    // the mode without -S
  // Changes the defaults of the mode. Null: keeps them.
  void (*defaults)(Options&) = nullptr;
  // Whether it accepts an option of rsphere. Null: all are accepted.
  bool (*takes)(const OptionEntry&) = nullptr;
  // Features that -features lists in addition to those common to all programs; empty: those of rtrace.
  std::span<const std::string_view> features{};
};

// An option on a command line.
struct UsedOption {
  const OptionEntry* entry;
  std::string rest;                // after the name, in the same word
  std::vector<std::string> words;  // its values; a value in the same word is among them
};

// parseOptions() for a companion. Sets all of Options, and the values of those options of the companion that
// are given. Returns the given options in order.
std::vector<UsedOption> parseCompanion(std::span<const std::string> words, const Companion& companion,
                                       Options& options);

// The texts of -help and -defaults of a companion.
std::string companionHelp(const Companion& companion, Options& options);
std::string companionDefaults(const Companion& companion, Options& options);

// The text of -defaults: each option with its current value, in option syntax. Without the remarks, which
// begin with '#', it can be read by @file. takes: Companion::takes.
std::string defaultsText(const Options& options, bool (*takes)(const OptionEntry&) = nullptr);

// The text of "-help all": one line for each option. And that of -help: a line for each of the twelve options
// of the mode that most people need.
std::string helpText(const Options& options);
std::string usualHelp(const Options& options);

// The answer to -features. text: what it prints. missing: the first feature among the words after it that
// this program lacks. features: Companion::features.
struct FeatureReport {
  std::string text, missing;
};
FeatureReport featureReport(std::span<const std::string> wanted,
                            std::span<const std::string_view> features = {});

// The value of an option in its shortest form; empty if it has none.
std::string shortValue(const OptionEntry& entry, Options& options);

}  // namespace rsphere
