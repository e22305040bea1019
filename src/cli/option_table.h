#pragma once
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "cli/options.h"

namespace rsphere {

// Where an option stands in -help and in the manual.
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
  companion  // of another program on the same library
};

// What happens when an option is used: it works; it is accepted and changes nothing; or the program stops and
// says why.
enum class Support : uint8_t { full, unused, refused };

// Numbers outside are an error of the command line. lowest and highest belong to it.
struct Range {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
};

struct OptionEntry;

// Where an option's value is kept: the type says how its words are read and how -defaults prints it.
using SwitchValue = bool& (*)(Options&);
using IntegerValue = int& (*)(Options&);
using CountValue = int64_t& (*)(Options&);
using RealValue = double& (*)(Options&);
using ColorValue = Rgb& (*)(Options&);
using WordValue = std::string& (*)(Options&);
using WordsValue = std::vector<std::string>& (*)(Options&);  // one more at each use
// Options with rules of their own: `words` are those after the name; `rest` is what the name's own word has
// behind it.
struct Custom {
  void (*set)(Options& options, const OptionEntry& entry, std::span<const std::string> words,
              std::string_view rest);
};
using OptionValue = std::variant<std::monostate, SwitchValue, IntegerValue, CountValue, RealValue, ColorValue,
                                 WordValue, WordsValue, Custom>;

// One option: the parser, -defaults, -help and the manual all come from this.
struct OptionEntry {
  std::string_view name{};       // "-ab"
  std::string_view arguments{};  // the words after it by name: "N", "red grn blu", or nothing
  Group group = Group::program;
  OptionValue value{};
  Range range{};                 // of each number
  std::string_view unit{};       // of the numbers, where they have one
  std::string_view remark{};     // one line, as -defaults prints it; for switches "on|off"
  std::string_view paragraph{};  // for the manual
  Support support = Support::full;
  std::string_view reason{};  // why it is refused
  // A refused option is let pass with words that ask for nothing ("-me 0 0 0"). Null: never.
  bool (*harmless)(std::span<const std::string> words) = nullptr;
  bool glued = false;      // its value follows without a blank: -fio -ospec
  bool alsoGlued = false;  // it may: -te mod, -temod
  // The line of -defaults without its remark, where the type alone does not give it; empty: no line.
  std::string (*line)(const Options&) = nullptr;
};

// All of them, in the order in which -defaults prints them: rtrace's first, in rtrace's order, then ours.
std::span<const OptionEntry> optionTable();

// The number of words after the option's own.
int arity(const OptionEntry& entry);

// What holds before the first option: rtrace's defaults in ray mode; in sphere mode those for thousands of
// directions whose mean is wanted.
Options modeDefaults(bool sphereMode);

// Reads a command line; words[0] is the program as it was called.
// - "@file" and "$VARIABLE", where an option or the scene may stand, are replaced by the words they hold, at
//   most 4096.
// - Sphere mode is on unless the program is called rtrace, or -S says otherwise; then the mode's defaults are
//   set; then the options, in their order. Switches alone toggle; + 1 y Y t T switch on, - 0 n N f F off.
// - The first word that is no option begins the scene, which takes all the rest.
// - -version (or --version), -defaults and -help (or --help) end it where they stand; -features is only known
//   as the first word. Opens the files of @file, -aE and -aI only. Throws rad::Error with rtrace's words:
//   "command line error at '-ab'", "cannot expand '@x': No such file or directory" (Status::system), "missing
//   octree argument" and so on; and "option '-ap' is not supported: ..." for what rtrace has and rsphere has
//   not.
Options parseOptions(std::span<const std::string> words);
Options parseOptions(int argc, char** argv);

// A program beside rsphere that takes all options of rsphere and some more. The values of the latter are
// members of a struct that it derives from Options, an object of which parseCompanion() must be given.
struct Companion {
  std::span<const OptionEntry> own{};
  std::string_view usage{};  // the rest of its command line, after the name
  bool sphereMode = true;    // the mode without -S
  std::string_view name{};   // begins its messages
  int faultStatus = 0;       // exit status of every fault but a signal; 0: as rtrace(1) gives it
};

// An option as a command line has it, and its words: the first is the option itself.
struct UsedOption {
  const OptionEntry* entry;
  std::vector<std::string> words;
};

// As parseOptions(), for a companion. Sets the part of `options` that is Options and those of its own that
// are given; answers the options given, in their order.
std::vector<UsedOption> parseCompanion(std::span<const std::string> words, const Companion& companion,
                                       Options& options);

// What -help and -defaults print of a companion, and its options as a part of its manual.
std::string companionHelp(const Companion& companion, Options& options);
std::string companionDefaults(const Companion& companion, Options& options);
std::string companionManual(const Companion& companion, Options& defaults);

// What -defaults prints: every option with its present value, in option syntax. Without the remarks (from '#'
// on) it can be read back by @file.
std::string defaultsText(const Options& options);

// What -help prints: every option, one line each.
std::string helpText(const Options& options);

// What -features prints for the words after it. `missing` is the first that this program has not.
struct FeatureReport {
  std::string text, missing;
};
FeatureReport featureReport(std::span<const std::string> wanted);

// The options as a part of man/rsphere.1, in man(7) macros.
std::string manualText();

}  // namespace rsphere
