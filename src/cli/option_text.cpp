#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <ranges>

#include "answer/column_names.h"
#include "answer/header.h"
#include "base/overloaded.h"
#include "cli/option_table.h"

namespace rsphere {
namespace {

// The part of a remark that applies to the value of a switch; for other options the remark.
std::string_view plainRemark(const OptionEntry& entry, Options& options) {
  const auto* const value = std::get_if<SwitchValue>(&entry.value);
  if (value == nullptr) return entry.remark;
  const size_t bar = entry.remark.find('|');
  return (*value)(options) ? entry.remark.substr(0, bar) : entry.remark.substr(bar + 1);
}

// The remark after '#' in -defaults, which may depend on values.
std::string remarkOf(const OptionEntry& entry, Options& options) {
  if (entry.name == "-co" && options.color.space != ColorSpace::spectrum) return "output tristimulus colors";
  if (entry.name == "-x" && options.height != 0 && options.width != 0) return "x resolution";
  if (entry.name == "-lr" && options.ray.reflectionLimit <= 0) return "limit reflection (Russian roulette)";
  if (entry.name == "-f") {
    return fmt::format("{} = {}/{}", entry.remark, formatName(options.in, options.color),
                       formatName(options.out, options.color));
  }
  if (entry.name == "-o") {
    std::string remark(entry.remark);
    const std::string_view tree = options.treeShadows || !options.treeOutputs.empty() ? "t" : "";
    for (const char letter : fmt::format("{}{}{}", options.outputs, tree, options.treeOutputs))
      if (const auto name = letterName(letter, options); !name.empty()) remark += fmt::format(" {}", name);
    return remark;
  }
  return std::string(plainRemark(entry, options));
}

// The line of -defaults before its remark, with rtrace's number formats and tabs.
std::string lineOf(const OptionEntry& entry, Options& options) {
  if (entry.line != nullptr) return entry.line(options);
  const std::string_view name = entry.name;
  return match(
      entry.value,
      [&](SwitchValue value) { return fmt::format("{}{}\t\t\t\t", name, value(options) ? '+' : '-'); },
      [&](OneOf<IntegerValue, CountValue> auto value) {
        return fmt::format("{} {:<9}\t\t\t", name, value(options));
      },
      [&](RealValue value) { return fmt::format("{} {:f}\t\t\t", name, value(options)); },
      [&](ColorValue value) {
        const Color& c = value(options);
        return fmt::format("{} {:f} {:f} {:f}\t", name, c.x, c.y, c.z);
      },
      [&](WordValue value) {
        return value(options).empty() ? "" : fmt::format("{} {}\t\t", name, value(options));
      },
      [&](WordsValue value) {
        std::string words;
        for (const std::string& word : value(options)) words += fmt::format("{} {} ", name, word);
        return words.empty() ? "" : words + "\t\t";
      },
      [](OneOf<std::monostate, Custom> auto) { return std::string(); });
}

// What a switch toggles: "back face visibility" of "back face visibility on|back face visibility off".
std::string_view toggledBy(std::string_view remark) {
  remark = remark.substr(0, remark.find('|'));
  if (remark.ends_with(" on")) remark.remove_suffix(3);
  return remark;
}

std::string helpLine(const OptionEntry& entry, Options& values) {
  const bool isSwitch = std::holds_alternative<SwitchValue>(entry.value);
  const std::string use = fmt::format("{}{}{}", entry.name,
                                      isSwitch      ? "[+|-]"
                                      : entry.glued ? ""
                                                    : " ",
                                      entry.arguments);
  const std::string value = shortValue(entry, values);
  // Two blanks at least, by which the arguments are told from the text.
  return fmt::format("  {:<20} {}{}{}\n", use, use.size() < 20 ? "" : " ",
                     !entry.help.empty() ? entry.help
                     : isSwitch          ? toggledBy(entry.remark)
                                         : entry.remark,
                     entry.support == Support::unused ? " (no effect)"
                     : value.empty()                  ? ""
                                                      : fmt::format(" [{}]", value));
}

constexpr std::string_view kSceneHelp =
    "A scene is an octree, RADIANCE scene files, or a '!command' that writes one of them.\n";

// What -help lists, in words for those who are new to the program.
struct UsualOption {
  std::string_view name, text;
};
constexpr std::array<UsualOption, 12> kUsualOfPoints{
    {{"-pY", "lux and cd/m2 instead of red, green and blue"},
     {"-o", "v mean luminance, E scalar, C cylindrical lux, H on six faces, e standard error"},
     {"-Sa", "adds directions until this relative standard error is reached: .01 is 1%"},
     {"-ab", "reflections that are followed"},
     {"-aa", ".1 is faster by daylight, from tens of points on"},
     {"-Su", "glare at eyes, x y z and the direction of the gaze: UGR, DGP"},
     {"-Si", "picture of what a point sees: view.png, or view%d.png for several points"},
     {"-Sg", "importance: where a lamp would serve the surfaces of this modifier"},
     {"-Sp", "a separate answer for each lamp, or for each goal of -Sg"},
     {"-cs", "bands of the spectrum, such as 20"},
     {"-h", "header before the answers"},
     {"-n", "cores; 0: all"}}};
constexpr std::array<UsualOption, 12> kUsualOfRays{
    {{"-I", "irradiance at sensors instead of radiance along rays"},
     {"-pY", "lux and cd/m2 instead of red, green and blue"},
     {"-o", "v radiance or irradiance, e its standard error, L distance, m modifier, and others"},
     {"-Sa", "all reflections, to this relative standard error: .01 is 1%"},
     {"-ab", "reflections that are followed, without -Sa"},
     {"-ad", "rays of a sensor or a diffuse surface, without -Sa"},
     {"-aa", "interpolated light: .1; 0: off"},
     {"-x", "width of a picture of rays, as vwrays writes them"},
     {"-y", "height of such a picture"},
     {"-f", "formats of input and output: a text, f floats, d doubles; output also c colors"},
     {"-h", "header before the answers"},
     {"-n", "cores; 0: all"}}};

// Features common to all programs, in RADIANCE's words.
constexpr std::string_view kSceneFeatures[] = {
    "VirtualSources",
    "SecondarySources",
    "SourceSubsampling",
    "SourceVisibility",
    "AmbientModifierSelection",
    "PathTracing",
    "RussianRoulette",
    "SpecularSampling",
    "MaterialMixtures",
    "Antimatter",
    "BackFaceVisibility",
    "ScatteringModels=WGMD,Ashikhmin-Shirley",
    "TabulatedBSDFs=DataFile,KlemsXML,TensorTreeXML,+ViewPeakExtraction",
    "Instancing=Octree,TriangleMesh",
    "Aliases"};

// Features of rsphere only, in rtrace's words.
constexpr std::string_view kRayFeatures[] = {"ShadowCache",
                                             "Multiprocessing",
                                             "IrradianceCalc",
                                             "ImmediateIrradiance",
                                             "DistanceLimiting",
                                             "ParticipatingMedia=Mist",
                                             "AdaptiveShadowTesting",
                                             "InputFormats=a,f,d",
                                             "OutputFormats=a,f,d,c",
                                             "Outputs=o,d,v,e,V,w,W,l,L,c,p,n,N,s,m,M,r,x,R,X,~",
                                             "OutputCS=RGB,XYZ,Y,S,M,prims,spec"};

bool hasSubfeatures(std::string_view feature, std::string_view wanted) {
  const size_t equals = feature.find('=');
  if (equals == std::string_view::npos) return false;
  const std::string list = fmt::format(",{},", feature.substr(equals + 1));
  return std::ranges::all_of(std::views::split(wanted, ','), [&](const auto& part) {
    const std::string_view one(part.begin(), part.end());
    return one.empty() || list.find(fmt::format(",{},", one)) != std::string::npos;
  });
}

}  // namespace

std::string shortValue(const OptionEntry& entry, Options& options) {
  if (entry.inEffect != nullptr) return entry.inEffect(options) ? "on" : "off";
  if (entry.support == Support::refused) return "";
  return match(
      entry.value, [&](SwitchValue value) -> std::string { return value(options) ? "on" : "off"; },
      [&](OneOf<IntegerValue, CountValue, RealValue> auto value) {
        return fmt::format("{}", value(options));
      },
      [&](ColorValue value) {
        const Color& c = value(options);
        return fmt::format("{} {} {}", c.x, c.y, c.z);
      },
      [&](const Custom&) -> std::string {
        const std::string line = entry.line != nullptr ? entry.line(options) : "";
        const size_t from = entry.name.size() + (entry.glued ? 0 : 1);
        if (line.size() <= from) return "";
        return line.substr(from, line.find_first_of(" \t", from) - from);
      },
      [](OneOf<std::monostate, WordValue, WordsValue> auto) { return std::string(); });
}

std::string defaultsText(const Options& options, bool (*takes)(const OptionEntry&)) {
  Options values = options;
  std::string text;
  for (const OptionEntry& entry : optionTable())
    if (const std::string line = lineOf(entry, values);
        !line.empty() && worksIn(entry, options.sphereMode) && (!takes || takes(entry)))
      text += fmt::format("{}# {}\n", line, remarkOf(entry, values));
  return text;
}

std::string helpText(const Options& options) {
  Options values = options;
  std::string text =
      fmt::format("usage: {} [options] scene... < records > answers\n{}", options.program, kSceneHelp);
  for (const auto& [group, name] : kGroups) {
    text += fmt::format("\n{}:\n", name);
    for (const OptionEntry& entry : optionTable())
      if (entry.group == group && entry.support != Support::refused) text += helpLine(entry, values);
  }
  return text + "\n-defaults prints all options with their values, -version the version. See rsphere(1).\n";
}

std::string usualHelp(const Options& options) {
  Options values = options;
  const bool points = options.sphereMode;
  std::string text =
      fmt::format("usage: {} [options] scene... < {} > answers\n\n{}{}", options.program,
                  points ? "points" : "rays", kSceneHelp,
                  points ? "A line of the input is a point: x y z.\n\n"
                         : "A ray, or a sensor of -I, is an origin and a direction: x y z dx dy "
                           "dz.\n\n");
  for (const UsualOption& usual : points ? kUsualOfPoints : kUsualOfRays) {
    OptionEntry entry = *std::ranges::find(optionTable(), usual.name, &OptionEntry::name);
    entry.help = usual.text;
    text += helpLine(entry, values);
  }
  return text + "\n-help all lists the other options, too. See rsphere(1).\n";
}

FeatureReport featureReport(std::span<const std::string> wanted, std::span<const std::string_view> features) {
  if (features.empty()) features = kRayFeatures;
  std::vector<std::string_view> all(std::begin(kSceneFeatures), std::end(kSceneFeatures));
  all.insert(all.end(), features.begin(), features.end());
  FeatureReport report;
  if (wanted.empty()) report.text = fmt::format("{}\n", fmt::join(all, "\n"));
  for (const std::string& want : wanted) {
    if (want.empty()) continue;
    const size_t equals = want.find('=');
    const std::string_view name = std::string_view(want).substr(0, equals);
    std::string_view found;
    for (const std::string_view feature : all)
      if (feature.substr(0, feature.find('=')) == name) found = feature;
    const bool has = !found.empty() && (equals == std::string::npos ||
                                        hasSubfeatures(found, std::string_view(want).substr(equals + 1)));
    if (!has) return {report.text, want};
    if (equals == std::string::npos && found.find('=') != std::string_view::npos)
      report.text += fmt::format("{}\n", found);
  }
  return report;
}

std::string companionHelp(const Companion& companion, Options& options) {
  std::string text = fmt::format("usage: {} {}\n\n", options.program, companion.usage);
  for (const OptionEntry& entry : companion.own) text += helpLine(entry, options);
  return text + fmt::format("\nThe other options are those of rsphere: see rsphere -help and {}(1).\n",
                            options.program);
}

std::string companionDefaults(const Companion& companion, Options& options) {
  std::string text = defaultsText(options, companion.takes);
  for (const OptionEntry& entry : companion.own)
    if (const std::string line = lineOf(entry, options); !line.empty())
      text += fmt::format("{}# {}\n", line, plainRemark(entry, options));
  return text;
}

}  // namespace rsphere
