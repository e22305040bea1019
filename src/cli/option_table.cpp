#include "cli/option_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <iomanip>
#include <iterator>

#include "answer/output_colors.h"
#include "cli/option_words.h"
#include "rad_parser/error.h"
#include "rad_parser/file_path.h"
#include "rad_parser/number.h"

namespace rsphere {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLargestInt = std::numeric_limits<int>::max();
constexpr Range kNotNegative{0, kInfinity};
constexpr Range kFraction{0, 1};
constexpr Range kCount{0, kLargestInt};
constexpr int kLongestModifier = 65536;  // bytes, as in scene text
constexpr size_t kMostModifiers = 1000000;

// The words of a file that the command line names. As in rtrace, it is searched for along RAYPATH.
std::vector<std::string> modifierFile(const OptionEntry& entry, const std::string& name) {
  const auto what = [&] {
    return fmt::format("{} {} file \"{}\"", entry.name[1] == 'a' ? "ambient" : "trace",
                       entry.name[2] == 'E' ? "exclude" : "include", name);
  };
  const auto path = rad::findFile(name, rad::libraryPath());
  errno = path ? 0 : ENOENT;
  std::ifstream file(path.value_or(name));
  std::vector<std::string> words;
  for (std::string word; path && file >> std::setw(kLongestModifier + 1) >> word;) {
    words.push_back(word);
    // An endless device exceeds these limits.
    if (words.size() > kMostModifiers || word.size() > size_t{kLongestModifier})
      throw rad::Error(
          fmt::format("{} has too {} words", what(), word.size() > kLongestModifier ? "long" : "many"));
  }
  if (errno != 0 && (!path || !file.is_open() || file.bad()))
    throw rad::Error(fmt::format("cannot open {}: {}", what(), std::strerror(errno)), rad::Status::system);
  return words;
}

// -ae and -aE name modifiers without indirect light; -ai and -aI name the only modifiers with it. -te and so
// on do the same for ray trees. An option of one kind discards the names of the other kind before it.
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
    const auto more = modifierFile(entry, words[0]);
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

void setThreads(Options& options, const OptionEntry& entry, std::span<const std::string> words,
                std::string_view) {
  const auto n = rad::parseInteger(words[0]);
  if (!n) notInteger(entry.name, words[0]);
  constexpr int kMostThreads = 4096;  // more than any machine has; a larger number is a typing error
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

// As in rtrace, the word of -e is an expression if it contains '=' or ':', and else
// the name of an error file.
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

void ignore(Options&, const OptionEntry&, std::span<const std::string>, std::string_view) {}

struct NamedSpace {
  std::string_view name;
  ColorSpace space;
  std::string_view remark, paragraph;
};
constexpr std::array<NamedSpace, 6> kSpaces = {{
    {"-pRGB", ColorSpace::rgb, "standard RGB color output",
     "Colors as red, green and blue of RADIANCE's standard primaries."},
    {"-pXYZ", ColorSpace::xyz, "CIE XYZ color output",
     "Colors as CIE X, Y and Z, times 179 lm/W: Y is luminance or illuminance."},
    {"-pY", ColorSpace::photopic, "photopic output",
     "One number for each color, its luminance: 179 lm/W times .265 red + .670 green + .065 blue."},
    {"-pS", ColorSpace::scotopic, "scotopic output",
     "One number for each color, for night vision (412 lm/W): red stands for all wavelengths from 588 nm up, "
     "green for those from 480 nm, blue for those below."},
    {"-pM", ColorSpace::melanopic, "melanopic output",
     "One number for each color, for the melanopic response (179 lm/W), with the channels as for -pS."},
    {"-pA", ColorSpace::average, "radiometric average output",
     "One number for each color: the mean of its channels."},
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
  options.color.bands = static_cast<int>(std::clamp<int64_t>(*n, 0, kMostBands));
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

// The lines of -defaults for the options that choose the color space: only the one in effect is printed.
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
       .paragraph = "Switch for warnings. They tell of what is odd but can be answered."});
  add({.name = "-I",
       .group = Group::records,
       .value = +[](O& o) -> bool& { return o.irradianceAtPoint; },
       .remark = "immediate irradiance on|immediate irradiance off",
       .paragraph =
           "Switch for irradiance (W/m2) on a sensor: the origin of each ray is a point, its direction the "
           "way in which the sensor looks. As in rtrace, the ray is traced from 1.1e-4 units above the "
           "point, and -oo "
           "and -od show this. Ray mode only: in sphere mode -oH, -oC and -oE give irradiances.",
       .line = immediateLine});
  add({.name = "-n",
       .arguments = "N",
       .group = Group::program,
       .value = Custom{setThreads},
       .range = kCount,
       .unit = "threads",
       .remark = "number of rendering processes",
       .paragraph =
           "Answer records on N threads, 0 for one on each core; with a warning, on as many as can be had. "
           "The answers do not depend on N.",
       .line = +[](const O& o) { return fmt::format("-n {:<2}\t\t\t\t", o.threads); }});
  add({.name = "-x",
       .arguments = "res",
       .group = Group::records,
       .value = +[](O& o) -> int64_t& { return o.width; },
       .range = kCount,
       .unit = "records",
       .remark = "flush interval",
       .paragraph =
           "Records in a scanline. Where -y is 0, answers are written out after every res records, and only "
           "then; with 1, after every record whatever -y is. With 0, whenever input has to be waited for."});
  add({.name = "-y",
       .arguments = "res",
       .group = Group::records,
       .value = +[](O& o) -> int64_t& { return o.height; },
       .range = kCount,
       .unit = "scanlines",
       .remark = "y resolution",
       .paragraph =
           "Stop after res scanlines of -x records (of one where -x is 0); 0 goes on to the end of input. "
           "With both -x and -y a resolution line precedes the records, header or not."});
  add({.name = "-ld",
       .group = Group::records,
       .value = +[](O& o) -> bool& { return o.limitDistance; },
       .remark = "limit distance on|limit distance off",
       .paragraph =
           "Switch for limited rays: the length of each direction vector is how far its ray goes. Ray mode "
           "only."});
  add({.name = "-h",
       .group = Group::records,
       .value = +[](O& o) -> bool& { return o.header; },
       .remark = "output header|no header",
       .paragraph = "Switch for the information header before the records."});
}

void addFormatOptions(const Add& add) {
  add({.name = "-f",
       .arguments = "io",
       .group = Group::records,
       .value = Custom{setFormat},
       .remark = "format input/output",
       .paragraph =
           "Format of input i and of output o: a for text, f for floats, d for doubles of this machine, and, "
           "for output only, c for RADIANCE's 4-byte pixels, with a single color letter in -o. One letter "
           "stands for "
           "both. No blank precedes io.",
       .glued = true,
       .line = formatLine});
  add({.name = "-o",
       .arguments = "spec",
       .group = Group::records,
       .value = Custom{setOutputs},
       .remark = "output",
       .paragraph =
           "What a record of output has, in the order of the letters in spec; see Output under "
           "DESCRIPTION. In ray mode, the letters behind a t are for all rays on the way: reflected, "
           "transmitted and indirect ones, and shadow rays where they go through something; behind a T, "
           "all shadow rays. Each comes before its parent, indented by a TAB for each of its ancestors. No "
           "blank precedes spec.",
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
           "Colors as red, green and blue of these primaries (CIE x and y), with the white point adapted.",
       .line = primariesLine});
  add({.name = "-co",
       .group = Group::color,
       .value = Custom{setSpectralOutput},
       .remark = "output spectral values",
       .paragraph =
           "Switch for spectra: a color is as many numbers as -cs has bands, from the longest wavelength to "
           "the shortest. Scenes have three channels; each band has the value of the one it is in (see "
           "-pS). Three bands are no spectrum, and red, green and blue are written.",
       .glued = true,
       .line = spectralLine});
}

void addRayOptions(const Add& add) {
  add({.name = "-i",
       .group = Group::records,
       .value = +[](O& o) -> bool& { return o.irradianceAtHit; },
       .remark = "irradiance calculation on|irradiance calculation off",
       .paragraph =
           "Switch for irradiance (W/m2) of the surface that a ray hits, instead of the radiance (W/sr/m2) "
           "that it sends back. Glass and its like are passed as if they were not there; light sources keep "
           "their "
           "radiance (see -dv). Ray mode only."});
  add({.name = "-u",
       .group = Group::program,
       .value = +[](O& o) -> bool& { return o.ray.uncorrelated; },
       .remark = "uncorrelated Monte Carlo sampling|correlated quasi-Monte Carlo sampling",
       .paragraph =
           "Given as -u+, the random numbers of a ray follow from its number in the input as well as from "
           "the ray, so that a ray that is repeated is a new sample each time and the mean of its answers "
           "is better than one of them. Otherwise they follow from the ray alone, and a repeated ray "
           "repeats its noise; in rtrace it never does. Answers do not depend on -n either way. Indirect "
           "light that is interpolated (-aa above 0) is the same for repeated rays in any case. Ray mode "
           "only. Samples are random, not quasi-random, whatever -u is."});
  add({.name = "-bv",
       .group = Group::program,
       .value = +[](O& o) -> bool& { return o.ray.backFacesVisible; },
       .remark = "back face visibility on|back face visibility off",
       .paragraph = "Switch for whether rays see the backs of surfaces."});
}

void addShadowOptions(const Add& add) {
  add({.name = "-dt",
       .arguments = "frac",
       .group = Group::direct,
       .value = +[](O& o) -> double& { return o.ray.directThreshold; },
       .range = kNotNegative,
       .remark = "direct threshold",
       .paragraph =
           "Shadows of the light sources are tested until those left could add less than this fraction of "
           "what was found; the rest is estimated from how often sources were visible. Behind an indirect "
           "bounce one source, chosen at random, stands for the rest, so that means are unbiased. 0 tests "
           "all."});
  add({.name = "-dc",
       .arguments = "frac",
       .group = Group::direct,
       .value = +[](O& o) -> double& { return o.ray.directCertainty; },
       .range = kFraction,
       .remark = "direct certainty",
       .paragraph =
           "How sure -dt is: 1 holds the error of the sum below it, 0 only that of any one shadow edge."});
}

void addSourceOptions(const Add& add) {
  add({.name = "-dj",
       .arguments = "frac",
       .group = Group::direct,
       .value = +[](O& o) -> double& { return o.ray.directJitter; },
       .range = kNotNegative,
       .remark = "direct jitter",
       .paragraph =
           "How much of a source's part the point aimed at is moved about in: 0 its middle, 1 all of it. "
           "More than 1 is of no use."});
  add({.name = "-ds",
       .arguments = "frac",
       .group = Group::direct,
       .value = +[](O& o) -> double& { return o.ray.sourceSubstructuring; },
       .range = kNotNegative,
       .remark = "direct sampling",
       .paragraph =
           "Divide light sources into parts whose size over their distance is below this. 0 leaves them "
           "whole."});
  add({.name = "-dr",
       .arguments = "N",
       .group = Group::direct,
       .value = +[](O& o) -> int& { return o.ray.directRelays; },
       .range = kCount,
       .unit = "reflections",
       .remark = "direct relays",
       .paragraph =
           "How often the light of a source may be passed on by plane surfaces of mirror, prism1 and prism2 "
           "on its way: each makes a virtual source of every source that it sees. 0: never."});
  add({.name = "-dp",
       .arguments = "D",
       .group = Group::direct,
       .value = +[](O& o) -> int& { return o.ray.directPretest; },
       .range = kCount,
       .unit = "samples/sr",
       .remark = "direct pretest density",
       .paragraph = "Density of the rays that rtrace sends beforehand to learn whether a virtual source can "
                    "be reached "
                    "at all, or is reached from everywhere. Here each one that geometry does not rule out is "
                    "tested, as "
                    "with 0.",
       .support = Support::unused});
  add({.name = "-dv",
       .group = Group::direct,
       .value = +[](O& o) -> bool& { return o.ray.sourcesVisible; },
       .remark = "direct visibility on|direct visibility off",
       .paragraph =
           "Switch for light sources seen directly; off, they are black there, and light the scene all the "
           "same."});
}

void addSpecularOptions(const Add& add) {
  add({.name = "-ss",
       .arguments = "samp",
       .group = Group::specular,
       .value = +[](O& o) -> double& { return o.ray.specularSampling; },
       .range = kNotNegative,
       .remark = "specular sampling",
       .paragraph =
           "Samples of a rough highlight: below 1, how much of its width they spread over; above, how many "
           "rays. 0 makes every highlight sharp."});
  add({.name = "-st",
       .arguments = "frac",
       .group = Group::specular,
       .value = +[](O& o) -> double& { return o.ray.specularThreshold; },
       .range = kNotNegative,
       .remark = "specular threshold",
       .paragraph =
           "Specular reflection or transmission below this fraction sends no rays and takes the indirect "
           "light instead. 0 always sends them, 1 never."});
}

void addAmbientOptions(const Add& add) {
  add({.name = "-av",
       .arguments = "red grn blu",
       .group = Group::indirect,
       .value = +[](O& o) -> Rgb& { return o.ray.ambientValue; },
       .range = kNotNegative,
       .unit = "W/sr/m2",
       .remark = "ambient value",
       .paragraph = "Radiance that stands for the indirect light not computed."});
  add({.name = "-aw",
       .arguments = "N",
       .group = Group::indirect,
       .value = +[](O& o) -> int& { return o.ray.ambientWeight; },
       .range = kCount,
       .remark = "ambient value weight",
       .paragraph =
           "Accepted and not used. rtrace replaces the ambient value step by step by the mean of the "
           "indirect light that it has computed; here an answer does not depend on those before it, and the "
           "ambient value stays as -av gives it."});
  add({.name = "-ab",
       .arguments = "N",
       .group = Group::indirect,
       .value = +[](O& o) -> int& { return o.ray.ambientBounces; },
       .range = kCount,
       .unit = "bounces",
       .remark = "ambient bounces",
       .paragraph = "Most diffuse reflections of an indirect path. 0: no indirect light."});
}

void addGatheringOptions(const Add& add) {
  add({.name = "-aa",
       .arguments = "acc",
       .group = Group::indirect,
       .value = +[](O& o) -> double& { return o.ray.ambientAccuracy; },
       .range = kNotNegative,
       .remark = "ambient accuracy",
       .paragraph =
           "Relative error that interpolation of indirect light may add; see Interpolation under "
           "DESCRIPTION. 0: no interpolation, each path gathers indirect light anew. That is faster for a "
           "few rays in a detailed scene, and usually the better choice in sphere mode, where directions "
           "meet surfaces all over the scene."});
  add({.name = "-ar",
       .arguments = "res",
       .group = Group::indirect,
       .value = +[](O& o) -> int& { return o.ray.ambientResolution; },
       .range = kCount,
       .remark = "ambient resolution",
       .paragraph =
           "Finest resolution of interpolation: sites are about the scene's size times -aa (.5 at most) "
           "over res apart where they are closest, and somewhat closer only where something hides them from "
           "the place. Smaller detail of the indirect light is blurred. 0 sets no limit."});
  add({.name = "-ad",
       .arguments = "N",
       .group = Group::indirect,
       .value = +[](O& o) -> int& { return o.ray.ambientDivisions; },
       .range = kCount,
       .unit = "rays",
       .remark = "ambient divisions",
       .paragraph =
           "Rays over the hemisphere where indirect light is gathered: at the first diffuse surface of a "
           "path, or, where it is interpolated, at each site. A ray of less weight gathers with fewer, a "
           "site always with all. The noise falls about with the square root of their number. 0: no "
           "indirect light."});
  add({.name = "-as",
       .arguments = "N",
       .group = Group::indirect,
       .value = +[](O& o) -> int& { return o.ray.ambientSuperSamples; },
       .range = kCount,
       .unit = "rays",
       .remark = "ambient super-samples",
       .paragraph =
           "Rays added to those of -ad. All of them are spread over the hemisphere together; unlike those "
           "of rtrace, none are placed by what others have found."});
}

void addMediumOptions(const Add& add) {
  add({.name = "-me",
       .arguments = "rext gext bext",
       .group = Group::medium,
       .value = +[](O& o) -> Rgb& { return o.ray.mediumExtinction; },
       .range = kNotNegative,
       .unit = "1/length",
       .remark = "mist extinction coefficient",
       .paragraph =
           "Extinction of a medium that fills the scene. Light from sources is scattered in it where mist "
           "names them.",
       .line =
           +[](const O& o) {
             const Rgb& c = o.ray.mediumExtinction;
             return fmt::format("-me {:.2e} {:.2e} {:.2e}\t", c.x, c.y, c.z);
           }});
  add({.name = "-ma",
       .arguments = "ralb galb balb",
       .group = Group::medium,
       .value = +[](O& o) -> Rgb& { return o.ray.mediumAlbedo; },
       .range = kFraction,
       .remark = "mist scattering albedo",
       .paragraph = "Share of the extinction that is scattered, the rest is absorbed. Of indirect light the "
                    "medium scatters what -av says."});
  add({.name = "-mg",
       .arguments = "gecc",
       .group = Group::medium,
       .value = +[](O& o) -> double& { return o.ray.mediumEccentricity; },
       .range = {-1, 1},
       .remark = "mist scattering eccentricity",
       .paragraph = "Eccentricity g of Henyey and Greenstein's phase function: 0 scatters evenly, near 1 "
                    "straight on. Below 0 counts as 0."});
  add({.name = "-ms",
       .arguments = "sampdist",
       .group = Group::medium,
       .value = +[](O& o) -> double& { return o.ray.mediumSampling; },
       .range = kNotNegative,
       .unit = "length",
       .remark = "mist sampling distance",
       .paragraph = "Length of a ray through mist for each sample of a source that it scatters, at most 16 "
                    "samples. 0: one sample in all."});
}

void addSpectrumOptions(const Add& add) {
  add({.name = "-cs",
       .arguments = "Ns",
       .group = Group::color,
       .value = Custom{setBands},
       .range = {3, kMostBands},
       .unit = "bands",
       .remark = "number of spectral bins",
       .paragraph = "Bands of spectral output, at most 24; see -co. Other output stays as it is with three: "
                    "what rtrace "
                    "changes by turning red, green and blue into a spectrum and back is not imitated.",
       .line = bandsLine});
  add({.name = "-cw",
       .arguments = "nmA nmB",
       .group = Group::color,
       .value = Custom{setWavelengths},
       .range = kNotNegative,
       .unit = "nm",
       .remark = "wavelength limits (nm)",
       .paragraph = "Limits of the spectrum, at least 50 nm apart: 380 and 780 unless told otherwise.",
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
       .paragraph = "Most reflections of a ray. If N is positive, rays of less weight than -lw end; if it is "
                    "negative, "
                    "they live on by Russian roulette, for -N reflections; if 0, for any number. -lw must be "
                    "positive then."});
  add({.name = "-lw",
       .arguments = "frac",
       .group = Group::limits,
       .value = +[](O& o) -> double& { return o.ray.weightLimit; },
       .range = kNotNegative,
       .remark = "limit weight",
       .paragraph =
           "Least weight of a ray; see -lr. Where indirect light is interpolated (-aa above 0), each "
           "diffuse reflection halves the weight, whatever the surface reflects, as in rtrace. The coarse "
           "solution of later bounces keeps the limits of -lr and -lw as if each bounce were such a ray.",
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
       .paragraph = "Accepted as in rtrace; changes nothing without -ap.",
       .support = Support::unused,
       .line = +[](const O& o) { return fmt::format("-am {:.1f}\t\t\t\t", o.photonRadius); }});

  add({.name = "-ap",
       .arguments = "file",
       .group = Group::indirect,
       .value = Custom{ignore},
       .remark = "photon map",
       .paragraph = "A photon map, with one or two bandwidths.",
       .support = Support::refused,
       .reason = kPhotons});
  add({.name = "-ac",
       .arguments = "pagesize",
       .group = Group::indirect,
       .value = Custom{ignore},
       .range = kNotNegative,
       .remark = "photon cache page size",
       .paragraph = "Accepted as in rtrace; changes nothing without -ap.",
       .support = Support::unused});
  add({.name = "-aC",
       .arguments = "cachesize",
       .group = Group::indirect,
       .value = Custom{ignore},
       .remark = "photon cache size",
       .paragraph = "Accepted as in rtrace; changes nothing without -ap.",
       .support = Support::unused});
}

void addModifierOptions(const Add& add) {
  add({.name = "-af",
       .arguments = "file",
       .group = Group::indirect,
       .value = +[](O& o) -> std::string& { return o.ray.ambientFile; },
       .remark = "ambient file",
       .paragraph =
           "Keeps the sites of interpolation, with the light gathered there, for later runs, and for others "
           "that run at the same time, in a file beside this one: file.rsphere. It is read first, and added "
           "to now and then and at the end; a process that is killed does no harm. No answer changes by it. "
           "The coarse solution of later bounces is not kept, and there is nothing to keep in sphere mode "
           "or with -I. A file that was made for another scene, with other options or by another version is "
           "not used and left as it is, with a warning. The file named here, which may hold what RADIANCE's "
           "programs keep, is neither read nor written, so that one name may serve both. Only with -aa and "
           "-ab above 0."});
  add({.name = "-ae",
       .arguments = "mod",
       .group = Group::indirect,
       .value = Custom{setModifiers},
       .remark = "modifier without indirect light",
       .paragraph =
           "Surfaces with modifier mod get the ambient value instead of computed indirect light. May be "
           "repeated; -ai or -aI after it starts anew."});
  add({.name = "-aE",
       .arguments = "file",
       .group = Group::indirect,
       .value = Custom{setModifiers},
       .remark = "modifiers without indirect light",
       .paragraph =
           "As -ae, for all modifiers that the file names, between blanks. It is looked for along RAYPATH."});
  add({.name = "-ai",
       .arguments = "mod",
       .group = Group::indirect,
       .value = Custom{setModifiers},
       .remark = "modifier with indirect light",
       .paragraph =
           "Only surfaces with modifier mod, and those of other -ai, get computed indirect light; -ae or -aE "
           "after it starts anew."});
  add({.name = "-aI",
       .arguments = "file",
       .group = Group::indirect,
       .value = Custom{setModifiers},
       .remark = "modifiers with indirect light",
       .paragraph =
           "As -ai, for all modifiers that the file names, between blanks. It is looked for along RAYPATH."});
}

void addTreeOptions(const Add& add) {
  for (const std::string_view name : {"-te", "-ti"})
    add({.name = name,
         .arguments = "mod",
         .group = Group::trees,
         .value = Custom{setModifiers},
         .remark = name == "-te" ? "modifier left out of ray trees" : "modifier in ray trees",
         .paragraph = name == "-te"
                          ? "Leave rays that hit a surface with modifier mod out of the trees of -ot and "
                            "-oT. May be repeated; -ti or -tI after it starts anew. The blank may be "
                            "left out."
                          : "Show only rays that hit a surface with modifier mod, or that of another -ti, "
                            "in the trees of -ot and -oT; -te or -tE after it starts anew.",
         .alsoGlued = true});
  for (const std::string_view name : {"-tE", "-tI"})
    add({.name = name,
         .arguments = "file",
         .group = Group::trees,
         .value = Custom{setModifiers},
         .remark = name == "-tE" ? "modifiers left out of ray trees" : "modifiers in ray trees",
         .paragraph = name == "-tE"
                          ? "As -te, for all modifiers that the file names, between blanks. It is looked for "
                            "along RAYPATH."
                          : "As -ti, for all modifiers that the file names, between blanks. It is looked "
                            "for along RAYPATH."});
}

void addProgramOptions(const Add& add) {
  constexpr std::string_view kPersist = "a program that waits is kept with a pipe and -x 1";
  add({.name = "-f",
       .arguments = "source",
       .group = Group::program,
       .value = Custom{setFunctionFile},
       .remark = "function file",
       .paragraph = "Take the definitions of the function file source, looked for along RAYPATH, for all "
                    "function files; "
                    "they replace those of rayinit.cal."});
  add({.name = "-e",
       .arguments = "file",
       .group = Group::program,
       .value = Custom{setErrorFile},
       .remark = "error file",
       .paragraph =
           "Append messages to the file instead of writing them to standard error, beginning with the "
           "process id and the command line. A word with = or : in it is no file but definitions, as those "
           "of -f: "
           "-e 'height=2;x(a):a*height'.",
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
         .paragraph = "A process that outlives its input.",
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
           "Report about every so many seconds how many records were answered, how many a second and, where "
           "the end is known (-y, or input from a file), how long the rest will take, on standard error. "
           "0: never."});
}

void addDirectionOptions(const Add& add) {
  add({.name = "-S",
       .group = Group::sphere,
       .value = +[](O& o) -> bool& { return o.sphereMode; },
       .remark = "sphere mode on|sphere mode off (rays)",
       .paragraph =
           "Switch for sphere mode. Off by itself if the program is called by the name rtrace. Wherever it "
           "stands, the mode decides on the defaults of all other options."});
  add({.name = "-Sn",
       .arguments = "N",
       .group = Group::sphere,
       .value = +[](O& o) -> int& { return o.sphere.baseDirections; },
       .range = {1, 1000000},
       .unit = "directions",
       .remark = "base directions",
       .paragraph = "Directions spread evenly over the sphere, the same for every point."});
  add({.name = "-Sx",
       .arguments = "N",
       .group = Group::sphere,
       .value = +[](O& o) -> int& { return o.sphere.mostDirections; },
       .range = {1, 4000000},
       .unit = "directions",
       .remark = "most directions",
       .paragraph =
           "Most directions of one point, those for special objects with them. Directions to light "
           "sources, a quarter of -Sn at most unless there are more sources, count as well; where there is "
           "no room for them, they come on top. Rays that only guess, and shadow rays, do not count. Not "
           "given, it grows with -Sn to twice that; see -Sa."});
}

void addWeightOptions(const Add& add) {
  add({.name = "-Sk",
       .arguments = "F",
       .group = Group::sphere,
       .value = +[](O& o) -> double& { return o.sphere.densityFactor; },
       .range = kNotNegative,
       .remark = "density factor",
       .paragraph =
           "Multiplies the density of directions (1/sr) that the materials of special objects ask for: "
           "mirrors, glass and others whose radiance has peaks. 0, with -Sw c: equal weights but for the "
           "light sources that are seen directly; nothing is guessed of diffuse surfaces, and no indirect "
           "ray is aimed at where much light falls on little."});
  add({.name = "-Sa",
       .arguments = "acc",
       .group = Group::sphere,
       .value = +[](O& o) -> double& { return o.sphere.accuracy; },
       .range = kFraction,
       .remark = "accuracy",
       .paragraph =
           "Average sets of directions, each of -Sn and those for special objects, until the estimated "
           "standard error of the mean's brightness is below acc times the mean: at least two sets, and no "
           "more directions in all than -Sx says where it is given, else a million, or with -Sd 100,000. "
           "How many of one half of the sets are averaged follows from the other half, so that stopping "
           "makes hardly any bias. A warning at the end says at how many points it was not reached, and "
           "what the worst is. 0: one set."});
  add({.name = "-Sw",
       .arguments = "letter",
       .group = Group::sphere,
       .value = Custom{setWeights},
       .remark = "weights: h equal, v Voronoi, c Voronoi within silhouettes",
       .paragraph = "What a direction's radiance is weighted with: h the same for all base directions, and "
                    "no others; v "
                    "the solid angle of its spherical Voronoi cell; c the same with cells that keep to the "
                    "silhouettes of "
                    "special objects, and light sources integrated by themselves. With h and v a light "
                    "source is a surface "
                    "like any other.",
       .line = weightsLine});
}

// What a record of sphere mode answers.
void addAnswerOptions(const Add& add) {
  add({.name = "-Sg",
       .arguments = "mod",
       .group = Group::sphere,
       .value = +[](O& o) -> std::vector<std::string>& { return o.goals; },
       .remark = "goals",
       .paragraph =
           "Importance instead of radiance: surfaces with modifier mod emit 1 W/sr/m2 from their front and "
           "go on reflecting; every other source is dark. May be repeated."});
  add({.name = "-Sb",
       .group = Group::sphere,
       .value = +[](O& o) -> bool& { return o.sphere.basicRadiance; },
       .remark = "basic radiance on|basic radiance off",
       .paragraph =
           "Switch for basic radiance L/n2, which refraction leaves as it is: what importance needs to pass "
           "through refracting materials."});
  add({.name = "-Sd",
       .group = Group::sphere,
       .value = +[](O& o) -> bool& { return o.sphere.everyDirection; },
       .remark = "every direction|mean of directions",
       .paragraph = "Switch for a record of every direction instead of the mean of a point; see Output under "
                    "DESCRIPTION."});
}

// Options of rsphere that hold in ray mode as well.
void addBothModesOptions(const Add& add) {
  add({.name = "-Ss",
       .arguments = "N",
       .group = Group::sphere,
       .value = +[](O& o) -> int& { return o.ray.chosenSources; },
       .range = {0, 1e6},
       .remark = "light sources tested at a surface",
       .paragraph = "Of all light sources test N (fewer for rays of less weight) at a surface whose radiance "
                    "is even, drawn "
                    "at random in proportion to what each would bring if nothing were in its way; -dt, -dc, "
                    "-dj and -ds then "
                    "do not count there. 0: all of them. Holds in ray mode as well."});
  add({.name = "-Sm",
       .arguments = "MB",
       .group = Group::sphere,
       .value = +[](O& o) -> double& { return o.ray.fieldMemory; },
       .range = {0, 1e9},
       .unit = "MB",
       .remark = "memory of interpolation",
       .paragraph =
           "Bound on the memory of the sites between which indirect light is interpolated in ray mode (-aa "
           "above 0), in millions of bytes. When it is full, sites are discarded, and computed again when "
           "they are needed again: answers stay the same, only the time grows. The coarse solution of later "
           "bounces is not included and has no bound; it grows with the number of surfaces that paths "
           "reach. 0: no bound. Not together with -af. In sphere mode nothing is interpolated between "
           "sites, and the bound has no effect."});
  add({.name = "-Sr",
       .arguments = "N",
       .group = Group::sphere,
       .value = Custom{setRotation},
       .range = kCount,
       .remark = "rotation and random numbers",
       .paragraph =
           "Another rotation of the base directions and other random numbers for each N, so that repeated "
           "runs show the spread of the answers. In ray mode it changes the random numbers.",
       .line = +[](const O& o) { return fmt::format("-Sr {:<9}\t\t\t", o.sphere.rotation); }});
  add({.name = "-Sc",
       .group = Group::sphere,
       .value = +[](O& o) -> bool& { return o.commands; },
       .remark = "scene commands on|scene commands off",
       .paragraph =
           "Switch for whether commands in scene files (lines with !) may run. xform always works: it needs "
           "no other program. Off, for scenes of strangers, it also keeps the files that scene files name "
           "(xform, octrees, meshes, data, pictures, fonts, functions, BSDFs) to regular files in the "
           "folders "
           "of what the command line names and of RAYPATH, or below them, wherever symbolic links may point. "
           "Holds in ray mode as well."});
}

// What shows how an answer came about.
void addInspectionOptions(const Add& add) {
  add({.name = "-Sv",
       .group = Group::sphere,
       .value = +[](O& o) -> bool& { return o.sphere.verify; },
       .remark = "verify weights|weights not verified",
       .paragraph =
           "Switch for verifying the weights of each point: that they sum to 4 pi and that no circle through "
           "three neighbours holds a fourth. Stops with an error where they fail."});
  add({.name = "-Si",
       .arguments = "pic",
       .group = Group::sphere,
       .value = +[](O& o) -> std::string& { return o.picture; },
       .remark = "picture of each point",
       .paragraph =
           "Draw a picture of what arrives at each point from all directions, in the format that its name "
           "asks for, with a ray through each pixel besides the directions of the answer: half a million, "
           "whatever -Sn is, which takes seconds a point. Light sources have their own radiance and size. "
           "Indirect light is averaged over pixels nearby; a larger -ad makes it smoother. RADIANCE "
           "pictures (.hdr, .pic) are an angular fisheye of 360 degrees, +y in the middle and +z above it, "
           "with the command, SOFTWARE= and VIEW= in the header: pinterp makes other views of them, as the "
           "half that evalglare asks for. In all other formats the columns are the azimuth from the x "
           "axis, counterclockwise about z, and the rows go from the zenith to the nadir: radiance in EXR "
           "and TIFF, else colours exposed so that the median is mid-bright. %d in the name (or %04d and "
           "the like) becomes the number of the record, from 0."});
  add({.name = "-Sl",
       .group = Group::sphere,
       .value = +[](O& o) -> bool& { return o.listSpecial; },
       .remark = "list special objects|answers",
       .paragraph =
           "Switch for a list of the scene's special objects instead of answers: a line for each with its "
           "place, material, density of directions (1/sr) and why it is special, separated by tabs. Nothing "
           "is read from standard input."});
}

// The order is that of rtrace's -defaults. From -ap to -t follow options of rtrace that its
// -defaults does not print.
std::vector<OptionEntry> makeTable() {
  std::vector<OptionEntry> table;
  for (const auto addOptions :
       {addRecordOptions,    addFormatOptions,    addColorOptions,   addRayOptions,       addShadowOptions,
        addSourceOptions,    addSpecularOptions,  addAmbientOptions, addGatheringOptions, addMediumOptions,
        addSpectrumOptions,  addLimitOptions,     addPhotonOptions,  addModifierOptions,  addTreeOptions,
        addProgramOptions,   addDirectionOptions, addWeightOptions,  addAnswerOptions,    addBothModesOptions,
        addInspectionOptions})
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
  // The mean of thousands of unbiased directions needs few samples in each of them. The defaults are four
  // indirect paths for each direction, all light sources sampled over their whole size, and all highlights
  // followed. Measured in the open-plan office of examples (50 spheres, -ab 3):
  //   paths      rms error   time for a point
  //   1          .49%        69 ms
  //   4          .37%        161 ms
  //   9          .34%        331 ms
  options.ray.ambientDivisions = 4;
  options.ray.ambientSuperSamples = 0;
  options.ray.ambientAccuracy = 0;
  options.ray.directJitter = 1;
  options.ray.directThreshold = 0;
  options.ray.specularThreshold = 0;
  // A tenth of rtrace's default. Russian roulette keeps the mean unbiased for any value, which only affects
  // noise and time. Measured with -Sn 512 and 60 repeats:
  // - The rms error of the open-plan office (-ab 3) is .40 to .47%, equal within its own error, for values
  //   from .1 down to 1e-6. The time is .4 to 1.1 times that of 1e-5.
  // - The rms error of a white room (reflectance .9, -ab 9) is .87% at .1, and .74% from .01 down.
  // The default is chosen small for scenes in which paths of little weight find something very bright.
  options.ray.weightLimit = 1e-5;
  return options;
}

}  // namespace rsphere
