#include "rcontrib/contribution_options.h"

#include <fmt/format.h>

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

using Add = std::function<void(const OptionEntry&)>;

void addTracking(const Add& add) {
  add({.name = "-m",
       .arguments = "mod",
       .value = Custom{setModifier},
       .remark = "tracked modifier",
       .paragraph =
           "Tracks surfaces with modifier mod: the light that they send along each path, or the coefficient "
           "of the path (-V), is added up. May be repeated; each record contains the modifiers in this "
           "order. A modifier that no surface has is a warning, and has zeros. The latest -p, -b, -bn and -o "
           "before it apply to it."});
  add({.name = "-M",
       .arguments = "file",
       .value = Custom{setModifierFile},
       .remark = "tracked modifiers of a file",
       .paragraph =
           "Like -m, for all modifiers in a file. They are separated by white space; quotes include it in a "
           "name, as in scenes. The file is searched for along RAYPATH."});
  add({.name = "-V",
       .value = +[](Options& o) -> bool& { return own(o).values; },
       .remark = "output contributions|output coefficients",
       .paragraph =
           "Toggles contributions instead of coefficients. A contribution is the part of the radiance "
           "(W/sr/m2), or of the irradiance (W/m2) under -i and -I, that comes from a modifier. A "
           "coefficient must be multiplied by the radiance of the modifier to obtain its contribution. "
           "Under -i and -I it contains a factor pi."});
  add({.name = "-c",
       .arguments = "count",
       .value = +[](Options& o) -> int& { return own(o).raysPerRecord; },
       .range = {0, 2147483647},
       .unit = "rays",
       .remark = "accumulated rays per record",
       .paragraph = "Number of rays whose mean is a record. 0 writes one record at the end of the input, the "
                    "sum over all rays."});
}

void addBins(const Add& add) {
  add({.name = "-b",
       .arguments = "bin",
       .value = +[](Options& o) -> std::string& { return own(o).next.bin; },
       .remark = "expression of the bin",
       .paragraph =
           "Expression of the number of the bin, from 0, to which a ray that meets the modifier is "
           "added; it is rounded. Px, Py and Pz are the point that the ray hits, Dx, Dy and Dz its unit "
           "direction, in the world; the other variables of function files may be used as well. Rays "
           "with a negative number are left out; so are those with a number of at least -bn, with a "
           "warning.",
       .line = noLine});
  add({.name = "-bn",
       .arguments = "count",
       .value = Custom{setBins},
       .remark = "number of bins",
       .paragraph =
           "Number of bins of a modifier, as an expression of the definitions by the -e, -f and -p before "
           "it. Required if the expression of -b is not constant. A constant expression of -b must be 0 and "
           "has one bin. All modifiers together have at most ten million bins, which take .7 GB."});
  add({.name = "-p",
       .arguments = "list",
       .value = +[](Options& o) -> std::string& { return own(o).next.definitions.parameters; },
       .remark = "parameters of the bin",
       .paragraph = "Parameters for -b and -bn: name=number, separated by commas, colons or semicolons. They "
                    "replace the parameters before them, and definitions of -e and -f by the same names.",
       .line = noLine});
  add({.name = "-e",
       .arguments = "text",
       .value = Custom{setExpression},
       .remark = "definitions for bins",
       .paragraph =
           "Adds definitions that -b and -bn may use: -e 'MF:4'. They have no effect on the scene."});
  add({.name = "-f",
       .arguments = "file",
       .value = Custom{setFunctions},
       .remark = "function file for bins",
       .paragraph =
           "Adds the definitions of a function file, such as reinhart.cal, that -b and -bn may use. "
           "The file is searched for along RAYPATH. A blank precedes its name, unlike the letters of "
           "formats."});
}

