#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "base/overloaded.h"
#include "cli/option_table.h"
#include "cli/option_words.h"
#include "cli/word_file.h"
#include "contrib/bin_function.h"
#include "estimate/ray_estimator.h"
#include "points/quantities.h"
#include "rad_parser/error.h"
#include "rad_parser/nearest_name.h"
#include "rad_parser/number.h"
#include "rad_parser/open_file.h"
#include "rad_parser/printable.h"
#include "records/output_colors.h"

namespace rsphere {
namespace {

// As in rtrace(1). The limit also stops the expansion of a file that refers to itself.
constexpr size_t kMostExpanded = 4096;

// The words of a command line, and a position at which @file and $VARIABLE are expanded.
class CommandWords {
 public:
  explicit CommandWords(std::span<const std::string> words) : words_(words.begin(), words.end()) {}

  bool atEnd() const { return at_ == words_.size(); }
  size_t at() const { return at_; }
  const std::string& word() const { return words_[at_]; }
  std::string take() { return words_[at_++]; }
  std::span<const std::string> rest() const { return std::span(words_).subspan(at_); }
  std::span<const std::string> before() const { return std::span(words_).first(at_); }

  // Expands @file or $VARIABLE at this position, and then the first word of the result if it is one, too.
  void expand() {
    while (!atEnd() && !word().empty() && (word()[0] == '@' || word()[0] == '$')) {
      const std::string name = word();
      const std::vector<std::string> more = name[0] == '@' ? fromFile(name) : fromEnvironment(name);
      expanded_ += more.size() + 1;
      if (expanded_ > kMostExpanded)
        throw rad::Error(fmt::format("cannot expand '{}': too many words", name));
      const auto here = words_.begin() + static_cast<std::ptrdiff_t>(at_);
      words_.insert(words_.erase(here), more.begin(), more.end());
    }
  }

 private:
  static std::vector<std::string> fromFile(const std::string& name) {
    const rad::OpenFile file(name.substr(1));
    if (file.descriptor() < 0) cannotExpand(name, errno);
    return wordsOf(file, name.substr(1), kMostExpanded);
  }

  static std::vector<std::string> fromEnvironment(const std::string& name) {
    const char* text = std::getenv(name.c_str() + 1);
    if (text == nullptr) cannotExpand(name, ENOENT);
    return wordsOf(std::string_view(text), name, kMostExpanded);
  }

  [[noreturn]] static void cannotExpand(const std::string& name, int error) {
    throw rad::Error(fmt::format("cannot expand '{}': {}", rad::printableName(name), std::strerror(error)),
                     rad::Status::system);
  }

