#include "cli/option_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "cli/option_words.h"
#include "cli/word_file.h"
#include "rad_parser/error.h"
#include "rad_parser/number.h"
#include "rad_parser/printable.h"
#include "records/output_colors.h"

namespace rsphere {
namespace {

using OwnWords = std::span<const std::string>;  // the words after the name of an option

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLargestInt = std::numeric_limits<int>::max();
constexpr Range kNotNegative{0, kInfinity};
constexpr Range kFraction{0, 1};
constexpr Range kCount{0, kLargestInt};

// -ae and -aE name modifiers without indirect light; -ai and -aI name the only modifiers with it. -te, -tE,
// -ti and -tI include or exclude modifiers in ray trees. An option of one kind discards earlier names of the
// other kind.
void setModifiers(Options& options, const OptionEntry& entry, OwnWords words, std::string_view) {
  const bool ambient = entry.name[1] == 'a', exclude = entry.name[2] == 'e' || entry.name[2] == 'E';
  auto& excluded = ambient ? options.ray.ambientExcluded : options.treeExcluded;
  auto& included = ambient ? options.ray.ambientIncluded : options.treeIncluded;
  auto& list = exclude ? excluded : included;
  (exclude ? included : excluded).clear();
  if (entry.name[2] == 'e' || entry.name[2] == 'i') {
    list.push_back(words[0]);
  } else {
    const auto more = wordsOfFile(
        fmt::format("{} {} file", ambient ? "ambient" : "trace", exclude ? "exclude" : "include"), words[0]);
    list.insert(list.end(), more.begin(), more.end());
  }
}

void setFormat(Options& options, const OptionEntry& entry, OwnWords, std::string_view rest) {
  const auto isOneOf = [](char c, std::string_view letters) {
    return letters.find(c) != std::string_view::npos;
  };
  if (rest.empty() || rest.size() > 2 || !isOneOf(rest[0], "afd") ||
      (rest.size() == 2 && !isOneOf(rest[1], "afdc")))
    commandLineError(
        fmt::format("{}{}", entry.name, rest),
        "a letter for the input (a, f or d), or one for it and one for the output (a, f, d or c), "
        "follow without a blank");
  options.in = static_cast<NumberFormat>(rest[0]);
  options.out = static_cast<NumberFormat>(rest.back());
}

void setOutputs(Options& options, const OptionEntry&, OwnWords, std::string_view rest) {
  if (rest.empty())
    throw rad::Error("empty output specification: letters follow -o without a blank, as in -ov; see -help");
  options.outputs = rest;
}

void setTask(Options& options, const OptionEntry& entry, OwnWords words, std::string_view) {
  const auto number = [&](const std::string& word, double least, double most) {
    const auto x = rad::parseReal(word);
    if (!x) notReal(entry.name, word);
    if (*x < least || *x > most)
      commandLineError(entry.name, fmt::format("{} is not from {} to {} degrees", *x, least, most));
    return *x;
  };
  options.sphere.glare.taskBelow = number(words[0], -90, 90);
  options.sphere.glare.taskOpening = number(words[1], 0, 180);
}

std::string taskLine(const Options& o) {
  return fmt::format("-Sut {:g} {:g}\t\t\t", o.sphere.glare.taskBelow, o.sphere.glare.taskOpening);
}

void setThreads(Options& options, const OptionEntry& entry, OwnWords words, std::string_view) {
  const auto n = rad::parseInteger(words[0]);
  if (!n) notInteger(entry.name, words[0]);
  constexpr int kMostThreads = 4096;  // more than any machine has, so that a larger number is a typing error
  if (*n < 0 || *n > kMostThreads)
    throw rad::Error(fmt::format("bad number of processes: -n {} is not from 0 (one for each core) to {}", *n,
                                 kMostThreads));
  options.threads = static_cast<int>(*n);
}

void setWeights(Options& options, const OptionEntry& entry, OwnWords words, std::string_view) {
  const size_t i = words[0].size() == 1 ? kWeightsLetters.find(words[0][0]) : kWeightsLetters.npos;
  if (i == kWeightsLetters.npos)
    commandLineError(entry.name,
                     fmt::format("\"{}\" is not one of {}", words[0], fmt::join(kWeightsLetters, ", ")));
  options.sphere.weights = static_cast<Weights>(i);
}

void setRotation(Options& options, const OptionEntry& entry, OwnWords words, std::string_view) {
  const auto n = rad::parseInteger(words[0]);
  if (!n || *n < 0) notInteger(entry.name, words[0], " of at least 0");
  options.sphere.rotation = options.ray.rotation = static_cast<uint64_t>(*n);
}

// As in rtrace, the word after -e is an expression if it contains '=' or ':'; otherwise it is the name of an
// error file.
void setErrorFile(Options& options, const OptionEntry&, OwnWords words, std::string_view) {
  if (words[0].find_first_of("=:") != std::string::npos)
    options.ray.definitions.push_back({false, words[0]});
  else
    options.messages.errorFile = words[0];
}

void setFunctionFile(Options& options, const OptionEntry&, OwnWords words, std::string_view) {
  options.ray.definitions.push_back({true, words[0]});
}

// -SG names a file of sensors.
void setSensors(Options& options, const OptionEntry& entry, OwnWords words, std::string_view) {
  const std::string& file = words[0];
  std::vector<double> numbers;
  for (const std::string& word : wordsOfFile("sensor file", file)) {
    const auto number = rad::parseReal(word);
    if (!number)
      throw rad::Error(fmt::format("{}: sensor {}: \"{}\" is not a number", rad::printable(file),
                                   numbers.size() / 6 + 1, rad::printable(word)));
    numbers.push_back(*number);
  }
  if (numbers.empty() || numbers.size() % 6 != 0)
    commandLineError(entry.name,
                     fmt::format("\"{}\" has {} numbers; each sensor is x y z and the direction dx dy dz in "
                                 "which it faces",
                                 rad::printable(file), numbers.size()));
  for (const Sensor& sensor : sensorsOf(numbers, rad::printable(file))) options.sensors.push_back(sensor);
}

void ignore(Options&, const OptionEntry&, OwnWords, std::string_view) {}

constexpr std::array<std::pair<std::string_view, ColorSpace>, 6> kSpaces = {{{"-pRGB", ColorSpace::rgb},
                                                                             {"-pXYZ", ColorSpace::xyz},
                                                                             {"-pY", ColorSpace::photopic},
                                                                             {"-pS", ColorSpace::scotopic},
                                                                             {"-pM", ColorSpace::melanopic},
                                                                             {"-pA", ColorSpace::average}}};

void setColorSpace(Options& options, const OptionEntry& entry, OwnWords, std::string_view) {
  for (const auto& [name, space] : kSpaces)
    if (name == entry.name) options.color.space = space;
}

// The receptors of -pE by the symbols of CIE S 026, in the order of Receptor.
constexpr std::array<std::string_view, 5> kReceptors = {"sc", "mc", "lc", "rh", "mel"};

void setReceptor(Options& options, const OptionEntry& entry, OwnWords, std::string_view rest) {
  const auto found = std::ranges::find(kReceptors, rest);
  if (found == kReceptors.end())
    commandLineError(fmt::format("{}{}", entry.name, rest), "it is -pEsc, -pEmc, -pElc, -pErh or -pEmel");
  options.color.space = ColorSpace::edi;
  options.color.receptor = static_cast<Receptor>(found - kReceptors.begin());
}

std::string receptorLine(const Options& o) {
  if (o.color.space != ColorSpace::edi) return "";
  return fmt::format("-pE{}\t\t\t\t", kReceptors[static_cast<size_t>(o.color.receptor)]);
}

void setPrimaries(Options& options, const OptionEntry& entry, OwnWords words, std::string_view) {
  for (size_t i = 0; i < words.size(); ++i) {
    const auto x = rad::parseReal(words[i]);
    if (!x) notReal(entry.name, words[i]);
    options.color.primaries[i] = *x;
  }
  options.color.space = areStandard(options.color.primaries) ? ColorSpace::rgb : ColorSpace::primaries;
}

void setSpectralOutput(Options& options, const OptionEntry& entry, OwnWords, std::string_view rest) {
  const bool before = options.color.space == ColorSpace::spectrum;
  const auto on = switched(rest, before);
  if (!on) commandLineError(fmt::format("{}{}", entry.name, rest), "it is a switch: -co+ or -co-");
  if (*on != before) options.color.space = *on ? ColorSpace::spectrum : ColorSpace::rgb;
}

void setBands(Options& options, const OptionEntry& entry, OwnWords words, std::string_view) {
  const auto n = rad::parseInteger(words[0]);
  if (!n) notInteger(entry.name, words[0], fmt::format(" from 3 to {}", kMostBands));
  // As in rtrace, too many bands are not an error.
  if (*n > kMostBands)
    options.messages.remarks.push_back(
        fmt::format("{0} {1}: the range is 3 to {2}; {2} bands are used", entry.name, *n, kMostBands));
  options.color.bands =
      static_cast<int>(std::clamp<int64_t>(*n, std::numeric_limits<int>::min(), kMostBands));
}

void setWavelengths(Options& options, const OptionEntry& entry, OwnWords words, std::string_view) {
  const auto a = rad::parseReal(words[0]), b = rad::parseReal(words[1]);
  if (!a || !b) notReal(entry.name, words[a ? 1 : 0]);
  options.color.shortest = std::min(*a, *b);
  options.color.longest = std::max(*a, *b);
}

// -Sa has an accuracy and, after a comma, the least value to which it refers.
void setAccuracy(Options& options, const OptionEntry& entry, OwnWords words, std::string_view) {
  const std::string& word = words[0];
  const size_t comma = word.find(',');
  options.sphere.accuracy = realWord(entry, word.substr(0, comma));
  options.sphere.accuracyFloor = -1;
  if (comma == word.npos) return;
  if (options.sphere.accuracy == 0)
    commandLineError(entry.name,
                     fmt::format("\"{}\" has no accuracy: use a decimal point", rad::printable(word)));
  const auto floor = rad::parseReal(std::string_view(word).substr(comma + 1));
  if (!floor || *floor < 0) notReal(entry.name, word.substr(comma + 1), " of at least 0");
  options.sphere.accuracyFloor = *floor;
}

std::string accuracyLine(const Options& o) {
  if (o.sphere.accuracyFloor < 0) return fmt::format("-Sa {:<9g}\t\t\t", o.sphere.accuracy);
  return fmt::format("-Sa {:g},{:g}\t\t\t", o.sphere.accuracy, o.sphere.accuracyFloor);
}

std::string formatLine(const Options& o) {
  return fmt::format("-f{}{}\t\t\t\t", static_cast<char>(o.in), static_cast<char>(o.out));
}

std::string outputsLine(const Options& o) {
  const std::string_view tree = o.treeShadows ? "T" : o.treeOutputs.empty() ? "" : "t";
  return fmt::format("-o{:<9}\t\t\t", fmt::format("{}{}{}", o.outputs, tree, o.treeOutputs));
}

// The line of -defaults for an option that selects the color space: only the selected one is printed.
template <ColorSpace kSpace>
std::string spaceLine(const Options& o) {
  for (const auto& [name, space] : kSpaces)
    if (space == kSpace && o.color.space == space) return fmt::format("{}\t\t\t\t", name);
  return "";
}

std::string primariesLine(const Options& o) {
  if (o.color.space != ColorSpace::primaries) return "";
  std::string line = "-pc";
  for (const double x : o.color.primaries) line += fmt::format(" {:.4f}", x);
  return line + '\t';
}

bool printsSpectrum(const Options& o) {
  return o.color.bands > 3 && (o.color.space < ColorSpace::photopic || o.color.space > ColorSpace::average);
}

std::string spectralLine(const Options& o) {
  if (!printsSpectrum(o)) return "";
  return o.color.space == ColorSpace::spectrum ? "-co+\t\t\t\t" : "-co-\t\t\t\t";
}

std::string bandsLine(const Options& o) {
  return o.color.bands > 3 ? fmt::format("-cs {:<2}\t\t\t\t", o.color.bands) : "";
}

std::string wavelengthsLine(const Options& o) {
  return o.color.bands > 3 ? fmt::format("-cw {:3.0f} {:3.0f}\t\t\t", o.color.shortest, o.color.longest) : "";
}

std::string immediateLine(const Options& o) { return o.irradianceAtPoint ? "-I+\t\t\t\t" : ""; }

std::string weightsLine(const Options& o) {
  return fmt::format("-Sw {}\t\t\t\t", kWeightsLetters[static_cast<size_t>(o.sphere.weights)]);
}

using O = Options;
template <auto kMember>
auto& ray(Options& o) {
  return o.ray.*kMember;
}
template <auto kMember>
auto& sphere(Options& o) {
  return o.sphere.*kMember;
}

constexpr OptionExtras raysOnly(std::string_view elsewhere) {
  return {.mode = Mode::rays, .elsewhere = elsewhere};
}

constexpr std::string_view kPhotons = "photon maps are not read; -ab N -aa 0 computes indirect light";
constexpr std::string_view kNoTrees = "points have no ray trees";
constexpr std::string_view kPersist = "to keep a program waiting for records, use a pipe and -x 1";

// The order is that of rtrace's -defaults. Options of rtrace that its -defaults does not print follow, from
// -ap to -t.
constexpr OptionEntry kOptions[] = {
    {{"-w", "", "warning messages on|warning messages off", Group::program,
      +[](O& o) -> bool& { return o.messages.warnings; }}},
    {{"-I", "", "immediate irradiance on|immediate irradiance off", Group::records,
      of<&O::irradianceAtPoint>},
     {.help = "irradiance at sensors instead of radiance along rays",
      .mode = Mode::rays,
      .elsewhere = "in sphere mode -oE, -oC and -oH give irradiances",
      .line = immediateLine}},
    {{"-n", "N", "number of rendering processes", Group::program, Custom{setThreads}, kCount, "threads"},
     {.line = +[](const O& o) { return fmt::format("-n {:<2}\t\t\t\t", o.threads); }}},
    {{"-x", "res", "flush interval", Group::records, of<&O::width>, kCount, "records"},
     {.help = "answers written at a time; 0: whenever input pauses"}},
    {{"-y", "res", "y resolution", Group::records, of<&O::height>, kCount, "scanlines"},
     {.help = "scanlines of -x records; 0: all of the input"}},
    {{"-ld", "", "limit distance on|limit distance off", Group::records, of<&O::limitDistance>},
     raysOnly("points have no direction vector")},
    {{"-h", "", "output header|no header", Group::records, of<&O::header>}},
    {{"-f", "io", "format input/output", Group::records, Custom{setFormat}},
     {.help = "formats of input and output: a, f, d; output also c", .glued = true, .line = formatLine}},
    {{"-o", "spec", "output", Group::records, Custom{setOutputs}},
     {.help = "quantities of an answer, by letter", .glued = true, .line = outputsLine}},
    {{"-pRGB", "", "standard RGB color output", Group::color, Custom{setColorSpace}},
     {.line = spaceLine<ColorSpace::rgb>}},
    {{"-pXYZ", "", "CIE XYZ color output", Group::color, Custom{setColorSpace}},
     {.line = spaceLine<ColorSpace::xyz>}},
    {{"-pY", "", "photopic output", Group::color, Custom{setColorSpace}},
     {.line = spaceLine<ColorSpace::photopic>}},
    {{"-pS", "", "scotopic output", Group::color, Custom{setColorSpace}},
     {.line = spaceLine<ColorSpace::scotopic>}},
    {{"-pM", "", "melanopic output", Group::color, Custom{setColorSpace}},
     {.line = spaceLine<ColorSpace::melanopic>}},
    {{"-pE", "receptor", "equivalent daylight illuminance", Group::color, Custom{setReceptor}},
     {.help = "lux of daylight with equal effect: sc, mc, lc cones, rh rods, mel",
      .glued = true,
      .line = receptorLine}},
    {{"-pA", "", "radiometric average output", Group::color, Custom{setColorSpace}},
     {.line = spaceLine<ColorSpace::average>}},
    {{"-pc", "xr yr xg yg xb yb xw yw", "output color primaries and white point", Group::color,
      Custom{setPrimaries}, Range{-2, 3}},
     {.line = primariesLine}},
    {{"-co", "", "output spectral values", Group::color, Custom{setSpectralOutput}},
     {.glued = true, .line = spectralLine}},
    {{"-i", "", "irradiance calculation on|irradiance calculation off", Group::records,
      of<&O::irradianceAtHit>},
     raysOnly("in sphere mode -oE, -oC and -oH give irradiances")},
    {{"-u", "", "uncorrelated Monte Carlo sampling|correlated quasi-Monte Carlo sampling", Group::program,
      ray<&RayOptions::uncorrelated>},
     {.help = "new random numbers for a repeated ray",
      .mode = Mode::rays,
      .elsewhere = "a repeated point has the same answer; -Sr N selects other random numbers",
      .inEffect = +[](const O& o) { return o.numberedRays; }}},
    {{"-bv", "", "back face visibility on|back face visibility off", Group::program,
      ray<&RayOptions::backFacesVisible>}},
    {{"-dt", "frac", "direct threshold", Group::direct, ray<&RayOptions::directThreshold>, kNotNegative}},
    {{"-dc", "frac", "direct certainty", Group::direct, ray<&RayOptions::directCertainty>, kFraction}},
    {{"-dj", "frac", "direct jitter", Group::direct, ray<&RayOptions::directJitter>, kNotNegative}},
    {{"-ds", "frac", "direct sampling", Group::direct, ray<&RayOptions::sourceSubstructuring>, kNotNegative},
     {.help = "largest part of a light source, as size over distance"}},
    {{"-dr", "N", "direct relays", Group::direct, ray<&RayOptions::directRelays>, kCount, "reflections"},
     {.help = "most mirrors between a light source and a surface"}},
    {{"-dp", "D", "direct pretest density", Group::direct, ray<&RayOptions::directPretest>, kCount,
      "samples/sr"},
     {.support = Support::unused}},
    {{"-dv", "", "direct visibility on|direct visibility off", Group::direct,
      ray<&RayOptions::sourcesVisible>}},
    {{"-ss", "samp", "specular sampling", Group::specular, ray<&RayOptions::specularSampling>, kNotNegative},
     {.help = "rays that sample a rough highlight"}},
    {{"-st", "frac", "specular threshold", Group::specular, ray<&RayOptions::specularThreshold>,
      kNotNegative},
     {.help = "weaker highlights are not sampled"}},
    {{"-av", "red grn blu", "ambient value", Group::indirect,
      +[](O& o) -> Color& { return o.ray.ambientValue.color; }, kNotNegative, "W/sr/m2"}},
    {{"-aw", "N", "ambient value weight", Group::indirect, ray<&RayOptions::ambientWeight>, kCount},
     {.support = Support::unused}},
    {{"-ab", "N", "ambient bounces", Group::indirect, ray<&RayOptions::ambientBounces>, kCount, "bounces"}},
    {{"-aa", "acc", "ambient accuracy", Group::indirect, ray<&RayOptions::ambientAccuracy>, kNotNegative}},
    {{"-ar", "res", "ambient resolution", Group::indirect, ray<&RayOptions::ambientResolution>, kCount}},
    {{"-ad", "N", "ambient divisions", Group::indirect, ray<&RayOptions::ambientDivisions>, kCount, "rays"}},
    {{"-as", "N", "ambient super-samples", Group::indirect, ray<&RayOptions::ambientSuperSamples>, kCount,
      "rays"},
     {.help = "additional rays of a gather"}},
    {{"-me", "rext gext bext", "mist extinction coefficient", Group::medium,
      ray<&RayOptions::mediumExtinction>, kNotNegative, "1/length"},
     {.line =
          +[](const O& o) {
            const Color& c = o.ray.mediumExtinction;
            return fmt::format("-me {:.2e} {:.2e} {:.2e}\t", c.x, c.y, c.z);
          }}},
    {{"-ma", "ralb galb balb", "mist scattering albedo", Group::medium, ray<&RayOptions::mediumAlbedo>,
      kFraction}},
    {{"-mg", "gecc", "mist scattering eccentricity", Group::medium, ray<&RayOptions::mediumEccentricity>,
      Range{-1, 1}}},
    {{"-ms", "sampdist", "mist sampling distance", Group::medium, ray<&RayOptions::mediumSampling>,
      kNotNegative, "length"}},
    {{"-cs", "Ns", "number of spectral bins", Group::color, Custom{setBands}, Range{3, kMostBands}, "bands"},
     {.line = bandsLine}},
    {{"-cw", "nmA nmB", "wavelength limits (nm)", Group::color, Custom{setWavelengths}, kNotNegative, "nm"},
     {.line = wavelengthsLine}},
    {{"-lr", "N", "limit reflection", Group::limits, ray<&RayOptions::reflectionLimit>,
      Range{-kLargestInt, kLargestInt}, "reflections"},
     {.help = "most reflections; below 1, Russian roulette below -lw"}},
    {{"-lw", "frac", "limit weight", Group::limits, ray<&RayOptions::weightLimit>, kNotNegative},
     {.line = +[](const O& o) { return fmt::format("-lw {:.2e}\t\t\t", o.ray.weightLimit); }}},
    {{"-am", "frac", "max photon search radius", Group::indirect, of<&O::photonRadius>, kNotNegative,
      "length"},
     {.support = Support::unused,
      .line = +[](const O& o) { return fmt::format("-am {:.1f}\t\t\t\t", o.photonRadius); }}},
    {{"-ap", "file", "photon map", Group::indirect, Custom{ignore}},
     {.support = Support::refused, .reason = kPhotons}},
    {{"-ac", "pagesize", "photon cache page size", Group::indirect, Custom{ignore}, kNotNegative},
     {.support = Support::unused}},
    {{"-aC", "cachesize", "photon cache size", Group::indirect, Custom{ignore}},
     {.support = Support::unused}},
    {{"-af", "file", "ambient file", Group::indirect, ray<&RayOptions::ambientFile>}},
    {{"-ae", "mod", "modifier without indirect light", Group::indirect, Custom{setModifiers}}},
    {{"-aE", "file", "modifiers without indirect light", Group::indirect, Custom{setModifiers}}},
    {{"-ai", "mod", "modifier with indirect light", Group::indirect, Custom{setModifiers}}},
    {{"-aI", "file", "modifiers with indirect light", Group::indirect, Custom{setModifiers}}},
    {{"-te", "mod", "modifier left out of ray trees", Group::trees, Custom{setModifiers}},
     {.mode = Mode::rays, .elsewhere = kNoTrees, .alsoGlued = true}},
    {{"-ti", "mod", "modifier in ray trees", Group::trees, Custom{setModifiers}},
     {.mode = Mode::rays, .elsewhere = kNoTrees, .alsoGlued = true}},
    {{"-tE", "file", "modifiers left out of ray trees", Group::trees, Custom{setModifiers}},
     raysOnly(kNoTrees)},
    {{"-tI", "file", "modifiers in ray trees", Group::trees, Custom{setModifiers}}, raysOnly(kNoTrees)},
    {{"-f", "source", "function file", Group::program, Custom{setFunctionFile}}},
    {{"-e", "file", "error file", Group::program, Custom{setErrorFile}},
     {.line =
          +[](const O& o) {
            const std::string& file = o.messages.errorFile;
            return file.empty() ? "" : fmt::format("-e {}\t\t", file);
          }}},
    {{"-P", "pfile", "persistent mode", Group::program, Custom{ignore}},
     {.support = Support::refused, .reason = kPersist}},
    {{"-PP", "pfile", "persistent mode", Group::program, Custom{ignore}},
     {.support = Support::refused, .reason = kPersist}},
    {{"-t", "seconds", "progress report interval", Group::program, of<&O::progressSeconds>, kNotNegative,
      "s"}},
    {{"-S", "", "sphere mode on|sphere mode off (rays)", Group::sphere, of<&O::sphereMode>}},
    {{"-Sn", "N", "base directions of a point", Group::sphere, sphere<&SphereOptions::baseDirections>,
      Range{1, 1000000}, "directions"},
     pointsOnly("for rays, -ad is the number of indirect rays")},
    {{"-Sx", "N", "most directions of a point", Group::sphere, sphere<&SphereOptions::mostDirections>,
      Range{1, 4000000}, "directions"},
     pointsOnly()},
    {{"-Sk", "F", "factor on extra directions; 0: none", Group::sphere, sphere<&SphereOptions::densityFactor>,
      kNotNegative},
     pointsOnly()},
    {{"-Sa", "acc", "stop at this relative standard error; 0: off", Group::sphere, Custom{setAccuracy},
      kFraction},
     {.line = accuracyLine}},
    {{"-Sw", "letter", "weights: h equal, v Voronoi cells, c cells cut at silhouettes", Group::sphere,
      Custom{setWeights}},
     {.mode = Mode::points, .line = weightsLine}},
    // The quantities that sphere mode computes.
    {{"-Sg", "mod", "modifier of goals, which emit importance", Group::sphere, of<&O::goals>}},
    {{"-Sgc", "", "caustics of lamps at points on|caustics of lamps at points off", Group::sphere,
      ray<&RayOptions::caustics>},
     pointsOnly()},
    {{"-SG", "file", "file of sensors as goals", Group::sphere, Custom{setSensors}},
     pointsOnly("rays do not meet sensors")},
    {{"-Sp", "", "separate answers for each goal or lamp|sum over goals or lamps", Group::sphere,
      of<&O::separate>}},
    {{"-Sz", "N", "zones of equal solid angle; 0: none", Group::sphere, sphere<&SphereOptions::zones>,
      Range{0, 100000}},
     pointsOnly("for bins of rays, use rcontrib")},
    {{"-Szb", "bin", "bin of a direction, an expression", Group::sphere, sphere<&SphereOptions::zoneOf>},
     pointsOnly("for bins of rays, use rcontrib")},
    {{"-Szn", "count", "number of bins, an expression", Group::sphere, sphere<&SphereOptions::zoneCount>},
     pointsOnly()},
    {{"-So", "az", "azimuth that the half cylinder of -oS faces", Group::sphere,
      sphere<&SphereOptions::azimuth>, Range{-360, 360}, "degrees"},
     pointsOnly("rays have no semi-cylindrical irradiance")},
    {{"-Sb", "", "basic radiance on|basic radiance off", Group::sphere,
      sphere<&SphereOptions::basicRadiance>}},
    {{"-Sd", "", "a record for each direction|mean of directions", Group::sphere,
      sphere<&SphereOptions::everyDirection>},
     pointsOnly()},
    // Glare at an eye.
    {{"-Su", "", "glare at an eye|means at a point", Group::sphere,
      +[](O& o) -> bool& { return o.sphere.glare.wanted; }},
     pointsOnly()},
    {{"-Sub", "factor", "threshold of glare: cd/m2; up to 100: times the mean", Group::sphere,
      +[](O& o) -> double& { return o.sphere.glare.threshold; }, Range{.01, kInfinity}},
     pointsOnly()},
    {{"-Sut", "below opening", "task: degrees below the gaze, degrees wide", Group::sphere, Custom{setTask},
      Range{-90, 180}, "degrees"},
     {.mode = Mode::points, .line = taskLine}},
    // Options of rsphere that also apply in ray mode.
    {{"-Ss", "N", "light sources tested at a surface; 0: all", Group::sphere, ray<&RayOptions::chosenSources>,
      Range{0, 1e6}}},
    {{"-Sh", "N", "rays of the first gather for each that goes on", Group::indirect,
      ray<&RayOptions::firstRays>, Range{0, 1000}}},
    {{"-Sm", "MB", "memory of the irradiance cache; 0: no limit", Group::sphere,
      ray<&RayOptions::fieldMemory>, Range{0, 1e9}, "MB"}},
    {{"-Sr", "N", "number of the rotation and random numbers", Group::sphere, Custom{setRotation}, kCount},
     {.line = +[](const O& o) { return fmt::format("-Sr {:<9}\t\t\t", o.sphere.rotation); }}},
    {{"-Sc", "", "scene files may run commands|no commands in scene files", Group::sphere, of<&O::commands>}},
    {{"-Sf", "", "names of the columns in the header|no names of columns", Group::sphere,
      of<&O::namesColumns>}},
    // Options for examining how answers were obtained.
    {{"-Si", "pic", "picture of the view from each point", Group::sphere, of<&O::picture>},
     pointsOnly("for pictures of rays, use -fac with -x and -y")},
    {{"-Siw", "N", "width of pictures; 0: 1024, or 800 (fisheyes)", Group::sphere,
      +[](O& o) -> int& { return o.pictureForm.width; }, Range{0, 16384}, "pixels"},
     pointsOnly()},
    {{"-Siv", "vh", "horizontal angle of pictures in perspective; 0: all directions", Group::sphere,
      +[](O& o) -> double& { return o.pictureForm.viewAngle; }, Range{0, 170}, "degrees"},
     pointsOnly()},
    {{"-Sih", "az", "azimuth in the middle of pictures", Group::sphere,
      +[](O& o) -> double& { return o.pictureForm.heading; }, Range{-360, 360}, "degrees"},
     pointsOnly()},
    {{"-Sie", "cd", "luminance shown as white; 0: the eye adapts", Group::sphere,
      +[](O& o) -> double& { return o.pictureForm.white; }, kNotNegative, "cd/m2"},
     pointsOnly()},
    {{"-Sl", "", "list special objects|answers", Group::sphere, of<&O::listSpecial>}},
};

}  // namespace

std::span<const OptionEntry> optionTable() { return kOptions; }

int arity(const OptionEntry& entry) {
  if (entry.glued || entry.arguments.empty()) return 0;
  return 1 + static_cast<int>(std::ranges::count(entry.arguments, ' '));
}

// The direct light that thresholds leave out, and the light of highlights that are not sampled, would be
// missing in the stated errors. With -ds .2, long luminaires need 16 times the rays for the same error
// (tests/bench/rtrace/runs/2026-11-28-ray-errors.txt).
void setErrorDefaults(RayOptions& ray, bool reachAccuracy) {
  const RayOptions ofPoints = modeDefaults(true).ray;
  ray.directThreshold = ofPoints.directThreshold;
  ray.directJitter = ofPoints.directJitter;
  ray.specularThreshold = ofPoints.specularThreshold;
  ray.sourceSubstructuring = .05;
  if (!reachAccuracy) return;
  ray.ambientBounces = ofPoints.ambientBounces;
  ray.reflectionLimit = ofPoints.reflectionLimit;
  ray.directRelays = ofPoints.directRelays;
}

Options modeDefaults(bool sphereMode) {
  Options options;
  options.sphereMode = sphereMode;
  if (!sphereMode) return options;
  // The mean of thousands of unbiased directions needs few samples in each of them. By default, each
  // direction has four indirect paths, all light sources are sampled over their whole size, and all
  // highlights are followed. Measured in the open-plan office of examples (50 spheres, -ab 3):
  //   paths      rms error   time for a point
  //   1          .49%        69 ms
  //   4          .37%        161 ms
  //   9          .34%        331 ms
  options.ray.ambientDivisions = 4;
  options.ray.ambientSuperSamples = 0;
  options.ray.ambientAccuracy = 0;
  options.ray.leastForPatches = options.sphere.raysForPatches();
  options.ray.directJitter = 1;
  options.ray.directThreshold = 0;
  options.ray.specularThreshold = 0;
  // A tenth of rtrace's default. Because of Russian roulette, the mean is unbiased for any value; only noise
  // and time depend on it. Measured with -Sn 512 and 60 repeats:
  // - In the open-plan office (-ab 3), the rms error is .40 to .47% for all values from .1 down to 1e-6,
  //   without significant differences. The time is .4 to 1.1 times that of 1e-5.
  // - In a white room (reflectance .9, -ab 9), the rms error is .87% for .1, and .74% for .01 and below.
  // The default is small for the sake of scenes in which paths of little weight find something very bright.
  options.ray.weightLimit = 1e-5;
  // As many bounces as it takes: paths end by Russian roulette. Any lower limit makes the mean too small.
  options.ray.ambientBounces = RayOptions::kAllBounces;
  options.ray.reflectionLimit = -RayOptions::kAllBounces;
  options.ray.directRelays = RayOptions::kAllBounces;
  return options;
}

// At each pixel, a picture has a tenth of the rays of a gather for a cache record, and averages them over
// nearby pixels. Measured in the classroom of examples/daylight (-ab 8, 1024 x 512 pixels):
// - Rays of a gather: 32, in 10 s. With 16, blotches are visible on the ceiling beside the windows.
// - Patches: 1024 rays and an accuracy of .2, which are 61 rays for a usual patch. With 256, pale blobs on a
//   floor of roughness .02 are twice as strong: one in a hundred of its pixels exceeds the median around it
//   by 8 instead of 4%, in 10% less time.
// - Jitter: full, as for answers. With .6, the soft shadow of a lamp of .3 x 1 m has steps. Above .5, rays of
//   gathers do not divide luminaires into parts.
// - Lobes are sampled 8 times, and averaged over 60 pixels.
// - -dt as in ray mode: testing all shadows of 15 luminaires would take as long as all the rest.
//
// Patches that are only seen by other patches are four times as wide as usual, because single patches matter
// little for the light of second and later bounces. RADIANCE's office with -ab 4 takes 9 s instead of 20 s,
// and its mean is the same within .1%. With -ab 6 and patches of the usual width it takes 87 s and 1.1 GB,
// because nearly all possible patches of the room are created.
RayOptions pictureDefaults() {
  RayOptions ray = modeDefaults(true).ray;
  ray.ambientDivisions = 32;
  ray.ambientAccuracy = .2;
  ray.ambientResolution = 64;
  ray.leastForPatches = 1024;
  ray.coarserLinks = 2;
  ray.specularSampling = 8;
  ray.directThreshold = .03;
  ray.weightLimit = 1e-4;
  return ray;
}

}  // namespace rsphere
