#include "cli/option_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "cli/option_words.h"
#include "cli/word_file.h"
#include "rad_parser/error.h"
#include "rad_parser/number.h"
#include "rad_parser/printable.h"
#include "records/output_colors.h"

namespace rsphere {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLargestInt = std::numeric_limits<int>::max();
constexpr Range kNotNegative{0, kInfinity};
constexpr Range kFraction{0, 1};
constexpr Range kCount{0, kLargestInt};

// -ae and -aE name modifiers without indirect light; -ai and -aI name the only modifiers with it. -te, -tE,
// -ti and -tI include or exclude modifiers in ray trees. An option of one kind discards earlier names of the
// other kind.
void setModifiers(Options& options, const OptionEntry& entry, std::span<const std::string> words,
                  std::string_view) {
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

void setFormat(Options& options, const OptionEntry& entry, std::span<const std::string>,
               std::string_view rest) {
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

void setOutputs(Options& options, const OptionEntry&, std::span<const std::string>, std::string_view rest) {
  if (rest.empty())
    throw rad::Error("empty output specification: letters follow -o without a blank, as in -ov; see -help");
  options.outputs = rest;
}

void setTask(Options& options, const OptionEntry& entry, std::span<const std::string> words,
             std::string_view) {
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

void setThreads(Options& options, const OptionEntry& entry, std::span<const std::string> words,
                std::string_view) {
  const auto n = rad::parseInteger(words[0]);
  if (!n) notInteger(entry.name, words[0]);
  constexpr int kMostThreads = 4096;  // more than any machine has, so that a larger number is a typing error
  if (*n < 0 || *n > kMostThreads)
    throw rad::Error(fmt::format("bad number of processes: -n {} is not from 0 (one for each core) to {}", *n,
                                 kMostThreads));
  options.threads = static_cast<int>(*n);
}

void setWeights(Options& options, const OptionEntry& entry, std::span<const std::string> words,
                std::string_view) {
  if (words[0] == "h")
    options.sphere.weights = Weights::homogeneous;
  else if (words[0] == "v")
    options.sphere.weights = Weights::voronoi;
  else if (words[0] == "c")
    options.sphere.weights = Weights::silhouettes;
  else
    commandLineError(entry.name, fmt::format("\"{}\" is not h, v or c", words[0]));
}

void setRotation(Options& options, const OptionEntry& entry, std::span<const std::string> words,
                 std::string_view) {
  const auto n = rad::parseInteger(words[0]);
  if (!n || *n < 0) notInteger(entry.name, words[0], " of at least 0");
  options.sphere.rotation = options.ray.rotation = static_cast<uint64_t>(*n);
}

// As in rtrace, the word after -e is an expression if it contains '=' or ':'; otherwise it is the name of an
// error file.
void setErrorFile(Options& options, const OptionEntry&, std::span<const std::string> words,
                  std::string_view) {
  if (words[0].find_first_of("=:") != std::string::npos)
    options.ray.definitions.push_back({false, words[0]});
  else
    options.messages.errorFile = words[0];
}

void setFunctionFile(Options& options, const OptionEntry&, std::span<const std::string> words,
                     std::string_view) {
  options.ray.definitions.push_back({true, words[0]});
}

// -SG names a file of sensors.
void setSensors(Options& options, const OptionEntry& entry, std::span<const std::string> words,
                std::string_view) {
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

void ignore(Options&, const OptionEntry&, std::span<const std::string>, std::string_view) {}

struct NamedSpace {
  std::string_view name;
  ColorSpace space;
  std::string_view remark, paragraph;
};
constexpr std::array<NamedSpace, 6> kSpaces = {{
    {"-pRGB", ColorSpace::rgb, "standard RGB color output",
     "Colors as red, green and blue of RADIANCE's standard primaries. In a spectral run (-cs above 3) they "
     "are computed from CIE X, Y and Z; colors outside the gamut are mixed with gray until no channel is "
     "negative."},
    {"-pXYZ", ColorSpace::xyz, "CIE XYZ color output",
     "Colors as CIE X, Y and Z, times 179 lm/W: Y is luminance or illuminance."},
    {"-pY", ColorSpace::photopic, "photopic output",
     "One number for each color, its luminance: 179 lm/W times .265 red + .670 green + .065 blue, or times "
     "the integral of spectrum and V(lambda) in a spectral run."},
    {"-pS", ColorSpace::scotopic, "scotopic output",
     "One number for each color, its scotopic luminance, that of night vision (412 lm/W). Without a "
     "spectrum, red represents the wavelengths from 588 nm up, green those from 480 to 588 nm, and blue "
     "those below."},
    {"-pM", ColorSpace::melanopic, "melanopic output",
     "One number for each color, its melanopic luminance, with the channels as for -pS. It equals luminance "
     "for light of equal energy at all wavelengths (179 lm/W). Times .906 it is the melanopic equivalent "
     "daylight (D65) luminance of CIE S 026."},
    {"-pA", ColorSpace::average, "radiometric average output",
     "One number for each color: the mean of its channels or bands."},
}};

void setColorSpace(Options& options, const OptionEntry& entry, std::span<const std::string>,
                   std::string_view) {
  for (const NamedSpace& s : kSpaces)
    if (s.name == entry.name) options.color.space = s.space;
}

void setPrimaries(Options& options, const OptionEntry& entry, std::span<const std::string> words,
                  std::string_view) {
  for (size_t i = 0; i < words.size(); ++i) {
    const auto x = rad::parseReal(words[i]);
    if (!x) notReal(entry.name, words[i]);
    options.color.primaries[i] = *x;
  }
  options.color.space = areStandard(options.color.primaries) ? ColorSpace::rgb : ColorSpace::primaries;
}

void setSpectralOutput(Options& options, const OptionEntry& entry, std::span<const std::string>,
                       std::string_view rest) {
  const bool before = options.color.space == ColorSpace::spectrum;
  const auto on = switched(rest, before);
  if (!on) commandLineError(fmt::format("{}{}", entry.name, rest), "it is a switch: -co+ or -co-");
  if (*on != before) options.color.space = *on ? ColorSpace::spectrum : ColorSpace::rgb;
}

void setBands(Options& options, const OptionEntry& entry, std::span<const std::string> words,
              std::string_view) {
  const auto n = rad::parseInteger(words[0]);
  if (!n) notInteger(entry.name, words[0], fmt::format(" from 3 to {}", kMostBands));
  // As in rtrace, too many bands are not an error.
  if (*n > kMostBands)
    options.messages.remarks.push_back(
        fmt::format("{0} {1}: the range is 3 to {2}; {2} bands are used", entry.name, *n, kMostBands));
  options.color.bands =
      static_cast<int>(std::clamp<int64_t>(*n, std::numeric_limits<int>::min(), kMostBands));
}

void setWavelengths(Options& options, const OptionEntry& entry, std::span<const std::string> words,
                    std::string_view) {
  const auto a = rad::parseReal(words[0]), b = rad::parseReal(words[1]);
  if (!a || !b) notReal(entry.name, words[a ? 1 : 0]);
  options.color.shortest = std::min(*a, *b);
  options.color.longest = std::max(*a, *b);
}

std::string formatLine(const Options& o) {
  return fmt::format("-f{}{}\t\t\t\t", static_cast<char>(o.in), static_cast<char>(o.out));
}

std::string outputsLine(const Options& o) {
  const std::string_view tree = o.treeShadows ? "T" : o.treeOutputs.empty() ? "" : "t";
  return fmt::format("-o{:<9}\t\t\t", fmt::format("{}{}{}", o.outputs, tree, o.treeOutputs));
}

// The lines of -defaults for options that select the color space: only the selected one is printed.
template <size_t I>
std::string spaceLine(const Options& o) {
  return o.color.space == kSpaces[I].space ? fmt::format("{}\t\t\t\t", kSpaces[I].name) : "";
}
constexpr std::array<std::string (*)(const Options&), kSpaces.size()> kSpaceLines = {
    spaceLine<0>, spaceLine<1>, spaceLine<2>, spaceLine<3>, spaceLine<4>, spaceLine<5>};

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
  constexpr std::string_view kLetters = "hvc";
  return fmt::format("-Sw {}\t\t\t\t", kLetters[static_cast<size_t>(o.sphere.weights)]);
}

// Appends an option to the table.
using Add = std::function<void(const OptionEntry&)>;
using O = Options;

void addRecordOptions(const Add& add) {
  add({.name = "-w",
       .group = Group::program,
       .value = +[](O& o) -> bool& { return o.messages.warnings; },
       .remark = "warning messages on|warning messages off",
       .paragraph =
           "Toggles warnings. A warning reports something unusual that does not prevent an answer."});
  add({.name = "-I",
       .group = Group::records,
       .value = +[](O& o) -> bool& { return o.irradianceAtPoint; },
       .remark = "immediate irradiance on|immediate irradiance off",
       .mode = Mode::rays,
       .elsewhere = "in sphere mode -oE, -oC and -oH give irradiances",
       .paragraph =
           "Toggles irradiance (W/m2) at a sensor: the origin of each ray is the place of the sensor, and "
           "its direction is the direction in which the sensor looks. As in rtrace, the ray is traced "
           "from 1.1e-4 units above the sensor, and -oo and -od print this ray. Ray mode only; in sphere "
           "mode -oH, -oC and -oE give irradiances.",
       .line = immediateLine});
  add({.name = "-n",
       .arguments = "N",
       .group = Group::program,
       .value = Custom{setThreads},
       .range = kCount,
       .unit = "threads",
       .remark = "number of rendering processes",
       .paragraph =
           "Answers records on N threads; 0 starts one for each core. If the system cannot start that many, "
           "there is a warning and the program uses fewer. The answers do not depend on N. On a machine "
           "with several NUMA nodes, the scene is in the memory of one of them. It can then be faster to "
           "run one process for each node, bound to it by numactl(8), each with a part of the records.",
       .line = +[](const O& o) { return fmt::format("-n {:<2}\t\t\t\t", o.threads); }});
  add({.name = "-x",
       .arguments = "res",
       .group = Group::records,
       .value = +[](O& o) -> int64_t& { return o.width; },
       .range = kCount,
       .unit = "records",
       .remark = "flush interval",
       .help = "answers written at a time; 0: whenever input pauses",
       .paragraph =
           "Number of records in a scanline. If -y is 0, answers are written after every res records, and "
           "only then. With -x 1 they are written after every record, whatever -y is. With -x 0 they are "
           "written whenever the program has to wait for input."});
  add({.name = "-y",
       .arguments = "res",
       .group = Group::records,
       .value = +[](O& o) -> int64_t& { return o.height; },
       .range = kCount,
       .unit = "scanlines",
       .remark = "y resolution",
       .paragraph =
           "Stops after res scanlines of -x records each (of one record each if -x is 0). With 0 the "
           "program continues to the end of the input. If both -x and -y are given, a resolution line "
           "precedes the records, even without a header."});
  add({.name = "-ld",
       .group = Group::records,
       .value = +[](O& o) -> bool& { return o.limitDistance; },
       .remark = "limit distance on|limit distance off",
       .mode = Mode::rays,
       .elsewhere = "points have no direction vector",
       .paragraph =
           "Toggles limited rays: each ray ends at the length of its direction vector. Ray mode only."});
  add({.name = "-h",
       .group = Group::records,
       .value = +[](O& o) -> bool& { return o.header; },
       .remark = "output header|no header",
       .paragraph = "Toggles the information header before the records."});
}

void addFormatOptions(const Add& add) {
  add({.name = "-f",
       .arguments = "io",
       .group = Group::records,
       .value = Custom{setFormat},
       .remark = "format input/output",
       .paragraph =
           "Formats of the input (i) and of the output (o): a is text, f is floats and d is doubles as "
           "this machine stores them. c, for output only, is RADIANCE's pixel of 4 bytes and requires a "
           "single color letter in -o. A single letter sets both formats. No blank precedes io.",
       .glued = true,
       .line = formatLine});
  add({.name = "-o",
       .arguments = "spec",
       .group = Group::records,
       .value = Custom{setOutputs},
       .remark = "output",
       .paragraph =
           "Contents of an output record: one letter for each quantity, in the order of output; see "
           "OUTPUT. In ray mode, the letters after a t are written for every ray of the tree that leads "
           "to the answer: reflected, transmitted and indirect rays, and shadow rays that pass through "
           "something. A T instead of the t includes all shadow rays. No blank precedes spec.",
       .glued = true,
       .line = outputsLine});
}

void addColorOptions(const Add& add) {
  for (size_t i = 0; i < kSpaces.size(); ++i)
    add({.name = kSpaces[i].name,
         .group = Group::color,
         .value = Custom{setColorSpace},
         .remark = kSpaces[i].remark,
         .paragraph = kSpaces[i].paragraph,
         .line = kSpaceLines[i]});
  add({.name = "-pc",
       .arguments = "xr yr xg yg xb yb xw yw",
       .group = Group::color,
       .value = Custom{setPrimaries},
       .range = {-2, 3},
       .remark = "output color primaries and white point",
       .paragraph =
           "Colors as red, green and blue of the given primaries (CIE x and y of each), adapted to the "
           "given white point.",
       .line = primariesLine});
  add({.name = "-co",
       .group = Group::color,
       .value = Custom{setSpectralOutput},
       .remark = "output spectral values",
       .paragraph =
           "Toggles spectral output: each color is written as one number for each band of -cs, from the "
           "longest wavelength to the shortest. A color that the scene gives as red, green and blue has in "
           "each band the value of the band's channel (see -pS). With three bands, red, green and blue are "
           "written instead of a spectrum. -fac writes the pixels of a hyperspectral picture, with a common "
           "exponent for all bands.",
       .glued = true,
       .line = spectralLine});
}

void addRayOptions(const Add& add) {
  add({.name = "-i",
       .group = Group::records,
       .value = +[](O& o) -> bool& { return o.irradianceAtHit; },
       .remark = "irradiance calculation on|irradiance calculation off",
       .mode = Mode::rays,
       .elsewhere = "in sphere mode -oE, -oC and -oH give irradiances",
       .paragraph =
           "Toggles the irradiance (W/m2) of the surface that a ray hits, instead of the radiance (W/sr/m2) "
           "that the surface sends back along the ray. Rays pass through glass and similar materials as if "
           "these did not exist. Light sources keep their radiance (see -dv). Ray mode only."});
  add({.name = "-u",
       .group = Group::program,
       .value = +[](O& o) -> bool& { return o.ray.uncorrelated; },
       .remark = "uncorrelated Monte Carlo sampling|correlated quasi-Monte Carlo sampling",
       .mode = Mode::rays,
       .elsewhere = "a repeated point has the same answer; -Sr N selects other random numbers",
       .paragraph =
           "Toggles different random numbers for a ray that is repeated. With -u+, the random numbers of a "
           "ray depend on its number in the input as well as on the ray itself, so that the mean of the "
           "answers to a repeated ray has less variance than a single answer. Otherwise they depend only on "
           "the ray, so that a repeated ray always has the same answer; in rtrace its answers always "
           "differ. Nevertheless -defaults prints -u+, as rtrace does, because programs read it. In both "
           "cases the answers do not depend on -n, and interpolated indirect light (-aa above 0) is the "
           "same for repeated rays. All samples are random; quasi-random sequences are not used. Ray mode "
           "only.",
       .inEffect = +[](const O& o) { return o.numberedRays; }});
  add({.name = "-bv",
       .group = Group::program,
       .value = +[](O& o) -> bool& { return o.ray.backFacesVisible; },
       .remark = "back face visibility on|back face visibility off",
       .paragraph = "Toggles the visibility of the back faces of surfaces."});
}

void addShadowOptions(const Add& add) {
  add({.name = "-dt",
       .arguments = "frac",
       .group = Group::direct,
       .value = +[](O& o) -> double& { return o.ray.directThreshold; },
       .range = kNotNegative,
       .remark = "direct threshold",
       .paragraph =
           "Threshold of shadow testing. Light sources are tested for shadows until the remaining ones "
           "could add less than this fraction of the light found so far. The light of the untested sources "
           "is estimated from the fraction of earlier tests in which sources were visible. After a diffuse "
           "bounce, one randomly drawn source represents the untested ones, which keeps means unbiased. 0 "
           "tests all sources."});
  add({.name = "-dc",
       .arguments = "frac",
       .group = Group::direct,
       .value = +[](O& o) -> double& { return o.ray.directCertainty; },
       .range = kFraction,
       .remark = "direct certainty",
       .paragraph =
           "Certainty of -dt. With 1, the error of the sum of all light sources stays below -dt; with 0, "
           "only the error at any single shadow edge does."});
}

void addSourceOptions(const Add& add) {
  add({.name = "-dj",
       .arguments = "frac",
       .group = Group::direct,
       .value = +[](O& o) -> double& { return o.ray.directJitter; },
       .range = kNotNegative,
       .remark = "direct jitter",
       .paragraph =
           "Jitter of shadow rays. 0 aims them at the middle of each part of a light source (see -ds), 1 "
           "at random points of the whole part. Values above 1 have no use."});
  add({.name = "-ds",
       .arguments = "frac",
       .group = Group::direct,
       .value = +[](O& o) -> double& { return o.ray.sourceSubstructuring; },
       .range = kNotNegative,
       .remark = "direct sampling",
       .paragraph =
           "Light sources are divided into parts until the size of each part is below this fraction of its "
           "distance. 0 leaves light sources undivided. Balls are divided only in ray mode, for rays that "
           "have not been reflected diffusely, and with -dj above 0."});
  add({.name = "-dr",
       .arguments = "N",
       .group = Group::direct,
       .value = +[](O& o) -> int& { return o.ray.directRelays; },
       .range = kCount,
       .unit = "reflections",
       .remark = "direct relays",
       .help = "most mirrors between a light source and a surface",
       .paragraph =
           "Largest number of successive plane surfaces of mirror, prism1 or prism2 through which "
           "next-event estimation reaches a light source. Each such surface forms a virtual source of every "
           "source that is visible from it. 0 disables virtual sources."});
  add({.name = "-dp",
       .arguments = "D",
       .group = Group::direct,
       .value = +[](O& o) -> int& { return o.ray.directPretest; },
       .range = kCount,
       .unit = "samples/sr",
       .remark = "direct pretest density",
       .paragraph =
           "Accepted without effect. In rtrace it is the density of rays that test in advance whether a "
           "virtual source is visible from any place, or from everywhere. Here every virtual source that "
           "geometry does not rule out is tested, as with 0.",
       .support = Support::unused});
  add({.name = "-dv",
       .group = Group::direct,
       .value = +[](O& o) -> bool& { return o.ray.sourcesVisible; },
       .remark = "direct visibility on|direct visibility off",
       .paragraph = "Toggles the direct visibility of light sources. When it is off, a ray that hits a light "
                    "source finds it black, but the sources still light the scene."});
}

void addSpecularOptions(const Add& add) {
  add({.name = "-ss",
       .arguments = "samp",
       .group = Group::specular,
       .value = +[](O& o) -> double& { return o.ray.specularSampling; },
       .range = kNotNegative,
       .remark = "specular sampling",
       .paragraph = "Number of rays that sample a rough highlight. A value below 1 sends one ray and is the "
                    "fraction of the width of the highlight over which this ray is jittered. 0 makes every "
                    "highlight sharp."});
  add({.name = "-st",
       .arguments = "frac",
       .group = Group::specular,
       .value = +[](O& o) -> double& { return o.ray.specularThreshold; },
       .range = kNotNegative,
       .remark = "specular threshold",
       .paragraph =
           "Threshold of specular reflectance and transmittance. Below it a material sends no specular "
           "rays, and its highlight is treated as part of the indirect light instead. 0 always sends "
           "rays, 1 never does."});
}

void addAmbientOptions(const Add& add) {
  add({.name = "-av",
       .arguments = "red grn blu",
       .group = Group::indirect,
       .value = +[](O& o) -> Color& { return o.ray.ambientValue.color; },
       .range = kNotNegative,
       .unit = "W/sr/m2",
       .remark = "ambient value",
       .paragraph = "Radiance that replaces indirect light that is not computed."});
  add({.name = "-aw",
       .arguments = "N",
       .group = Group::indirect,
       .value = +[](O& o) -> int& { return o.ray.ambientWeight; },
       .range = kCount,
       .remark = "ambient value weight",
       .paragraph =
           "Accepted without effect. rtrace gradually replaces the ambient value by the mean of the "
           "indirect light that it has computed. Here an answer does not depend on those before it, and "
           "the ambient value remains that of -av.",
       .support = Support::unused});
  add({.name = "-ab",
       .arguments = "N",
       .group = Group::indirect,
       .value = +[](O& o) -> int& { return o.ray.ambientBounces; },
       .range = kCount,
       .unit = "bounces",
       .remark = "ambient bounces",
       .paragraph = "Largest number of diffuse bounces of an indirect path. 0 disables indirect light."});
}

void addGatheringOptions(const Add& add) {
  add({.name = "-aa",
       .arguments = "acc",
       .group = Group::indirect,
       .value = +[](O& o) -> double& { return o.ray.ambientAccuracy; },
       .range = kNotNegative,
       .remark = "ambient accuracy",
       .paragraph =
           "Relative error that the interpolation of indirect light may add; see Interpolation. 0 disables "
           "the irradiance cache and the coarse solution, and each path gathers indirect light again. This "
           "is faster for a few rays or points in a detailed scene: interpolation begins with up to "
           "seconds of work there, because no answer may depend on the number of records. For sensors "
           "(-I), interpolation is faster from 3 to 10 sensors on in daylit rooms, and from 50 to 100 on "
           "with luminaires. In sphere mode, it is faster from 10 to 100 points on by daylight, and has "
           "no effect where light paths from lamps are used (see -Sw): the program then computes no "
           "coarse solution, because light paths take less time for the same error."});
  add({.name = "-ar",
       .arguments = "res",
       .group = Group::indirect,
       .value = +[](O& o) -> int& { return o.ray.ambientResolution; },
       .range = kCount,
       .remark = "ambient resolution",
       .paragraph =
           "Finest resolution of the irradiance cache. The smallest spacing of cache records is about the "
           "size of the room around them times -aa (at most .5), divided by res. The size of the room is "
           "estimated from the distances to the surfaces visible from a record, so that a wide ground does "
           "not make the spacing coarser. It is at most the size of the scene, which rtrace uses. In narrow "
           "gaps, and where an obstacle hides cache records from the place that needs them, the spacing is "
           "smaller. Smaller detail of the indirect light is blurred. 0 sets no limit."});
  add({.name = "-ad",
       .arguments = "N",
       .group = Group::indirect,
       .value = +[](O& o) -> int& { return o.ray.ambientDivisions; },
       .range = kCount,
       .unit = "rays",
       .remark = "ambient divisions",
       .paragraph =
           "Number of stratified rays over the hemisphere that gather indirect light. They start at the "
           "first diffuse surface of a path or, with interpolation, at each cache record. A path of less "
           "weight gathers with fewer rays. A cache record gathers with all of them, or with 7.5 / -aa^2 if "
           "that is fewer and shadow rays find all light (lamps alone, without glow), but at least with half "
           "of them: its noise is then no larger than the error that -aa allows. The noise falls "
           "approximately with the square root of their number. 0 disables indirect light."});
  add({.name = "-as",
       .arguments = "N",
       .group = Group::indirect,
       .value = +[](O& o) -> int& { return o.ray.ambientSuperSamples; },
       .range = kCount,
       .unit = "rays",
       .remark = "ambient super-samples",
       .paragraph =
           "Number of rays that are added to those of -ad. All of them together are stratified over the "
           "hemisphere. Unlike in rtrace, the directions of these rays do not depend on the light found by "
           "other rays. With interpolation (-aa above 0), a sensor of -I adds up to 24 times as many "
           "where its gather is noisy, as behind blinds and below skylights in shafts: until the estimated "
           "standard error is a twelfth of -aa. The noise of each half of the rays decides how many are "
           "added to the other half, which adds no bias. 0 adds none."});
}

void addMediumOptions(const Add& add) {
  add({.name = "-me",
       .arguments = "rext gext bext",
       .group = Group::medium,
       .value = +[](O& o) -> Color& { return o.ray.mediumExtinction; },
       .range = kNotNegative,
       .unit = "1/length",
       .remark = "mist extinction coefficient",
       .paragraph =
           "Extinction coefficient of a medium that fills the scene. The medium scatters the light of "
           "those sources that a mist material names.",
       .line =
           +[](const O& o) {
             const Color& c = o.ray.mediumExtinction;
             return fmt::format("-me {:.2e} {:.2e} {:.2e}\t", c.x, c.y, c.z);
           }});
  add({.name = "-ma",
       .arguments = "ralb galb balb",
       .group = Group::medium,
       .value = +[](O& o) -> Color& { return o.ray.mediumAlbedo; },
       .range = kFraction,
       .remark = "mist scattering albedo",
       .paragraph =
           "Scattering albedo: the share of the extinction that is scattered; the rest is absorbed. For "
           "the indirect light that the medium scatters, the value of -av is used."});
  add({.name = "-mg",
       .arguments = "gecc",
       .group = Group::medium,
       .value = +[](O& o) -> double& { return o.ray.mediumEccentricity; },
       .range = {-1, 1},
       .remark = "mist scattering eccentricity",
       .paragraph =
           "Eccentricity g of the Henyey-Greenstein phase function. 0 scatters evenly in all directions, "
           "and values near 1 scatter forward. Values below 0 are replaced by 0."});
  add({.name = "-ms",
       .arguments = "sampdist",
       .group = Group::medium,
       .value = +[](O& o) -> double& { return o.ray.mediumSampling; },
       .range = kNotNegative,
       .unit = "length",
       .remark = "mist sampling distance",
       .paragraph =
           "Length of a ray through mist for which each light source is sampled once. A ray takes at most "
           "16 samples. 0 takes one sample for the whole ray."});
}

void addSpectrumOptions(const Add& add) {
  add({.name = "-cs",
       .arguments = "Ns",
       .group = Group::color,
       .value = Custom{setBands},
       .range = {3, kMostBands},
       .unit = "bands",
       .remark = "number of spectral bins",
       .paragraph =
           "Number of bands of equal width in which light is computed, at most 24. With more than three, "
           "all output is computed from the bands: see -co and -pRGB. Spectral patterns (spectrum, "
           "specfile, specfunc, specdata, specpict) need them: in three channels they become red, green and "
           "blue by the CIE's observer, and products of spectra are approximate. See Spectra.",
       .line = bandsLine});
  add({.name = "-cw",
       .arguments = "nmA nmB",
       .group = Group::color,
       .value = Custom{setWavelengths},
       .range = kNotNegative,
       .unit = "nm",
       .remark = "wavelength limits (nm)",
       .paragraph =
           "Limits of the spectrum that -cs divides: at least 0, and at least 50 nm apart. Light outside "
           "them is ignored. Default: 380 and 780.",
       .line = wavelengthsLine});
}

void addLimitOptions(const Add& add) {
  add({.name = "-lr",
       .arguments = "N",
       .group = Group::limits,
       .value = +[](O& o) -> int& { return o.ray.reflectionLimit; },
       .range = {-kLargestInt, kLargestInt},
       .unit = "reflections",
       .remark = "limit reflection",
       .paragraph =
           "Largest number of reflections of a path. If N is positive, paths whose weight falls below -lw "
           "end. If N is negative, Russian roulette decides whether they continue, for at most |N| "
           "reflections. If N is 0, Russian roulette decides and there is no limit. Russian roulette "
           "requires -lw above 0."});
  add({.name = "-lw",
       .arguments = "frac",
       .group = Group::limits,
       .value = +[](O& o) -> double& { return o.ray.weightLimit; },
       .range = kNotNegative,
       .remark = "limit weight",
       .paragraph =
           "Smallest weight of a ray; see -lr. If indirect light is interpolated (-aa above 0), each "
           "diffuse reflection halves the weight regardless of the reflectance, as in rtrace. The coarse "
           "solution of later bounces applies the limits of -lr and -lw as if each bounce were such a ray.",
       .line = +[](const O& o) { return fmt::format("-lw {:.2e}\t\t\t", o.ray.weightLimit); }});
}

void addPhotonOptions(const Add& add) {
  constexpr std::string_view kPhotons = "photon maps are not read; -ab N -aa 0 computes indirect light";
  add({.name = "-am",
       .arguments = "frac",
       .group = Group::indirect,
       .value = +[](O& o) -> double& { return o.photonRadius; },
       .range = kNotNegative,
       .unit = "length",
       .remark = "max photon search radius",
       .paragraph = "Accepted without effect, because it concerns photon maps only.",
       .support = Support::unused,
       .line = +[](const O& o) { return fmt::format("-am {:.1f}\t\t\t\t", o.photonRadius); }});

  add({.name = "-ap",
       .arguments = "file",
       .group = Group::indirect,
       .value = Custom{ignore},
       .remark = "photon map",
       .paragraph = "Photon map, with one or two bandwidths.",
       .support = Support::refused,
       .reason = kPhotons});
  add({.name = "-ac",
       .arguments = "pagesize",
       .group = Group::indirect,
       .value = Custom{ignore},
       .range = kNotNegative,
       .remark = "photon cache page size",
       .paragraph = "Accepted without effect, because it concerns photon maps only.",
       .support = Support::unused});
  add({.name = "-aC",
       .arguments = "cachesize",
       .group = Group::indirect,
       .value = Custom{ignore},
       .remark = "photon cache size",
       .paragraph = "Accepted without effect, because it concerns photon maps only.",
       .support = Support::unused});
}

void addModifierOptions(const Add& add) {
  add({.name = "-af",
       .arguments = "file",
       .group = Group::indirect,
       .value = +[](O& o) -> std::string& { return o.ray.ambientFile; },
       .remark = "ambient file",
       .paragraph =
           "Stores the irradiance cache in a file beside the one named here, file.rsphere. The program "
           "reads it at the start, adds new cache records to it from time to time and at the end, and "
           "shares it with other processes that run at the same time. A process that is killed does not "
           "damage it. The file saves time and changes no answer. It does not contain the coarse solution "
           "of later bounces. In sphere mode and with -I there is nothing to store. If file.rsphere was "
           "made for another scene, with other options or by another version, there is a warning, and it is "
           "neither used nor changed. The file named here may be an ambient file of RADIANCE's own "
           "programs: it is neither read nor written, so that one name can serve both. Requires -aa and -ab "
           "above 0."});
  add({.name = "-ae",
       .arguments = "mod",
       .group = Group::indirect,
       .value = Custom{setModifiers},
       .remark = "modifier without indirect light",
       .paragraph = "Surfaces with modifier mod receive the ambient value (-av) instead of computed indirect "
                    "light. May be repeated. A later -ai or -aI discards the list."});
  add({.name = "-aE",
       .arguments = "file",
       .group = Group::indirect,
       .value = Custom{setModifiers},
       .remark = "modifiers without indirect light",
       .paragraph = "Like -ae, for all modifiers in a file. They are separated by white space. The file is "
                    "searched for along RAYPATH."});
  add({.name = "-ai",
       .arguments = "mod",
       .group = Group::indirect,
       .value = Custom{setModifiers},
       .remark = "modifier with indirect light",
       .paragraph =
           "Only surfaces with modifier mod receive computed indirect light. May be repeated for several "
           "modifiers. A later -ae or -aE discards the list."});
  add({.name = "-aI",
       .arguments = "file",
       .group = Group::indirect,
       .value = Custom{setModifiers},
       .remark = "modifiers with indirect light",
       .paragraph = "Like -ai, for all modifiers in a file. They are separated by white space. The file is "
                    "searched for along RAYPATH."});
}

void addTreeOptions(const Add& add) {
  for (const std::string_view name : {"-te", "-ti"})
    add({.name = name,
         .arguments = "mod",
         .group = Group::trees,
         .value = Custom{setModifiers},
         .remark = name == "-te" ? "modifier left out of ray trees" : "modifier in ray trees",
         .mode = Mode::rays,
         .elsewhere = "points have no ray trees",
         .paragraph = name == "-te"
                          ? "Leaves rays that hit a surface with modifier mod out of the trees of -ot and "
                            "-oT. May be repeated. A later -ti or -tI discards the list. The blank "
                            "before mod may be omitted."
                          : "Shows only rays that hit a surface with modifier mod in the trees of -ot and "
                            "-oT. May be repeated. A later -te or -tE discards the list. The blank "
                            "before mod may be omitted.",
         .alsoGlued = true});
  for (const std::string_view name : {"-tE", "-tI"})
    add({.name = name,
         .arguments = "file",
         .group = Group::trees,
         .value = Custom{setModifiers},
         .remark = name == "-tE" ? "modifiers left out of ray trees" : "modifiers in ray trees",
         .mode = Mode::rays,
         .elsewhere = "points have no ray trees",
         .paragraph = name == "-tE"
                          ? "Like -te, for all modifiers in a file. They are separated by white space. "
                            "The file is searched for along RAYPATH."
                          : "Like -ti, for all modifiers in a file. They are separated by white space. "
                            "The file is searched for along RAYPATH."});
}

void addProgramOptions(const Add& add) {
  constexpr std::string_view kPersist = "to keep a program waiting for records, use a pipe and -x 1";
  add({.name = "-f",
       .arguments = "source",
       .group = Group::program,
       .value = Custom{setFunctionFile},
       .remark = "function file",
       .paragraph =
           "Adds the definitions of the function file source to those that all function files share. They "
           "replace definitions of rayinit.cal by the same names. The file is searched for along RAYPATH."});
  add({.name = "-e",
       .arguments = "file",
       .group = Group::program,
       .value = Custom{setErrorFile},
       .remark = "error file",
       .paragraph =
           "Appends messages to the file, after the process id and the command line, instead of writing "
           "them to standard error. A word that contains = or : is not a file name but a list of "
           "definitions, like those of -f: -e 'height=2;x(a):a*height'.",
       .line = +[](const O& o) {
         const std::string& file = o.messages.errorFile;
         return file.empty() ? "" : fmt::format("-e {}\t\t", file);
       }});
  for (const std::string_view name : {"-P", "-PP"})
    add({.name = name,
         .arguments = "pfile",
         .group = Group::program,
         .value = Custom{ignore},
         .remark = "persistent mode",
         .paragraph = "Persistent mode: a process that continues after the end of its input.",
         .support = Support::refused,
         .reason = kPersist});
  add({.name = "-t",
       .arguments = "seconds",
       .group = Group::program,
       .value = +[](O& o) -> double& { return o.progressSeconds; },
       .range = kNotNegative,
       .unit = "s",
       .remark = "progress report interval",
       .paragraph =
           "Interval of progress reports on standard error. A report gives the number of answered records, "
           "the records per second and, if the end of the input is known (-y, or input from a file), the "
           "time left. 0 disables reports. If -t is not given, there is a report every 5 seconds if "
           "standard error is a terminal but neither standard input nor standard output is, as in 'rsphere "
           "room.rad < points.txt > answers.txt'. The progress of pictures (-Si) is reported separately."});
}

void addDirectionOptions(const Add& add) {
  add({.name = "-S",
       .group = Group::sphere,
       .value = +[](O& o) -> bool& { return o.sphereMode; },
       .remark = "sphere mode on|sphere mode off (rays)",
       .paragraph =
           "Toggles sphere mode. It is on unless the program is called by the name rtrace. The mode "
           "determines the defaults of all other options, wherever -S is placed on the command line."});
  add({.name = "-Sn",
       .arguments = "N",
       .group = Group::sphere,
       .value = +[](O& o) -> int& { return o.sphere.baseDirections; },
       .range = {1, 1000000},
       .unit = "directions",
       .remark = "base directions",
       .mode = Mode::points,
       .elsewhere = "for rays, -ad is the number of indirect rays",
       .paragraph =
           "Number of base directions. They cover the sphere evenly and are the same for every point."});
  add({.name = "-Sx",
       .arguments = "N",
       .group = Group::sphere,
       .value = +[](O& o) -> int& { return o.sphere.mostDirections; },
       .range = {1, 4000000},
       .unit = "directions",
       .remark = "most directions",
       .mode = Mode::points,
       .paragraph =
           "Largest number of directions for one point: base directions, directions to special objects, "
           "directions to light sources and, where light is uneven, directions that follow the light. "
           "Directions to light sources are at most a quarter of -Sn unless there are more sources than "
           "that; they are sent even if they exceed the limit. If light paths are used (see -Sw), up to -Sn "
           "of them are sent, but no more than half of the directions that the limit leaves for them. "
           "Shadow rays and glances are not included. Without -Sx, the limit is the default or twice -Sn, "
           "whichever is larger; -Sa has a separate limit."});
}

void addWeightOptions(const Add& add) {
  add({.name = "-Sk",
       .arguments = "F",
       .group = Group::sphere,
       .value = +[](O& o) -> double& { return o.sphere.densityFactor; },
       .range = kNotNegative,
       .remark = "density factor",
       .mode = Mode::points,
       .paragraph =
           "Factor on the density of directions (1/sr) towards special objects. With 0 and -Sw c, all "
           "directions have equal weights except those to light sources that are seen directly, there are no "
           "glances and no light paths (see -Sw), no directions follow the light, and no indirect rays are "
           "aimed at small bright patches."});
  add({.name = "-Sa",
       .arguments = "acc",
       .group = Group::sphere,
       .value = +[](O& o) -> double& { return o.sphere.accuracy; },
       .range = kFraction,
       .remark = "accuracy",
       .mode = Mode::points,
       .elsewhere = "for rays, -ad, -as and -aa determine the accuracy",
       .paragraph =
           "Adaptive accuracy: the program averages sets of directions, each of -Sn base directions and "
           "those for special objects, until the estimated standard error of the mean's brightness is below "
           "acc times the mean. There are at least two sets. The total number of directions is at most -Sx "
           "if that is given, otherwise a million, or 100,000 with -Sd. Stopping as soon as the error looks "
           "small would favor sets that are too dark by chance. Therefore each half of the sets decides "
           "when the other half stops. At the end, a warning gives the number of points that did not reach "
           "the accuracy, and the largest error. 0 uses one set."});
  add({.name = "-Sf",
       .arguments = "share",
       .group = Group::sphere,
       .value = +[](O& o) -> double& { return o.sphere.clamp; },
       .range = kFraction,
       .remark = "clamp: largest share of one direction",
       .mode = Mode::points,
       .paragraph =
           "Clamp of single directions, against outliers (fireflies): the part of a direction's "
           "contribution to the mean that exceeds the estimate by glances is limited to this fraction of "
           "the mean. Directions to light sources that are integrated separately are not limited. The clamp "
           "makes the mean too small wherever it takes effect; at the end, a warning gives the number of "
           "points where it did and the fraction of light that it removed. Standard errors are those of the "
           "clamped mean and do not contain this bias. With -Sn N, a direction contributes 1/N of the mean "
           "on average. Values below 20/N therefore limit not only outliers but also ordinary directions. "
           "Only with -Sw c. 0 does not clamp."});
  add({.name = "-Sw",
       .arguments = "letter",
       .group = Group::sphere,
       .value = Custom{setWeights},
       .remark = "weights: h equal, v Voronoi, c Voronoi within silhouettes",
       .mode = Mode::points,
       .paragraph =
           "Weights of the directions. h: equal weights for the base directions, and no other directions. "
           "v: the solid angle of each direction's cell in a spherical Voronoi diagram. c: the same, with "
           "cells that end at the silhouettes of special objects, and with light sources integrated "
           "separately by next-event estimation. With c, the light of diffuse surfaces is estimated by "
           "glances, rays that only find a surface, combined with light paths from the sources, whatever "
           "-aa is. Light that meets other surfaces than plastic, metal, glass and mirrors, or such with "
           "textures or mixtures, is left to the directions. The same is done in rooms without lamps "
           "that daylight enters through windows or holes in walls, where -aa is 0: light paths from the "
           "openings carry the light of sun, sky and ground; points outdoors are excepted. There are no "
           "glances in other scenes with distant light sources, in mist, and where all lamps are of kinds "
           "that light paths do not start from (concave polygons, glow with a radius, spotlights that are "
           "not flat). Unless there are goals (-Sg), there are none either where a glow shines that only "
           "rays find, or where most of the area is of surfaces that are left to the directions. "
           "With h and v, light sources are treated like other surfaces.",
       .line = weightsLine});
}

// The quantities that sphere mode computes.
void addAnswerOptions(const Add& add) {
  add({.name = "-Sg",
       .arguments = "mod",
       .group = Group::sphere,
       .value = +[](O& o) -> std::vector<std::string>& { return o.goals; },
       .remark = "goals",
       .paragraph =
           "Computes importance instead of radiance, for goals: surfaces with modifier mod emit 1 W/sr/m2 "
           "from their front, in addition to reflecting light, and every other source is dark. May be "
           "repeated for several modifiers."});
  add({.name = "-SG",
       .arguments = "file",
       .group = Group::sphere,
       .value = Custom{setSensors},
       .remark = "sensors as goals",
       .mode = Mode::points,
       .elsewhere = "rays do not meet sensors",
       .paragraph =
           "Computes importance for sensors or eyes, which are places without a surface. The file is "
           "searched for along RAYPATH. For each sensor it contains x y z and the direction dx dy dz that "
           "the sensor faces, separated by white space. A sensor receives light in proportion to the "
           "cosine, as with rtrace -I, and is treated as a goal of area 1. It blocks and reflects nothing. "
           "Its importance at a point directly, or by one mirror, is exact. With -Sp the sensors are the "
           "contributors sensor1, sensor2 and so on, after the goals of -Sg. May be repeated. Not with -Sw "
           "h and v, nor with -Si."});
  add({.name = "-Sp",
       .group = Group::sphere,
       .value = +[](O& o) -> bool& { return o.separate; },
       .remark = "part of each goal|sum over goals",
       .paragraph =
           "Toggles separate answers for each contributor instead of their sum, in one pass. The "
           "contributors are the goals in the order of -Sg, or without goals the modifiers of light "
           "sources in the order of the scene; the header lists them after CONTRIBUTORS=. Each of the "
           "letters v e E C S h H u z Z (in ray mode v V r x) then writes the values of all contributors in "
           "turn: with two goals, -oHv writes 18 numbers of H for the first goal, 18 for the second, and 3 "
           "of v for each. The parts add up to the answers without -Sp, except for the ambient value "
           "(-av), which has no contributor. In ray mode light may be interpolated (-aa above 0); rcontrib "
           "does not interpolate, but has bins and tracks any surface. Standard errors (e) are those of "
           "the parts. With -pY they are upper bounds, because the errors of red, green and blue are "
           "assumed to be fully correlated. With the same -Sn they are larger than in a separate run for "
           "each goal, because the goals share the light paths and the shadow rays: for eight desks in an "
           "office 3 times as large (.8 instead of .25% with -Sn 2048), in 1.2 times the time of one desk. "
           "For small errors of each goal, separate runs are faster. -Sa applies to the sum. At most 1000 "
           "contributors. Not with -cs above 3, -af or pixels (-fac)."});
  add({.name = "-Sz",
       .arguments = "N",
       .group = Group::sphere,
       .value = +[](O& o) -> int& { return o.sphere.zones; },
       .range = {0, 100000},
       .remark = "zones of directions",
       .mode = Mode::points,
       .elsewhere = "for bins of rays, use rcontrib",
       .paragraph =
           "Divides all directions into N zones of equal solid angle. The letter z of -o writes their mean "
           "radiances, and Z the standard errors of these; see OUTPUT. 0: there are no zones."});
  add({.name = "-Szb",
       .arguments = "bin",
       .group = Group::sphere,
       .value = +[](O& o) -> std::string& { return o.sphere.zoneOf; },
       .remark = "bins of directions",
       .mode = Mode::points,
       .elsewhere = "for bins of rays, use rcontrib",
       .paragraph =
           "Divides all directions into user-defined bins instead of -Sz zones. bin is an expression for "
           "the number of the bin, from 0, that contains the direction Dx, Dy, Dz in which the point looks; "
           "it is rounded. It may use definitions of -e and -f, for example reinhart.cal. Directions with a "
           "negative number, or a number of at least -Szn, are in no bin. Borders of bins are accurate to "
           ".1 degrees. The letter z of -o writes the mean radiance of each bin. The header contains the "
           "solid angles (sr), eight in each line of SOLIDANGLES=. Needs -Szn."});
  add({.name = "-Szn",
       .arguments = "count",
       .group = Group::sphere,
       .value = +[](O& o) -> std::string& { return o.sphere.zoneCount; },
       .remark = "number of bins",
       .mode = Mode::points,
       .paragraph = "Number of bins of -Szb, as a constant expression: at most 100,000."});
  add({.name = "-So",
       .arguments = "az",
       .group = Group::sphere,
       .value = +[](O& o) -> double& { return o.sphere.azimuth; },
       .range = {-360, 360},
       .unit = "degrees",
       .remark = "azimuth of semi-cylindrical irradiance",
       .mode = Mode::points,
       .elsewhere = "rays have no semi-cylindrical irradiance",
       .paragraph = "Azimuth that the half cylinder of -oS faces, counterclockwise from the x axis."});
  add({.name = "-Sb",
       .group = Group::sphere,
       .value = +[](O& o) -> bool& { return o.sphere.basicRadiance; },
       .remark = "basic radiance on|basic radiance off",
       .paragraph =
           "Toggles basic radiance, L/n2, where n is the refractive index. Refraction does not change it. "
           "Importance through refracting materials is correct only in this form."});
  add({.name = "-Sd",
       .group = Group::sphere,
       .value = +[](O& o) -> bool& { return o.sphere.everyDirection; },
       .remark = "every direction|mean of directions",
       .mode = Mode::points,
       .paragraph =
           "Toggles a record for every direction instead of the mean at a point; with -Su, for every glare "
           "source of an eye. See OUTPUT."});
}

// Glare at an eye.
void addGlareOptions(const Add& add) {
  add({.name = "-Su",
       .group = Group::sphere,
       .value = +[](O& o) -> bool& { return o.sphere.glare.wanted; },
       .remark = "glare at an eye|means at a point",
       .mode = Mode::points,
       .paragraph =
           "Toggles glare instead of means. A record is then an eye and its gaze: six numbers, the place "
           "and the direction in which it looks, which is not vertical; z is up. The answer is the unified "
           "glare rating, the illuminance at the eye (lx), the luminance of the background (cd/m2), and the "
           "daylight glare probability; with -Sd, the list of the glare sources. See OUTPUT. Eight sets of "
           "directions are averaged, each of -Sn base directions and those for special objects; their "
           "differences give the standard errors. Not with -Sa, -Sb, -Sf, -Sg, -SG, -Si, -Sp, -Sw h, -Sw v, "
           "-Sz."});
  add({.name = "-Sub",
       .arguments = "factor",
       .group = Group::sphere,
       .value = +[](O& o) -> double& { return o.sphere.glare.threshold; },
       .range = {.01, kInfinity},
       .remark = "threshold of glare sources",
       .mode = Mode::points,
       .paragraph =
           "Threshold of luminance above which regions are glare sources; light sources are always glare "
           "sources. Above 100, it is in cd/m2. Otherwise it is a factor, as in evalglare: on the mean "
           "luminance of the task (-Sut) or, without a task, of all directions in front of the eye. Needs "
           "-Su."});
  add({.name = "-Sut",
       .arguments = "below opening",
       .group = Group::sphere,
       .value = Custom{setTask},
       .range = {-90, 180},
       .unit = "degrees",
       .remark = "task: angle below the gaze, opening",
       .mode = Mode::points,
       .paragraph =
           "The task, such as a screen or a book: a disk of directions with its middle `below` degrees "
           "under the line of sight, and `opening` degrees wide. If -Sub is at most 100 (usually 5), the "
           "threshold of glare sources is the mean luminance of the task times -Sub. An opening of 0 means "
           "that there is no task.",
       .line = taskLine});
}

// Options of rsphere that also apply in ray mode.
void addBothModesOptions(const Add& add) {
  add({.name = "-Ss",
       .arguments = "N",
       .group = Group::sphere,
       .value = +[](O& o) -> int& { return o.ray.chosenSources; },
       .range = {0, 1e6},
       .remark = "light sources tested at a surface",
       .paragraph =
           "Number of light sources that next-event estimation tests at a diffuse surface, instead of all "
           "of them; it is smaller for rays of less weight. The sources are drawn at random, in proportion "
           "to their contribution without shadows; -dt, -dc, -dj and -ds do not apply to them. 0 tests all "
           "sources. Also applies in ray mode."});
  add({.name = "-Sh",
       .arguments = "N",
       .group = Group::indirect,
       .value = +[](O& o) -> int& { return o.ray.firstRays; },
       .range = {0, 1000},
       .remark = "first rays for each that goes on",
       .paragraph =
           "Factor on the number of rays in the first gather of a path, where daylight enters through "
           "openings, nothing is interpolated and there are no light sources. The rays of -ad continue "
           "beyond the diffuse surfaces that they hit. The additional rays only contribute the light "
           "emitted where they end, such as that of the sky. 0 selects 2, 4 or 8 for -ab 2, 3 or more, "
           "which suits contributions by bins of the sky."});
  add({.name = "-Sm",
       .arguments = "MB",
       .group = Group::sphere,
       .value = +[](O& o) -> double& { return o.ray.fieldMemory; },
       .range = {0, 1e9},
       .unit = "MB",
       .remark = "memory of interpolation",
       .paragraph =
           "Limit of the memory for the irradiance cache of ray mode (-aa above 0), in millions of bytes. "
           "When it is reached, cache records are discarded, and computed again when they are needed. This "
           "changes no answer, but takes more time. The coarse solution of later bounces is not included; "
           "its memory has no limit and grows with the number of surfaces that paths reach. 0 sets no "
           "limit. Not together with -af. Sphere mode has no cache records, so that the limit has no effect "
           "there."});
  add({.name = "-Sr",
       .arguments = "N",
       .group = Group::sphere,
       .value = Custom{setRotation},
       .range = kCount,
       .remark = "rotation and random numbers",
       .paragraph =
           "Selects a rotation of the base directions and a sequence of random numbers, so that runs with "
           "different N show the variance of the answers. In ray mode it selects the random numbers.",
       .line = +[](const O& o) { return fmt::format("-Sr {:<9}\t\t\t", o.sphere.rotation); }});
  add({.name = "-Sc",
       .group = Group::sphere,
       .value = +[](O& o) -> bool& { return o.commands; },
       .remark = "scene commands on|scene commands off",
       .paragraph =
           "Toggles commands in scene files (lines that begin with !). xform always works, because it needs "
           "no other program. -Sc- is meant for untrusted scenes: it also restricts the files that scene "
           "files name (xform, octrees, meshes, data, pictures, fonts, functions, BSDFs) to regular files "
           "in or below the folders of the files on the command line and of RAYPATH, even if symbolic links "
           "point elsewhere. Also applies in ray mode."});
}

// Options for examining how answers were obtained.
void addInspectionOptions(const Add& add) {
  add({.name = "-Sv",
       .group = Group::sphere,
       .value = +[](O& o) -> bool& { return o.sphere.verify; },
       .remark = "verify weights|weights not verified",
       .mode = Mode::points,
       .paragraph =
           "Toggles verification of the weights of each point: they must sum to 4 pi, and no circle through "
           "three neighboring directions may contain a fourth. Otherwise the program stops with an error."});
  add({.name = "-Si",
       .arguments = "pic",
       .group = Group::sphere,
       .value = +[](O& o) -> std::string& { return o.picture; },
       .remark = "picture of each point",
       .mode = Mode::points,
       .elsewhere = "for pictures of rays, use -fac with -x and -y",
       .paragraph =
           "Draws a picture of the light that arrives at each point from all directions. The extension of "
           "the name selects the format. The answers do not change. The half a million pixels of a picture "
           "have separate defaults: -aa .2 -ad 32 -ar 64 -dj 1 -dt .03 -lw 1e-4 -ss 8. These and all other "
           "options of rtrace also apply to pictures if they are given; of the -S options only -Ss, -Sg, "
           "-Sb and -Sr do. Indirect light is gathered with -ad + -as rays at one pixel in four, or in nine "
           "if there are only lamps. It is averaged over nearby pixels of the same surface, as are rough "
           "reflections and the noise of soft shadows. -aa 0 follows paths of all bounces, without bias and "
           "in several times the time; with any other -aa, later bounces come from the coarse solution. "
           "Pixels at edges have five or nine rays. Light sources have their true radiance and size. With "
           "these defaults, a picture of a furnished room takes one core 5 to 25 seconds, and 50 if walls "
           "are made of logs. Each picture is drawn by one thread, and several points by as many threads as "
           "-n allows. On a terminal, and with -t, the program reports the finished part and the time left. "
           "RADIANCE pictures (.hdr, .pic) are angular fisheyes of 360 degrees, with +y in the middle and "
           "+z above it. Their header has the command, SOFTWARE= and VIEW=; pinterp converts them to other "
           "views, such as the hemisphere that evalglare expects. pcond of RADIANCE 6.1 crashes on any view "
           "of 360 degrees, so that pictures must be converted first. In all other formats, too, +y is in "
           "the middle; +x is to the right of it at a quarter of the width, and -y at both edges. Columns "
           "are azimuths, and rows go from the zenith to the nadir. EXR and TIFF files contain radiance. "
           "Other files contain colors, exposed so that the median is mid-bright. %d in the name (or %04d "
           "and the like) is replaced by the number of the record, from 0."});
  add({.name = "-Sl",
       .group = Group::sphere,
       .value = +[](O& o) -> bool& { return o.listSpecial; },
       .remark = "list special objects|answers",
       .paragraph =
           "Toggles a list of the special objects of the scene instead of answers. Each line contains the "
           "place, the material, the density of directions (1/sr) and the reason why the object is special, "
           "separated by tabs. Nothing is read from standard input."});
}

// The order is that of rtrace's -defaults. Options of rtrace that its -defaults does not print follow, from
// -ap to -t.
std::vector<OptionEntry> makeTable() {
  std::vector<OptionEntry> table;
  for (const auto addOptions :
       {addRecordOptions,    addFormatOptions,    addColorOptions,   addRayOptions,       addShadowOptions,
        addSourceOptions,    addSpecularOptions,  addAmbientOptions, addGatheringOptions, addMediumOptions,
        addSpectrumOptions,  addLimitOptions,     addPhotonOptions,  addModifierOptions,  addTreeOptions,
        addProgramOptions,   addDirectionOptions, addWeightOptions,  addAnswerOptions,    addGlareOptions,
        addBothModesOptions, addInspectionOptions})
    addOptions([&table](const OptionEntry& entry) { table.push_back(entry); });
  return table;
}

}  // namespace

std::span<const OptionEntry> optionTable() {
  static const std::vector<OptionEntry> table = makeTable();
  return table;
}

int arity(const OptionEntry& entry) {
  if (entry.glued || entry.arguments.empty()) return 0;
  return 1 + static_cast<int>(std::count(entry.arguments.begin(), entry.arguments.end(), ' '));
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
  return options;
}

// At each pixel, a picture has a tenth of the rays of a gather for a cache record, and averages them over
// nearby pixels. Measured in the classroom of examples/daylight (-ab 8, 1024 x 512 pixels):
// - Rays of a gather: 32, in 10 s. With 16, blotches are visible on the ceiling beside the windows.
// - Patches: with 256 rays and an accuracy of .2 they are not visible through a gather.
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
  ray.leastForPatches = 256;
  ray.coarserLinks = 2;
  ray.specularSampling = 8;
  ray.directThreshold = .03;
  ray.weightLimit = 1e-4;
  return ray;
}

}  // namespace rsphere
