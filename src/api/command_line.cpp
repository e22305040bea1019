#include "api/command_line.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/option_table.h"
#include "contrib/contribution_defaults.h"
#include "rad_parser/error.h"
#include "rad_parser/printable.h"

namespace rsphere::v1 {
namespace {

// An empty word, which ends the options as a scene does on a command line. No option takes one as its value.
constexpr std::string_view kScene;

class Words {
 public:
  explicit Words(std::string program) : words_{std::move(program)} {}

  template <typename Number>
  void add(std::string_view name, const std::optional<Number>& value) {
    if (!value) return;
    words_.emplace_back(name);
    words_.push_back(fmt::format("{}", *value));
  }
  void add(std::string_view name, const std::optional<std::array<double, 3>>& value) {
    if (!value) return;
    words_.emplace_back(name);
    for (const double number : *value) words_.push_back(fmt::format("{}", number));
  }
  void add(std::string word) { words_.push_back(std::move(word)); }
  const std::vector<std::string>& words() const { return words_; }

 private:
  std::vector<std::string> words_;
};

// Parameters become definitions after those of the files, which they override.
void addBins(const Bins& bins, Words& words) {
  if (bins.zones > 1) throw rad::Error("directionBins have an expression; Options::zones are equal zones");
  for (const std::string& file : bins.files) words.add("-f", std::optional(file));
  for (const std::string_view one : rad::split(bins.parameters, ",:;")) words.add("-e", std::optional(one));
  words.add("-Szb", std::optional(bins.expression));
  words.add("-Szn", std::optional(bins.count));
}

void refuse(bool given, std::string_view option, std::string_view reason) {
  if (given) throw rad::Error(fmt::format("option '{}': {}", option, reason));
}

// Why a word might be taken for a value; empty unless it follows an option.
std::string afterOption(const std::string& word, std::span<const std::string> words) {
  const std::string& before = *(std::ranges::find(words, word) - 1);
  return before.starts_with('-') ? fmt::format(", and {} takes no value", before) : "";
}

// Whether an option only affects threads or output.
bool isOfOutput(const OptionEntry& entry) {
  static constexpr std::array<std::string_view, 7> kNames = {"-n", "-o", "-h", "-x", "-y", "-t", "-w"};
  if (entry.name == "-cs" || entry.name == "-cw") return false;  // the bands in which light is computed
  return entry.group == Group::color || std::ranges::find(kNames, entry.name) != kNames.end();
}

}  // namespace

CommandOptions commandOptions(const Options& options, Records records) {
  const bool glare = records == Records::glare, rays = records != Records::points && !glare;
  Companion companion;
  if (records == Records::contributions)
    companion.defaults = [](rsphere::Options& o) { setContributionDefaults(o.ray); };
  Words words(rays ? "rtrace" : "rsphere");
  words.add("-ab", options.ambientBounces);
  words.add("-aa", options.ambientAccuracy);
  words.add("-ad", options.ambientDivisions);
  words.add("-as", options.ambientSuperSamples);
  words.add("-ar", options.ambientResolution);
  words.add("-av", options.ambientValue);
  words.add("-lr", options.limitReflections);
  words.add("-lw", options.limitWeight);
  words.add("-Sr", options.rotation);
  if (options.irradianceAtOrigin) words.add("-I+");
  if (options.irradianceAtSurface) words.add("-i+");
  words.add("-Sn", options.directions);
  words.add("-Sx", options.mostDirections);
  words.add("-Sa", options.accuracy);
  words.add("-Sz", options.zones);
  if (options.directionBins) addBins(*options.directionBins, words);
  if (glare) words.add("-Su+");
  if (!options.outputs.empty()) words.add("-o" + options.outputs);
  words.add("-n", std::optional(options.threads));
  for (const std::string& argument : options.arguments) words.add(argument);
  words.add(std::string(kScene));

  for (const std::string& word : words.words())
    if (word.find('\0') != std::string::npos)
      throw rad::Error(fmt::format("the option \"{}\" contains a NUL byte", rad::printable(word)));
  rsphere::Options parsed;
  const std::vector<UsedOption> used = parseCompanion(words.words(), companion, parsed);
  if (parsed.request != Request::answers)
    throw rad::Error(
        "-help, -version, -defaults and -features are for the command rsphere, not for the library");
  if (parsed.scene.size() > 1)
    throw rad::Error(fmt::format("\"{}\" is not an option: options begin with a hyphen{}", parsed.scene[0],
                                 afterOption(parsed.scene[0], words.words())));
  refuse(parsed.sphereMode == rays, "-S", "trace() and contributions() answer rays, and sphere() points");
  refuse(parsed.sphere.glare.wanted != glare, "-Su", "glare() answers eyes, and sphere() points");
  refuse(!parsed.goals.empty(), "-Sg",
         "goals belong to the scene (SceneOptions), or are those of importance()");
  refuse(!parsed.sensors.empty(), "-SG", "sensors are given to importanceOfSensors()");
  refuse(!parsed.commands, "-Sc", "commands belong to the scene: see SceneOptions");
  refuse(parsed.sphere.everyDirection, "-Sd", "only the command rsphere lists every direction");
  refuse(parsed.listSpecial, "-Sl", "only the command rsphere lists the special objects");
  refuse(!parsed.treeOutputs.empty() || (rays && options.outputs.find_first_of("tT") != std::string::npos),
         "-ot", "only the command rsphere writes ray trees");
  if (records == Records::contributions) {
    limitToContributions(parsed.ray);
    refuse(parsed.color.space != ColorSpace::rgb && parsed.color.space != ColorSpace::spectrum, "-p",
           "contributions are red, green and blue, or bands (-cs)");
  }
  const auto isOutputs = [](const UsedOption& option) { return option.entry->name == "-o"; };
  const bool usual = std::ranges::none_of(used, isOutputs);
  if (glare && usual) parsed.outputs = "uUvVbBgGt";
  refuse(glare && parsed.outputs.find_first_of("odn") != std::string::npos, "-o",
         "only the command rsphere writes o, d and n: the caller knows its eyes and gazes, and the length of "
         "the list of glare sources is their number");
  if (records == Records::points && usual) {
    const bool zones = parsed.sphere.zones > 0, errors = haveStandardErrors(parsed.color);
    parsed.outputs =
        std::string(errors ? "veECHuk" : "vECHuk") + (zones ? "z" : "") + (zones && errors ? "Z" : "");
  }
  parsed.out = NumberFormat::float64;

  // The words contain the values of variables and the contents of option files.
  CommandOptions result{std::move(parsed), {}, {}};
  const auto add = [](std::string& key, const std::string& word) { key.append(word).push_back('\0'); };
  add(result.key, result.options.program);
  for (const std::string& word : result.options.words) add(result.key, word);
  add(result.sceneKey, records == Records::contributions ? "contributions" : result.options.program);
  // Standard errors (-oe) need several solutions.
  if (result.options.estimatesRays()) add(result.sceneKey, "standard errors");
  // Light of contributions is not interpolated, so that what is prepared has no random numbers of -Sr.
  const auto changesScene = [&](const OptionEntry& entry) {
    return !isOfOutput(entry) && !(records == Records::contributions && entry.name == "-Sr");
  };
  for (const UsedOption& option : used) {
    if (!changesScene(*option.entry)) continue;
    add(result.sceneKey, std::string(option.entry->name) + option.rest);
    for (const std::string& word : option.words) add(result.sceneKey, word);
  }
  return result;
}

}  // namespace rsphere::v1
