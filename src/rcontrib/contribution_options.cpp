#include "rcontrib/contribution_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "cli/option_words.h"
#include "cli/word_file.h"
#include "contrib/contribution_defaults.h"

namespace rsphere {
namespace {

ContributionOptions& own(Options& options) { return static_cast<ContributionOptions&>(options); }

void track(ContributionOptions& options, const std::string& name) {
  if (name == "void") throw rad::Error("cannot track 'void' modifier");
  options.tracked.push_back(options.next);
  options.tracked.back().name = name;
}

using Words = std::span<const std::string>;

void setModifier(Options& options, const OptionEntry&, Words words, std::string_view) {
  track(own(options), words[0]);
}

void setModifierFile(Options& options, const OptionEntry&, Words words, std::string_view) {
  for (const std::string& name : wordsOfFile("modifier file", words[0])) track(own(options), name);
}

void setBins(Options& options, const OptionEntry&, Words words, std::string_view) {
  TrackedName& next = own(options).next;
  next.bins = words[0];
  next.definitionsOfBins = next.definitions;
}

// A name followed by ` belongs to the function files of the scene, which are compiled separately.
void setExpression(Options& options, const OptionEntry& entry, Words words, std::string_view) {
  if (words[0].find('`') != std::string::npos)
    commandLineError(entry.name, "definitions for the function files of the scene (name`) are not supported");
  own(options).next.definitions.shared.push_back({false, words[0]});
}

void setFunctions(Options& options, const OptionEntry&, Words words, std::string_view) {
  own(options).next.definitions.shared.push_back({true, words[0]});
}

std::string noLine(const Options&) { return ""; }

constexpr OptionEntry kContributionOptions[] = {
    {{"-m", "mod", "tracked modifier", Group::companion, Custom{setModifier}}},
    {{"-M", "file", "tracked modifiers of a file", Group::companion, Custom{setModifierFile}}},
    {{"-V", "", "output contributions|output coefficients", Group::companion,
      of<&ContributionOptions::values>}},
    {{"-c", "count", "accumulated rays per record", Group::companion, of<&ContributionOptions::raysPerRecord>,
      Range{0, 2147483647}, "rays"}},
    {{"-b", "bin", "bin of a ray, an expression", Group::companion,
      +[](Options& o) -> std::string& { return own(o).next.bin; }},
     {.line = noLine}},
    {{"-bn", "count", "number of bins", Group::companion, Custom{setBins}}},
    {{"-p", "list", "parameters of the bin", Group::companion,
      +[](Options& o) -> std::string& { return own(o).next.definitions.parameters; }},
     {.line = noLine}},
    {{"-e", "text", "definitions for bins", Group::companion, Custom{setExpression}}},
    {{"-f", "file", "function file for bins", Group::companion, Custom{setFunctions}}},
    {{"-o", "spec", "output file", Group::companion,
      +[](Options& o) -> std::string& { return own(o).next.output; }},
     {.line = noLine}},
    {{"-oe", "spec", "output file of standard errors", Group::companion,
      +[](Options& o) -> std::string& { return own(o).next.errors; }},
     {.line = noLine}},
    {{"-fo", "", "overwrite files|keep files", Group::companion, of<&ContributionOptions::overwrites>}},
    {{"-r", "", "complete existing files|start anew", Group::companion, of<&ContributionOptions::recovers>}},
};

// The features that -features lists in addition to those of all programs, in the words of RADIANCE's
// rcontrib.
constexpr std::string_view kFeatures[] = {
    "Hyperspectral",    "ShadowCache",        "Multiprocessing",       "Accumulation",
    "Summation",        "Recovery",           "ImmediateIrradiance",   "ProgressReporting",
    "DistanceLimiting", "InputFormats=a,f,d", "OutputFormats=a,f,d,c", "Outputs=V,W",
    "OutputCS=RGB,spec"};

// rcontrib has no options of sphere mode, of ray trees, or of the contents of records.
bool takes(const OptionEntry& entry) {
  if (entry.name == "-Sr" || entry.name == "-Sc" || entry.name == "-Sa" || entry.name == "-cs" ||
      entry.name == "-cw")
    return true;
  const bool refused = entry.group == Group::sphere || entry.group == Group::trees ||
                       entry.group == Group::color || entry.name == "-o" || entry.name == "-P" ||
                       entry.name == "-PP" || (!entry.glued && (entry.name == "-f" || entry.name == "-e"));
  return !refused;
}

// A record with this number of bins takes .7 GB (measured).
constexpr double kMostBins = 1e7;

// Empty if the whole modifier is in bin 0.
std::optional<BinFunction> binOf(const TrackedName& tracked, const BinDefinitions& definitions,
                                 BinFunctions& functions) {
  if (tracked.bin == "0") return std::nullopt;
  const BinFunction bin = functions.compile("-b", tracked.bin, definitions);
  if (!bin.isConstant()) return bin;
  if (std::floor(bin.constant() + .5) != 0)
    throw rad::Error(
        fmt::format("illegal non-zero constant for bin ({}) of modifier '{}'", bin.constant(), tracked.name));
  return std::nullopt;
}

uint32_t binCountOf(const TrackedName& tracked, BinFunctions& functions) {
  double count = 0;
  if (!tracked.bins.empty()) {
    const BinFunction bins = functions.compile("-bn", tracked.bins, tracked.definitionsOfBins);
    if (!bins.isConstant())
      throw rad::Error(fmt::format("-bn '{}': the number of bins must not depend on the ray", tracked.bins));
    count = std::floor(bins.constant() + .5);
  }
  if (!(count >= 1 && count <= kMostBins))
    throw rad::Error(
        fmt::format("unspecified or illegal bin count for modifier '{}': -bn N before -m, from 1 "
                    "to {:.0f}, for -b '{}'",
                    tracked.name, kMostBins, tracked.bin));
  return static_cast<uint32_t>(count);
}

void setDefaults(Options& options) {
  setContributionDefaults(options.ray);
  options.color.space = ColorSpace::spectrum;
}

void checkNames(const ContributionOptions& options) {
  if (options.tracked.empty())
    throw rad::Error("missing required modifier argument: -m names one that is tracked, -M a file of them");
  std::unordered_set<std::string_view> seen;
  for (const TrackedName& tracked : options.tracked)
    if (!seen.insert(tracked.name).second)
      throw rad::Error(fmt::format("duplicate modifier '{}'", tracked.name));
}

}  // namespace

bool ContributionOptions::hasErrors() const {
  return std::ranges::any_of(tracked, [](const TrackedName& t) { return !t.errors.empty(); });
}

std::vector<TrackedModifier> trackedModifiers(const ContributionOptions& options) {
  std::vector<TrackedModifier> modifiers;
  BinFunctions functions;
  double columns = 0;
  // As in RADIANCE, a file that cannot be read is an error even if no bin uses it.
  functions.load(options.next.definitions);
  for (const TrackedName& tracked : options.tracked) {
    const BinDefinitions all{options.next.definitions.shared, tracked.definitions.parameters};
    functions.load(all);
    std::optional<BinFunction> bin = binOf(tracked, all, functions);
    const uint32_t bins = bin ? binCountOf(tracked, functions) : 1;
    modifiers.push_back({tracked.name, bins, std::move(bin)});
    columns += bins;
  }
  if (columns > kMostBins)
    throw rad::Error(
        fmt::format("all modifiers together would have {:.0f} bins: at most {:.0f}; run rcontrib "
                    "several times, with some of the modifiers each",
                    columns, kMostBins));
  return modifiers;
}

std::vector<std::string> warningsOfUnused(const ContributionOptions& options) {
  std::vector<std::string> warnings;
  const TrackedName &next = options.next, &last = options.tracked.back();
  const auto compare = [&](std::string_view option, const std::string& given, const std::string& used) {
    if (given != used)
      warnings.push_back(fmt::format(
          "{} {} has no effect, because no -m or -M follows it: give it before the modifiers that it is for",
          option, given));
  };
  compare("-b", next.bin, last.bin);
  compare("-bn", next.bins, last.bins);
  compare("-p", next.definitions.parameters, last.definitions.parameters);
  compare("-o", next.output, last.output);
  compare("-oe", next.errors, last.errors);
  return warnings;
}

const Companion& contributionCompanion() {
  static const Companion companion{.own = kContributionOptions,
                                   .usage = "[options] { -m mod | -M file } ... octree < rays",
                                   .sphereMode = false,
                                   .defaults = setDefaults,
                                   .takes = takes,
                                   .features = kFeatures};
  return companion;
}

void finish(ContributionOptions& options) {
  limitToContributions(options.ray);
  options.numberedRays = options.ray.uncorrelated;
  if (options.request != Request::answers) return;
  checkNames(options);
  if (options.sphere.accuracy > 0 && options.raysPerRecord != 1)
    throw rad::Error("-Sa needs -c 1: the accuracy is that of each ray");
  if (options.recovers && options.overwrites) throw rad::Error("-r and -fo exclude each other");
  if (options.recovers && options.out == NumberFormat::ascii)
    throw rad::Error("-r needs binary output (-ff, -fd or -fac): records of text have no fixed length");
  if (options.recovers && options.raysPerRecord == 0)
    throw rad::Error("-r with -c 0 is not supported: add the results of runs with different -Sr instead");
}

}  // namespace rsphere