  std::vector<std::string> words_;
  size_t at_ = 0, expanded_ = 0;
};

// Whether a switch has this state after its name. The letters that rtrace's switches take are not states of
// switches that begin with -S: they would turn the misspelt option -SN into a switch.
bool hasState(const OptionEntry& entry, std::string_view state) {
  const bool letter = !state.empty() && std::isalpha(static_cast<unsigned char>(state[0])) != 0;
  return std::holds_alternative<SwitchValue>(entry.value) && switched(state, false) &&
         !(letter && entry.name.starts_with("-S"));
}

// The option named by a word: the whole word or, if there is none, a switch with its state or a name followed
// directly by its value. Null if there is no such option. takes: Companion::takes.
const OptionEntry* findOption(std::span<const OptionEntry> table, std::string_view word,
                              bool (*takes)(const OptionEntry&) = nullptr) {
  const auto isTaken = [&](const OptionEntry& entry) { return !takes || takes(entry); };
  for (const OptionEntry& entry : table)
    if (!entry.glued && entry.name == word && isTaken(entry)) return &entry;
  for (const OptionEntry& entry : table)
    if (word.starts_with(entry.name) && hasState(entry, word.substr(entry.name.size())) && isTaken(entry))
      return &entry;
  const OptionEntry* found = nullptr;
  for (const OptionEntry& entry : table)
    if ((entry.glued || entry.alsoGlued) && word.starts_with(entry.name) && isTaken(entry) &&
        (found == nullptr || found->name.size() < entry.name.size()))
      found = &entry;
  return found;
}

// Whether rtrace accepts the word as an argument: it contains visible characters and no control characters.
bool isWord(const std::string& word) {
  const auto isControl = [](unsigned char c) { return c < 32 && c != '\t'; };
  const auto isVisible = [](unsigned char c) { return c > 32 && c != 127; };
  return std::ranges::none_of(word, isControl) && std::ranges::any_of(word, isVisible);
}

// " from 1 to 1000000" or similar; empty if the numbers of an option are unlimited.
std::string rangeText(const Range& range) {
  const auto isBound = [](double x) { return std::abs(x) < std::numeric_limits<int>::max(); };
  if (isBound(range.lowest) && isBound(range.highest))
    return fmt::format(" from {} to {}", range.lowest, range.highest);
  return isBound(range.lowest) ? fmt::format(" of at least {}", range.lowest) : "";
}

// The advice to write a percentage as a fraction, as the end of a message.
std::string percent(double x) { return fmt::format(": {}% is written {}", x, x / 100); }

void checkRange(const OptionEntry& entry, double x) {
  const auto& [lowest, highest] = entry.range;
  if (x < lowest && highest == std::numeric_limits<double>::infinity())
    commandLineError(entry.name, fmt::format("{} is less than {}", x, lowest));
  if (x < lowest || x > highest)
    commandLineError(entry.name, fmt::format("{} is not from {} to {}{}", x, lowest, highest,
                                             lowest == 0 && highest == 1 && x > 1 ? percent(x) : ""));
}

int64_t integerWord(const OptionEntry& entry, const std::string& word) {
  const auto n = rad::parseInteger(word);
  if (!n) notInteger(entry.name, word, rangeText(entry.range));
  checkRange(entry, static_cast<double>(*n));
  return *n;
}

// Whether this word cannot be a value of the option: the word is blank, or it is an option where a number is
// expected.
bool isMissing(const OptionEntry& entry, const std::string& word) {
  if (!isWord(word)) return true;
  const bool takesNumbers =
      std::holds_alternative<IntegerValue>(entry.value) || std::holds_alternative<CountValue>(entry.value) ||
      std::holds_alternative<RealValue>(entry.value) || std::holds_alternative<ColorValue>(entry.value);
  return takesNumbers && !rad::parseReal(word) && findOption(optionTable(), word) != nullptr;
}

// Throws the error of missing values: only `found` values of the option were given. next: the following word,
// which is not a value; null: the command line ends.
[[noreturn]] void missingWords(const std::string& given, const OptionEntry& entry, size_t found,
                               const std::string* next) {
  const int wanted = arity(entry);
  if (next != nullptr && rad::printable(*next) != *next)
    commandLineError(given,
                     fmt::format("its value contains a control character: \"{}\"", rad::printable(*next)));
  const std::string use = fmt::format("{} {}", entry.name, entry.arguments);
  const std::string why = next == nullptr ? "the command line ends"
                          : isWord(*next) ? fmt::format("{} follows", *next)
                                          : "no further word follows";
  if (wanted == 1) commandLineError(given, fmt::format("its value is missing ({}): {}", use, why));
  commandLineError(given, fmt::format("{} of its {} values are missing ({}): {}",
                                      static_cast<size_t>(wanted) - found, wanted, use, why));
}

// The options for output colors, as the end of a message.
std::string colorOutputs() {
  std::string names;
  for (const OptionEntry& entry : optionTable())
    if (entry.name.starts_with("-p") && arity(entry) == 0)
      names += fmt::format("{}{}", names.empty() ? "" : ", ", entry.name);
  return fmt::format("; the colors of the output are {}; -pY is luminance, or illuminance in lux", names);
}

// The option named by a word: an option of the companion, or of rsphere if the companion accepts it.
const OptionEntry* findOption(const Companion& companion, std::string_view word) {
  const OptionEntry* entry = findOption(companion.own, word);
  return entry ? entry : findOption(optionTable(), word, companion.takes);
}

// The reason why a word that begins with a hyphen is not an option.
std::string whyUnknown(const Companion& companion, std::string_view word) {
  if (word.starts_with("--") && findOption(companion, word.substr(1)) != nullptr)
    return fmt::format("options begin with one hyphen: {}", word.substr(1));
  if (word.starts_with("-p") && findOption(companion, "-pY") != nullptr)
    return "there is no such option" + colorOutputs();
  rad::NearestName nearest(word);
  for (const OptionEntry& entry : companion.own) nearest.consider(entry.name);
  for (const OptionEntry& entry : optionTable())
    if (entry.support != Support::refused && (!companion.takes || companion.takes(entry)))
      nearest.consider(entry.name);
  return "there is no such option" + nearest.hint();
}

void apply(const UsedOption& use, Options& options) {
  const OptionEntry& entry = *use.entry;
  if (entry.support == Support::refused)
    throw rad::Error(fmt::format("option '{}' is not supported: {}", entry.name, entry.reason));
  const auto real = [&](size_t i) { return realWord(entry, use.words[i]); };
  match(
      entry.value, [](std::monostate) {},
      [&](SwitchValue value) { value(options) = switched(use.rest, value(options)).value(); },
      [&](IntegerValue value) { value(options) = static_cast<int>(integerWord(entry, use.words[0])); },
      [&](CountValue value) { value(options) = integerWord(entry, use.words[0]); },
      [&](RealValue value) { value(options) = real(0); },
      [&](ColorValue value) { value(options) = Color(real(0), real(1), real(2)); },
      [&](WordValue value) { value(options) = use.words[0]; },
      [&](WordsValue value) { value(options).push_back(use.words[0]); },
      [&](const Custom& custom) { custom.set(options, entry, use.words, use.rest); });
}

// Separates the letters for the record from those for its tree, in ray mode: the former precede the first t
// or T, the latter follow the last one. A t or T at the end has no effect.
void splitTree(Options& options) {
  std::string letters = options.outputs;
  if (options.sphereMode || letters.find_first_of("tT") == std::string::npos) return;
  options.treeShadows = letters.find('T') != std::string::npos;
  if (letters.back() == 't' || letters.back() == 'T') letters.pop_back();
  options.outputs = letters.substr(0, letters.find_first_of("tT"));
  if (const size_t tree = letters.find_last_of("tT"); tree != std::string::npos)
    options.treeOutputs = letters.substr(tree + 1);
}

// Checks the letters of -o with -Su.
void checkGlareLetters(const Options& options) {
  const std::string_view known = options.sphere.everyDirection ? "iodlLwWps" : "oduUvVbBgGnt";
  for (const char letter : options.outputs)
    if (known.find(letter) == std::string_view::npos)
      throw rad::Error(fmt::format("unrecognized output option '{}' (glare): the letters are {}; see -help",
                                   letter, known));
  if (options.out == NumberFormat::rgbe)
    commandLineError("-Su", "glare indices are not colors: not with -fac");
}

// Throws rad::Error if a letter of -o does not belong to the mode or to the output format.
void checkLetters(const Options& options) {
  if (options.sphereMode && options.sphere.glare.wanted) return checkGlareLetters(options);
  const bool points = options.sphereMode && !options.sphere.everyDirection;
  std::string known = !options.sphereMode ? "odveVwWlLcpnNsmMrRxX~" : points ? "" : "iodwvlLcpnNsmM~";
  std::string colors = !options.sphereMode ? "vrx" : points ? "" : "v";
  if (points)
    for (const PointQuantity& quantity : pointQuantities()) {
      if (quantity.definition.empty()) continue;  // another meaning of e
      if (quantity.values != PointQuantity::kOfZones || options.sphere.zones > 0) known += quantity.letter;
      if (quantity.each && quantity.values == 1 && !quantity.definition.empty()) colors += quantity.letter;
    }
  for (const char letter : options.outputs + options.treeOutputs) {
    if (known.find(letter) != std::string::npos) continue;
    if (points && pointQuantity(letter))
      throw rad::Error(fmt::format("-o{} needs -Sz N, a number of zones, or -Szb", letter));
    const std::string_view hint = options.sphereMode ? " (sphere mode)" : "";
    throw rad::Error(fmt::format("unrecognized output option '{}'{}: the letters are {}{}; see -help", letter,
                                 hint, known, options.sphereMode ? "" : " and t, T for ray trees"));
  }
  if (options.out == NumberFormat::rgbe && (options.outputs.size() != 1 || !options.treeOutputs.empty() ||
                                            colors.find(options.outputs[0]) == std::string::npos))
    throw rad::Error(fmt::format("color format only with -o{}", fmt::join(colors, ", -o")));
}

// Remarks on a letter of -o that is written twice (e may follow several), and on zones that none shows.
void remarkOnLetters(Options& options) {
  const std::string& letters = options.outputs;
  for (size_t i = 1; i < letters.size(); ++i)
    if (letters.find(letters[i]) < i && (letters[i] != 'e' || letters[i - 1] == 'e'))
      options.messages.remarks.push_back(fmt::format("-o{}: {} is written twice", letters, letters[i]));
  if (options.sphere.zones > 0 && letters.find_first_of("zZ") == std::string::npos)
    options.messages.remarks.push_back("zones (-Sz, -Szb) have no effect without z among the letters of -o");
}

// Reports rtrace's errors and warnings about colors.
void checkColorOutput(Options& options) {
  ColorOptions& color = options.color;
  if (color.space == ColorSpace::spectrum && color.bands == 3) color.space = ColorSpace::rgb;
  checkColors(color);
  options.ray.sampling = color.sampling();
  options.ray.wavelengths = {color.shortest, color.longest};
  const bool oneChannel = color.space >= ColorSpace::photopic && color.space <= ColorSpace::average;
  if (!spectrumHoldsChannels(color.shortest, color.longest) && !oneChannel &&
      color.space != ColorSpace::spectrum)
    options.messages.remarks.push_back("spectral range incompatible with color output");
  if (options.out == NumberFormat::rgbe && oneChannel)
    throw rad::Error("color format incompatible with -pY, -pS, -pM");
  const auto isError = [](char letter) { return haveErrors({&letter, 1}); };
  const auto error = std::ranges::find_if(options.outputs, isError);
  if (!options.sphere.glare.wanted && !options.sphere.everyDirection && !haveStandardErrors(color) &&
      error != options.outputs.end())
    throw rad::Error(fmt::format(
        "-o{} needs {}", *error,
        color.bands > 3 ? "-co or -pY with -cs above 3: standard errors exist for bands, or for luminance"
                        : "-pRGB or -pY: standard errors exist for red, green and blue, or for luminance"));
}

// Sets options.irradiance. Reports rtrace's errors and warnings about irradiance and the letters of a ray.
void checkIrradiance(Options& options) {
  options.irradiance = options.irradianceAtPoint ? IrradianceAt::point
                       : options.irradianceAtHit ? IrradianceAt::surface
                                                 : IrradianceAt::none;
  if (options.irradiance != IrradianceAt::none && options.treeOutputs.empty() &&
      options.outputs.find_first_of("veVrRxXlnW") == std::string::npos)
    throw rad::Error("-I+ and -i+ options require some value output");
  const auto given = [&](const char* letters) {
    return !options.sphereMode && options.outputs.find_first_of(letters) != std::string::npos;
  };
  std::vector<std::string>& remarks = options.messages.remarks;
  if (given("VW")) remarks.push_back("-oVW options require trace mode");
  if (options.irradiance != IrradianceAt::none && given("rRxX"))
    remarks.push_back("-orRxX options incompatible with -I+ and -i+");
}

// Limits on the directions at a point with -Sa but without -Sx. A point that never reaches the accuracy takes
// half a second to a minute. The limit is lower with -Sd, because it stores all directions of a point until
// the point is finished, a kilobyte each.
constexpr int kMostForAccuracy = 1000000, kMostToList = 100000;

void checkSensors(const Options& options) {
  if (options.sensors.empty()) return;
  if (options.sphere.weights != Weights::silhouettes)
    commandLineError("-SG", "needs -Sw c, which aims at sensors");
  if (!options.picture.empty()) commandLineError("-SG", "sensors cannot be seen: not with -Si");
}

void checkParts(const Options& options) {
  if (!options.separate) return;
  if (options.color.bands > 3)
    commandLineError("-Sp", "needs red, green and blue: -cs above 3 is not possible");
  if (options.out == NumberFormat::rgbe)
    commandLineError("-Sp", "a pixel cannot hold several parts: not with -fac");
  if (!options.ray.ambientFile.empty())
    commandLineError("-Sp", "an ambient file (-af) does not keep the parts of light");
}

// -Szb -Szn
void makeBins(Options& options) {
  SphereOptions& sphere = options.sphere;
  if (sphere.zoneOf.empty() && sphere.zoneCount.empty()) return;
  if (sphere.zoneOf.empty()) commandLineError("-Szn", "needs -Szb, an expression of the bin");
  if (sphere.zoneCount.empty()) commandLineError("-Szb", "needs -Szn, the number of bins");
  if (sphere.zones > 0) commandLineError("-Szb", "bins and zones (-Sz) exclude each other");
  sphere.bins = directionBins(sphere.zoneOf, sphere.zoneCount, {options.ray.definitions, {}});
  sphere.zones = static_cast<int>(sphere.bins->count());
}

void checkGlare(const Options& options) {
  const SphereOptions& sphere = options.sphere;
  const GlareOptions usual;
  if (!sphere.glare.wanted && sphere.glare.threshold != usual.threshold)
    commandLineError("-Sub", "needs -Su, glare at an eye");
  if (!sphere.glare.wanted && sphere.glare.taskOpening != usual.taskOpening)
    commandLineError("-Sut", "needs -Su, glare at an eye");
  if (!sphere.glare.wanted) return;
  const auto refuse = [](bool given, std::string_view name, std::string_view why) {
    if (given) commandLineError(name, fmt::format("not with -Su: {}", why));
  };
  refuse(!options.goals.empty(), "-Sg", "goals emit importance, but glare is computed from radiance");
  refuse(!options.sensors.empty(), "-SG", "goals emit importance, but glare is computed from radiance");
  refuse(options.separate, "-Sp", "a glare index is not a sum of parts");
  refuse(sphere.basicRadiance, "-Sb", "glare is computed from radiance, not from basic radiance");
  refuse(sphere.zones > 0, "-Sz", "zones apply to mean radiance");
  refuse(sphere.accuracy > 0, "-Sa", "increase -Sn to reduce the errors");
  refuse(sphere.weights != Weights::silhouettes, "-Sw",
         "glare needs -Sw c, which integrates light sources separately");
  refuse(!options.picture.empty(), "-Si", "pictures show the light at points, not the view of an eye");
}

// Checks -Sa, and what asks for standard errors of rays.
void checkAccuracy(const Options& options) {
  if (options.sphere.accuracy >= 1)
    commandLineError("-Sa", "an error of 1 is as large as the mean" + percent(1));
  if ((options.estimatesRays() && !options.treeOutputs.empty()) ||
      options.treeOutputs.find('e') != std::string::npos)
    commandLineError("-ot", "the rays of a tree have no standard errors: not with -Sa or -oe");
}

// Sets how many solutions there are, and how many rays patches have, where rays have standard errors.
void setSolutions(RayOptions& ray, double accuracy) {
  if (!(ray.ambientAccuracy > 0)) return;
  ray.solutions = static_cast<int>(RayEstimator::kSolutions);
  if (accuracy > 0) ray.raysForPatches = RayEstimator::raysForPatches(ray, accuracy);
}

void checkTogether(Options& options, bool mostGiven) {
  checkAccuracy(options);
  if (options.estimatesRays()) setSolutions(options.ray, options.sphere.accuracy);
  checkParts(options);
  checkSensors(options);
  checkGlare(options);
  if (options.ray.fieldMemory > 0 && !options.ray.ambientFile.empty())
    throw rad::Error("-Sm and -af exclude each other: an ambient file is kept in memory as a whole");
  options.ray.patchesForRecords =
      !options.sphereMode && options.irradiance != IrradianceAt::point && !options.estimatesRays();
  if (!options.sphereMode) return;
  if (options.listSpecial && !options.picture.empty())
    commandLineError("-Si", "not with -Sl, which lists special objects and answers no points");
  SphereOptions& sphere = options.sphere;
  if (!sphere.glare.wanted && !sphere.everyDirection) sphere.quantityErrors = ownErrors(options.outputs);
  options.ray.leastForPatches = sphere.raysForPatches();
  if (!mostGiven) {
    sphere.mostDirections = std::max(sphere.mostDirections, 2 * sphere.baseDirections);
    if (sphere.accuracy > 0) sphere.mostForAccuracy = sphere.everyDirection ? kMostToList : kMostForAccuracy;
  }
  if (sphere.mostDirections < sphere.baseDirections)
    commandLineError("-Sx",
                     fmt::format("{} is less than -Sn {}", sphere.mostDirections, sphere.baseDirections));
}

// The options of a command line, and the mode that they select.
struct Given {
  std::vector<UsedOption> uses;
  Request request = Request::answers;
  bool sphereMode = true;

