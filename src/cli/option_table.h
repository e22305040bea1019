#pragma once
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "cli/options.h"

namespace rsphere {

// The section of -help and of the manual that an option belongs to.
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

// The effect of an option: it works; it is accepted and changes nothing; or it is an error, with a reason.
enum class Support : uint8_t { full, unused, refused };

// The numbers that an option accepts, lowest and highest included. Others are an error of the command line.
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
using WordsValue = std::vector<std::string>& (*)(Options&);  // each use adds one
// For options that no type above describes. `words` are the words after the name; `rest` is the part of the
// first word that follows the name.
struct Custom {
  void (*set)(Options& options, const OptionEntry& entry, std::span<const std::string> words,
              std::string_view rest);
};
using OptionValue = std::variant<std::monostate, SwitchValue, IntegerValue, CountValue, RealValue, ColorValue,
                                 WordValue, WordsValue, Custom>;

// One option. The parser, -defaults, -help and the manual are all made from this.
struct OptionEntry {
  std::string_view name{};       // "-ab"
  std::string_view arguments{};  // the names of the words after it: "N", "red grn blu", or nothing
  Group group = Group::program;
  OptionValue value{};
  Range range{};                 // for each of its numbers
  std::string_view unit{};       // of the numbers, if any
  std::string_view remark{};     // one line for -defaults; for switches "on|off"
  std::string_view help{};       // the same for -help, where rtrace's remark is a riddle
  std::string_view paragraph{};  // for the manual
  Support support = Support::full;
  std::string_view reason{};  // why it is refused
  // Whether a refused option is accepted with these words because they ask for nothing. Null: never.
  bool (*harmless)(std::span<const std::string> words) = nullptr;
  bool glued = false;      // its value follows without a blank: -fio -ospec
  bool alsoGlued = false;  // its value may follow without a blank: -te mod, -temod
  // Of a switch whose value is only what rtrace prints by -defaults: whether it is in effect, which -help and
  // the manual state.
  bool (*inEffect)(const Options&) = nullptr;
  // The line of -defaults without its remark, if the type does not determine it. It returns "" for no line.
  std::string (*line)(const Options&) = nullptr;
};

// All options in the order in which -defaults prints them: those of rtrace in rtrace's
// order, then those of rsphere.
std::span<const OptionEntry> optionTable();

// The number of words that follow the option.
int arity(const OptionEntry& entry);

// The values before the first option: in ray mode the defaults of rtrace; in sphere mode defaults that suit
// the mean of thousands of directions.
Options modeDefaults(bool sphereMode);

// The same for the rays of pictures (-Si).
RayOptions pictureDefaults();

// Reads a command line, of which words[0] is the name of the program.
// - "@file" and "$VARIABLE", in the place of an option or of a word of the scene, are replaced by the words
//   that they contain, at most 4096.
// - Sphere mode is on unless the program is called rtrace; -S overrides this. First the defaults of the mode
//   are set, then the options in their order. A switch alone toggles; + 1 y Y t T switch on, - 0 n N f F off.
// - The scene begins at the first word that is not an option, and includes all words after it.
// - The command line ends at -version (or --version), -defaults or -help (or --help). -features is an
//   option only as the first word.
// No files are opened except those of @file, -aE, -aI, -tE and -tI.
// Throws rad::Error in rtrace's words, such as "command line error at '-ab'", "cannot expand '@x': No such
// file or directory" (Status::system) or "missing octree argument"; and "option '-ap' is not supported: ..."
// for an option of rtrace that rsphere lacks.
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
  // Changes the defaults of the mode. Null: they are the companion's.
  void (*defaults)(Options&) = nullptr;
  // Which of rsphere's options it takes. Null: all.
  bool (*takes)(const OptionEntry&) = nullptr;
  // What -features lists besides what all programs do with a scene; empty: that of rtrace.
  std::span<const std::string_view> features{};
};

// An option on a command line, and its words, of which the first is the option itself.
struct UsedOption {
  const OptionEntry* entry;
  std::vector<std::string> words;
};

// The same as parseOptions() for a companion. Sets all of Options, and those of the companion's options that
// the command line gives. Returns the options given, in their order.
std::vector<UsedOption> parseCompanion(std::span<const std::string> words, const Companion& companion,
                                       Options& options);

// The texts of -help and -defaults for a companion, and the options as a part of its manual.
std::string companionHelp(const Companion& companion, Options& options);
std::string companionDefaults(const Companion& companion, Options& options);
std::string companionManual(const Companion& companion, Options& defaults);

// The text of -defaults: every option with its present value, in option syntax. Without the remarks, which
// begin with '#', it can be read back by @file. takes: Companion::takes.
std::string defaultsText(const Options& options, bool (*takes)(const OptionEntry&) = nullptr);

// The text of -help: one line for every option.
std::string helpText(const Options& options);

// The text of -features for the words after it, and the first of them that this program lacks. features: as
// Companion::features.
struct FeatureReport {
  std::string text, missing;
};
FeatureReport featureReport(std::span<const std::string> wanted,
                            std::span<const std::string_view> features = {});

// The options as a part of man/rsphere.1, in man(7) macros.
std::string manualText();

}  // namespace rsphere