void addOutputs(const Add& add) {
  add({.name = "-o",
       .arguments = "spec",
       .value = +[](Options& o) -> std::string& { return own(o).next.output; },
       .remark = "output file",
       .paragraph =
           "File to which the contributions of the next modifiers are written instead of standard output. "
           "If spec begins with !, it is a command that reads them. %s in the name is replaced by the "
           "modifier, and %d (or %04d and the like) by the number of the bin, so that there is a separate "
           "file for each. In pictures (-fac with -x and -y) this number continues from one modifier to the "
           "next. Otherwise modifiers with equal file names share a file, side by side.",
       .line = noLine});
  add({.name = "-fo",
       .value = +[](Options& o) -> bool& { return own(o).overwrites; },
       .remark = "overwrite files|keep files",
       .paragraph = "Toggles overwriting: a file of -o that exists is replaced. Otherwise it is an error."});
  add({.name = "-r",
       .value = +[](Options& o) -> bool& { return own(o).recovers; },
       .remark = "recover files|start anew",
       .paragraph =
           "Toggles recovery: the existing files of -o are completed after the last record that all of them "
           "have, and the rays of the earlier records are read but not traced. The numbers are those of an "
           "uninterrupted run: the header of each file must have the options of this run, except for -n, -t, "
           "-w, -r and -fo. Not with text, nor with -c 0."});
}

// The features that -features lists in addition to those of all programs, in the words of RADIANCE's
// rcontrib.
constexpr std::string_view kFeatures[] = {
    "Hyperspectral",    "ShadowCache",        "Multiprocessing",       "Accumulation",
    "Summation",        "Recovery",           "ImmediateIrradiance",   "ProgressReporting",
    "DistanceLimiting", "InputFormats=a,f,d", "OutputFormats=a,f,d,c", "Outputs=V,W",
    "OutputCS=RGB,spec"};

// rcontrib has no options of sphere mode, of ray trees, or of the contents of records.
bool takes(const OptionEntry& entry) {
  if (entry.name == "-Sr" || entry.name == "-Sc" || entry.name == "-cs" || entry.name == "-cw") return true;
  const bool refused = entry.group == Group::sphere || entry.group == Group::trees ||
                       entry.group == Group::color || entry.name == "-o" || entry.name == "-P" ||
                       entry.name == "-PP" || (!entry.glued && (entry.name == "-f" || entry.name == "-e"));
  return !refused;
}

// A record with this number of bins takes .7 GB (measured).
constexpr double kMostBins = 1e7;

// Empty if the whole modifier is in bin 0.
std::optional<BinFunction> binOf(const TrackedName& tracked, BinFunctions& functions) {
  if (tracked.bin == "0") return std::nullopt;
  const BinFunction bin = functions.compile("-b", tracked.bin, tracked.definitions);
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

std::vector<TrackedModifier> trackedModifiers(const ContributionOptions& options) {
  std::vector<TrackedModifier> modifiers;
  BinFunctions functions;
  double columns = 0;
  // As in RADIANCE, a file that cannot be read is an error even if no bin uses it.
  functions.load(options.next.definitions);
  for (const TrackedName& tracked : options.tracked) {
    functions.load(tracked.definitions);
    std::optional<BinFunction> bin = binOf(tracked, functions);
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

const Companion& contributionCompanion() {
  static const std::vector<OptionEntry> table = [] {
    std::vector<OptionEntry> entries;
    for (const auto addOptions : {addTracking, addBins, addOutputs})
      addOptions([&entries](const OptionEntry& entry) { entries.push_back(entry); });
    for (OptionEntry& entry : entries) entry.group = Group::companion;
    return entries;
  }();
  static const Companion companion{.own = table,
                                   .usage = "[options] { -m mod | -M file } ... octree < rays",
                                   .sphereMode = false,
                                   .name = "rcontrib",
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
  if (options.recovers && options.overwrites) throw rad::Error("-r and -fo exclude each other");
  if (options.recovers && options.out == NumberFormat::ascii)
    throw rad::Error("-r needs binary output (-ff, -fd or -fac): records of text have no fixed length");
  if (options.recovers && options.raysPerRecord == 0)
    throw rad::Error("-r with -c 0 is not supported: add the results of runs with different -Sr instead");
}

}  // namespace rsphere