  // Whether standard errors or an accuracy are requested.
  bool asksForErrors() const {
    return std::ranges::any_of(uses, [](const UsedOption& use) {
      const std::string_view name = use.entry->name;
      return name == "-Sa" || name == "-oe" || (name == "-o" && use.rest.find('e') != std::string::npos);
    });
  }
  bool has(std::string_view name) const {
    return std::ranges::any_of(uses, [&](const UsedOption& use) { return use.entry->name == name; });
  }
};

// The default letters of -o.
std::string_view usualOutputs(const Options& options) {
  if (!options.sphereMode) return "v";
  const SphereOptions& sphere = options.sphere;
  if (sphere.glare.wanted) return sphere.everyDirection ? "idlwps" : "uvbg";
  return sphere.everyDirection ? "odwv" : "v";
}

// Throws rad::Error for an option that has no effect in the mode, unless it is a switch that is off.
void checkModes(const std::vector<UsedOption>& uses, Options& options) {
  for (const UsedOption& use : uses) {
    const OptionEntry& entry = *use.entry;
    const auto* const value = std::get_if<SwitchValue>(&entry.value);
    if (worksIn(entry, options.sphereMode) || (value && !(*value)(options))) continue;
    const bool points = entry.mode == Mode::points;
    commandLineError(entry.name, fmt::format("needs {}: {}", points ? "sphere mode (-S+)" : "ray mode (-S-)",
                                             !entry.elsewhere.empty() ? entry.elsewhere
                                             : points                 ? "it has no effect on rays"
                                                                      : "it has no effect on points"));
  }
}

// Reads the option named by `word`, and its values from the following words.
UsedOption takeUse(CommandWords& words, const Companion& companion, const std::string& word) {
  const OptionEntry* entry = findOption(companion, word);
  if (entry == nullptr) commandLineError(word, whyUnknown(companion, word));
  UsedOption use{entry, word.substr(entry->name.size()), {}};
  if (entry->alsoGlued && !use.rest.empty()) use.words.push_back(use.rest);
  while (use.words.size() < static_cast<size_t>(arity(*entry))) {
    if (words.atEnd()) missingWords(word, *entry, use.words.size(), nullptr);
    if (isMissing(*entry, words.word())) missingWords(word, *entry, use.words.size(), &words.word());
    // After a first number, another word may be the scene: -av .1 room.rad.
    if (std::holds_alternative<ColorValue>(entry->value) && !use.words.empty() &&
        rad::parseReal(use.words[0]) && !rad::parseReal(words.word()))
      commandLineError(word, fmt::format("\"{}\" is not a number, as value {} of {} ({} {}) must be",
                                         rad::printable(words.word()), use.words.size() + 1, arity(*entry),
                                         entry->name, entry->arguments));
    use.words.push_back(words.take());
  }
  return use;
}

Given takeOptions(CommandWords& words, const Companion& companion, bool sphereMode) {
  Given given;
  given.sphereMode = sphereMode;
  for (words.expand(); !words.atEnd() && words.word().starts_with("-"); words.expand()) {
    const std::string word = words.take();
    if (word == "-version" || word == "--version") given.request = Request::version;
    if (word == "-defaults") given.request = Request::defaults;
    if (word == "-help" || word == "--help")
      given.request = !words.atEnd() && words.word() == "all" ? Request::helpAll : Request::help;
    if (given.request != Request::answers) break;
    if (word == "-features") commandLineError(word, "it must be the first option");
    UsedOption use = takeUse(words, companion, word);
    if (use.entry->name == "-S") given.sphereMode = switched(use.rest, given.sphereMode).value();
    given.uses.push_back(std::move(use));
  }
  return given;
}

std::vector<std::string> takeScene(CommandWords& words) {
  std::vector<std::string> scene;
  for (const size_t first = words.at(); !words.atEnd(); words.expand()) {
    if (words.word().starts_with("-"))
      commandLineError(words.before()[first],
                       fmt::format("the scene begins here, but '{}' follows; options come before the scene",
                                   words.word()));
    for (const char* dash : {"\u2010", "\u2013", "\u2014", "\u2212"})  // as manuals and web pages print it
      if (words.word().starts_with(dash))
        commandLineError(words.word(), "options begin with a hyphen, not a dash");
    scene.push_back(words.take());
  }
  if (scene.empty())
    throw rad::Error(
        "missing octree argument: an octree, scene files or a '!command' that makes them come "
        "after the options; see -help");
  return scene;
}

// Options for pictures: their own defaults, overridden by the given options.
RayOptions rayOptionsOfPictures(const Given& given, const Options& options) {
  Options own = options;
  own.ray = pictureDefaults();
  for (const UsedOption& use : given.uses)
    if (use.entry->name != "-S") apply(use, own);
  own.ray.sampling = options.ray.sampling;
  own.ray.wavelengths = options.ray.wavelengths;
  own.ray.ambientFile.clear();  // contains light of answers, which have different options
  return own.ray;
}

}  // namespace

void commandLineError(std::string_view at, std::string_view why) {
  throw rad::Error(fmt::format("command line error at '{}': {}; see -help", rad::printable(at), why));
}

double realWord(const OptionEntry& entry, const std::string& word) {
  const auto x = rad::parseReal(word);
  if (!x) notReal(entry.name, word, rangeText(entry.range));
  checkRange(entry, *x);
  return *x;
}

void notReal(std::string_view option, std::string_view word, std::string_view range) {
  std::string hint;
  if (word.ends_with('%'))
    if (const auto x = rad::parseReal(word.substr(0, word.size() - 1))) hint = percent(*x);
  if (word.find(',') != word.npos) hint = ": use a decimal point";
  commandLineError(option, fmt::format("\"{}\" is not a number{}{}", rad::printable(word), range, hint));
}

void notInteger(std::string_view option, std::string_view word, std::string_view range) {
  const auto x = rad::parseReal(word);
  const bool written = x && *x == std::floor(*x);  // 1e6
  commandLineError(option, fmt::format("\"{}\" is not a whole number{}{}", rad::printable(word),
                                       written ? " in digits" : "", range));
}

std::optional<bool> switched(std::string_view suffix, bool before) {
  if (suffix.empty()) return !before;
  if (suffix.size() != 1) return std::nullopt;
  if (std::string_view("+1yYtT").find(suffix[0]) != std::string_view::npos) return true;
  if (std::string_view("-0nNfF").find(suffix[0]) != std::string_view::npos) return false;
  return std::nullopt;
}

std::vector<UsedOption> parseCompanion(std::span<const std::string> commandLine, const Companion& companion,
                                       Options& options) {
  const std::string called = commandLine.empty() ? "rsphere" : commandLine[0];
  const std::string program = called.substr(called.rfind('/') + 1);
  CommandWords words(commandLine.subspan(commandLine.empty() ? 0 : 1));
  if (!words.atEnd() && words.word() == "-features") {
    words.take();
    options.program = program;
    options.request = Request::features;
    options.features.assign(words.rest().begin(), words.rest().end());
    return {};
  }
  Given given = takeOptions(words, companion, companion.sphereMode && program != "rtrace");
  options = modeDefaults(given.sphereMode);
  if (companion.defaults) companion.defaults(options);
  if (!given.sphereMode && given.asksForErrors()) setErrorDefaults(options.ray, given.has("-Sa"));
  options.program = program;
  options.request = given.request;
  options.words.assign(words.before().begin(), words.before().end());
  for (const UsedOption& use : given.uses)
    if (use.entry->name != "-S") apply(use, options);
  checkModes(given.uses, options);
  if (options.outputs.empty()) options.outputs = usualOutputs(options);
  const bool answers = options.request == Request::answers;
  if (answers) options.scene = takeScene(words);
  options.progressGiven = given.has("-t");
  options.numberedRays = given.has("-u") && options.ray.uncorrelated && !options.sphereMode;
  splitTree(options);
  if (answers) makeBins(options);
  checkLetters(options);
  if (answers && given.has("-o")) remarkOnLetters(options);  // not for the API, which returns zones anyway
  if (answers) checkColorOutput(options);
  checkIrradiance(options);
  checkTogether(options, given.has("-Sx"));
  if (!options.picture.empty()) options.pictureRay = rayOptionsOfPictures(given, options);
  for (const std::string_view name : {"-Siw", "-Siv", "-Sih", "-Sie"})
    if (answers && options.picture.empty() && given.has(name)) commandLineError(name, "needs -Si, a picture");
  return std::move(given.uses);
}

Options parseOptions(std::span<const std::string> words) {
  Options options;
  parseCompanion(words, Companion{}, options);
  return options;
}

}  // namespace rsphere
