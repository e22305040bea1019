#include "cli/option_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "tests/unit/support/command_line.h"

namespace rsphere {
namespace {

TEST(OptionTable, NamesAreDistinct) {
  std::set<std::pair<std::string_view, bool>> names;
  for (const OptionEntry& entry : optionTable()) {
    EXPECT_TRUE(names.insert({entry.name, entry.glued}).second) << entry.name;
    EXPECT_EQ(entry.name[0], '-');
  }
}

TEST(OptionTable, EveryEntryIsComplete) {
  for (const OptionEntry& entry : optionTable()) {
    SCOPED_TRACE(entry.name);
    EXPECT_FALSE(entry.remark.empty());
    EXPECT_EQ(entry.reason.empty(), entry.support != Support::refused);
    EXPECT_FALSE(std::holds_alternative<std::monostate>(entry.value));
    const bool isSwitch = std::holds_alternative<SwitchValue>(entry.value);
    EXPECT_EQ(isSwitch, entry.remark.find('|') != std::string_view::npos);
    EXPECT_TRUE(!isSwitch || entry.arguments.empty());
    EXPECT_LE(entry.range.lowest, entry.range.highest);
  }
}

TEST(OptionTable, EveryOptionOfRtraceIsThere) {
  // The options in rtrace(1) of RADIANCE 6.1a.
  for (const std::string_view name :
       {"-f",  "-o",  "-te", "-ti",   "-tE",   "-tI", "-i",  "-u",  "-I",  "-h",  "-x",  "-y",
        "-n",  "-e",  "-dj", "-ds",   "-dt",   "-dc", "-dr", "-dp", "-dv", "-ss", "-st", "-bv",
        "-av", "-aw", "-ab", "-ar",   "-aa",   "-ad", "-as", "-af", "-ae", "-ai", "-aE", "-aI",
        "-ap", "-am", "-ac", "-aC",   "-me",   "-ma", "-mg", "-ms", "-lr", "-lw", "-ld", "-cs",
        "-cw", "-co", "-pc", "-pRGB", "-pXYZ", "-pY", "-pS", "-pM", "-pA", "-w",  "-P",  "-PP"})
    EXPECT_TRUE(std::any_of(optionTable().begin(), optionTable().end(), [&](const OptionEntry& entry) {
      return entry.name == name;
    })) << name;
}

TEST(OptionTable, DefaultsAreInTheirRanges) {
  for (const bool sphere : {false, true}) {
    Options options = modeDefaults(sphere);
    for (const OptionEntry& entry : optionTable()) {
      const auto expectInside = [&](double x) {
        EXPECT_GE(x, entry.range.lowest) << entry.name;
        EXPECT_LE(x, entry.range.highest) << entry.name;
      };
      if (const auto* value = std::get_if<IntegerValue>(&entry.value)) expectInside((*value)(options));
      if (const auto* value = std::get_if<CountValue>(&entry.value))
        expectInside(static_cast<double>((*value)(options)));
      if (const auto* value = std::get_if<RealValue>(&entry.value)) expectInside((*value)(options));
      if (const auto* value = std::get_if<ColorValue>(&entry.value))
        for (int i = 0; i < 3; ++i) expectInside((*value)(options)[i]);
    }
  }
}

// Tests each number at both ends of its range, and just outside.
TEST(OptionTable, RangesHold) {
  for (const OptionEntry& entry : optionTable()) {
    const bool integer =
        std::holds_alternative<IntegerValue>(entry.value) || std::holds_alternative<CountValue>(entry.value);
    const bool real = std::holds_alternative<RealValue>(entry.value);
    if (!integer && !real) continue;
    const auto accepted = [&](double x) {
      const std::string word = integer ? fmt::format("{:.0f}", x) : fmt::format("{:.17g}", x);
      std::vector<std::string> words{entry.mode == Mode::points ? "rsphere" : "rtrace",
                                     std::string(entry.name), word, "s.oct"};
      if (entry.name == "-Sub") words.insert(words.begin() + 1, "-Su");
      if (entry.name.starts_with("-Si") && entry.name != "-Si")
        words.insert(words.begin() + 1, {"-Si", "x.png"});
      if (entry.name == "-Sx") words.insert(words.begin() + 1, {"-Sn", "1"});
      if (entry.name == "-lw") words.insert(words.begin() + 1, {"-lr", "1"});
      try {
        parseOptions(words);
        return true;
      } catch (const rad::Error& error) {
        EXPECT_EQ(std::string(error.what()).find(fmt::format("command line error at '{}'", entry.name)), 0u)
            << error.what();
        return false;
      }
    };
    SCOPED_TRACE(entry.name);
    if (std::isfinite(entry.range.lowest)) {
      EXPECT_TRUE(accepted(entry.range.lowest));
      EXPECT_FALSE(
          accepted(integer ? entry.range.lowest - 1 : std::nextafter(entry.range.lowest, -INFINITY)));
    }
    if (std::isfinite(entry.range.highest)) {
      EXPECT_EQ(accepted(entry.range.highest), entry.name != "-Sa") << "an error of 1 is no accuracy";
      EXPECT_FALSE(
          accepted(integer ? entry.range.highest + 1 : std::nextafter(entry.range.highest, INFINITY)));
    }
  }
}

TEST(OptionTable, MissingAndWrongWordsAreErrorsAtTheirOption) {
  for (const OptionEntry& entry : optionTable()) {
    if (arity(entry) == 0) continue;
    std::vector<std::string> words{"rsphere", std::string(entry.name)};
    for (int i = 1; i < arity(entry); ++i) words.push_back("0");
    const std::string at = fmt::format("command line error at '{}': ", entry.name);
    const std::string missing = faultOf([&] { parseOptions(words); });
    EXPECT_TRUE(missing.starts_with(at)) << missing;
    EXPECT_NE(
        missing.find(fmt::format("({} {}): the command line ends; see -help", entry.name, entry.arguments)),
        std::string::npos)
        << missing;
    const bool number = !std::holds_alternative<WordValue>(entry.value) &&
                        !std::holds_alternative<WordsValue>(entry.value) &&
                        !std::holds_alternative<Custom>(entry.value);
    if (!number || entry.support == Support::refused) continue;
    words.insert(words.end(), {"x1", "s.oct"});
    const std::string wrong = faultOf([&] { parseOptions(words); });
    EXPECT_TRUE(wrong.starts_with(at + "\"x1\" is not a ")) << wrong;
    EXPECT_TRUE(wrong.ends_with("; see -help")) << wrong;
  }
}

TEST(OptionTable, RefusedOptionsSayWhy) {
  for (const OptionEntry& entry : optionTable()) {
    if (entry.support != Support::refused) continue;
    std::vector<std::string> words{"rsphere", std::string(entry.name)};
    for (int i = 0; i < arity(entry); ++i) words.push_back("1");
    words.push_back("s.oct");
    EXPECT_EQ(faultOf([&] { parseOptions(words); }),
              fmt::format("option '{}' is not supported: {}", entry.name, entry.reason));
  }
}

TEST(OptionTable, RefusedOptionsPassWhereTheyAskForNothing) {
  EXPECT_NO_THROW(parse({"rtrace", "-me", "0", "0.0", "0e1", "-ms", "0.063", "s.oct"}));
}

// The output of rtrace -defaults (RADIANCE 6.1a), byte for byte.
constexpr const char* kRtraceDefaults =
    "-w+\t\t\t\t# warning messages on\n"
    "-n 1 \t\t\t\t# number of rendering processes\n"
    "-x 0        \t\t\t# flush interval\n"
    "-y 0        \t\t\t# y resolution\n"
    "-ld-\t\t\t\t# limit distance off\n"
    "-h+\t\t\t\t# output header\n"
    "-faa\t\t\t\t# format input/output = ascii/ascii\n"
    "-ov        \t\t\t# output value\n"
    "-pRGB\t\t\t\t# standard RGB color output\n"
    "-i-\t\t\t\t# irradiance calculation off\n"
    "-u+\t\t\t\t# uncorrelated Monte Carlo sampling\n"
    "-bv+\t\t\t\t# back face visibility on\n"
    "-dt 0.030000\t\t\t# direct threshold\n"
    "-dc 0.750000\t\t\t# direct certainty\n"
    "-dj 0.000000\t\t\t# direct jitter\n"
    "-ds 0.200000\t\t\t# direct sampling\n"
    "-dr 2        \t\t\t# direct relays\n"
    "-dp 512      \t\t\t# direct pretest density\n"
    "-dv+\t\t\t\t# direct visibility on\n"
    "-ss 1.000000\t\t\t# specular sampling\n"
    "-st 0.150000\t\t\t# specular threshold\n"
    "-av 0.000000 0.000000 0.000000\t# ambient value\n"
    "-aw 0        \t\t\t# ambient value weight\n"
    "-ab 0        \t\t\t# ambient bounces\n"
    "-aa 0.100000\t\t\t# ambient accuracy\n"
    "-ar 256      \t\t\t# ambient resolution\n"
    "-ad 1024     \t\t\t# ambient divisions\n"
    "-as 512      \t\t\t# ambient super-samples\n"
    "-me 0.00e+00 0.00e+00 0.00e+00\t# mist extinction coefficient\n"
    "-ma 0.000000 0.000000 0.000000\t# mist scattering albedo\n"
    "-mg 0.000000\t\t\t# mist scattering eccentricity\n"
    "-ms 0.000000\t\t\t# mist sampling distance\n"
    "-lr -10      \t\t\t# limit reflection (Russian roulette)\n"
    "-lw 1.00e-04\t\t\t# limit weight\n"
    "-am 0.0\t\t\t\t# max photon search radius\n";

TEST(Defaults, BeginAsThoseOfRtrace) {
  const std::string text = defaultsText(parse({"rtrace", "-defaults"}));
  EXPECT_EQ(text.substr(0, std::string(kRtraceDefaults).size()), kRtraceDefaults);
  EXPECT_NE(text.find("\n-S-\t\t\t\t# sphere mode off (rays)\n"), std::string::npos);
}

// The output of rtrace -I -i -w -x 10 -y 3 -n 12 -ffc -u -lr 5 -ab 2 -av 1 2 3 -h -ld -ovldN~ -dv- -bv0 -lw
// 0 -am 2.5 -defaults (6.1a)
TEST(Defaults, ShowTheOptionsBeforeThemAsThoseOfRtrace) {
  const std::string text = defaultsText(
      parse({"rtrace",   "-I",   "-i",   "-w",  "-x", "10",  "-y",  "3",         "-n",  "12", "-ffa",
             "-u",       "-lr",  "5",    "-ab", "2",  "-av", "1",   "2",         "3",   "-h", "-ld",
             "-ovldN~c", "-dv-", "-bv0", "-lw", "0",  "-am", "2.5", "-defaults", "-ab", "9"}));
  const std::string expected =
      "-w-\t\t\t\t# warning messages off\n"
      "-I+\t\t\t\t# immediate irradiance on\n"
      "-n 12\t\t\t\t# number of rendering processes\n"
      "-x 10       \t\t\t# x resolution\n"
      "-y 3        \t\t\t# y resolution\n"
      "-ld+\t\t\t\t# limit distance on\n"
      "-h-\t\t\t\t# no header\n"
      "-ffa\t\t\t\t# format input/output = float/ascii\n"
      "-ovldN~c   \t\t\t# output value length direction unperturbed_normal tilde\n"
      "-pRGB\t\t\t\t# standard RGB color output\n"
      "-i+\t\t\t\t# irradiance calculation on\n"
      "-u-\t\t\t\t# correlated quasi-Monte Carlo sampling\n"
      "-bv-\t\t\t\t# back face visibility off\n";
  EXPECT_EQ(text.substr(0, expected.size()), expected);
  EXPECT_NE(
      text.find(
          "-lr 5        \t\t\t# limit reflection\n-lw 0.00e+00\t\t\t# limit weight\n-am 2.5\t\t\t\t# max "),
      std::string::npos);
  EXPECT_NE(text.find("-dv-\t\t\t\t# direct visibility off\n"), std::string::npos);
}

// Without its remarks, which begin with '#', the text is a file of options that changes nothing.
TEST(Defaults, CanBeReadBack) {
  for (const std::initializer_list<const char*> words :
       {std::initializer_list<const char*>{"rtrace", "-defaults"},
        {"rsphere", "-defaults"},
        {"rsphere", "-Sd", "-Sg", "goal", "-Sg", "other", "-Sw", "v", "-Sr", "7", "-Si", "p%d.exr", "-af",
         "a.amb", "-t", "2", "-defaults"},
        {"rtrace", "-pc", ".7", ".3", ".2", ".7", ".1", ".1", ".31", ".33", "-ov~tmW", "-cs", "5",
         "-defaults"},
        {"rtrace", "-oT", "-co", "-cs", "12", "-cw", "400", "700", "-defaults"},
        {"rtrace", "-pS", "-ovTm", "-defaults"},
        {"rtrace", "-I", "-n", "0", "-x", "7", "-y", "9", "-fda", "-ovs", "-w", "-e", "err.txt", "-lr", "4",
         "-defaults"}}) {
    const std::string text = defaultsText(parse(words));
    std::istringstream lines(text);
    std::string values;
    for (std::string line; std::getline(lines, line);) values += line.substr(0, line.find('#')) + "\n";
    const TemporaryFile file(values);
    EXPECT_EQ(defaultsText(parse({*words.begin(), ("@" + file.path).c_str(), "-defaults"})), text);
  }
}

TEST(Defaults, OfSphereModeAreItsOwn) {
  const Options sphere = modeDefaults(true), rays = modeDefaults(false);
  EXPECT_TRUE(sphere.sphereMode);
  EXPECT_EQ(sphere.ray.ambientDivisions, 4);
  EXPECT_EQ(sphere.ray.directJitter, 1);
  EXPECT_EQ(sphere.ray.directThreshold, 0);
  EXPECT_EQ(sphere.ray.specularThreshold, 0);
  EXPECT_EQ(sphere.ray.ambientBounces, RayOptions::kAllBounces);
  EXPECT_EQ(rays.ray.ambientBounces, 0);
  EXPECT_EQ(rays.ray.ambientDivisions, 1024);
  EXPECT_EQ(rays.ray.leastForPatches, 0);
}

// The error of patches falls with that of directions, whatever -ad is.
TEST(Defaults, RaysOfPatchesFollowDirections) {
  const auto rays = [](std::initializer_list<const char*> words) { return parse(words).ray.leastForPatches; };
  EXPECT_EQ(rays({"rsphere", "-aa", ".1", "-defaults"}), 1024);
  EXPECT_EQ(rays({"rsphere", "-Sn", "8192", "-defaults"}), 8192);
  EXPECT_EQ(rays({"rsphere", "-Sn", "512", "-ad", "16", "-defaults"}), 256);
  EXPECT_EQ(rays({"rsphere", "-Sa", ".05", "-defaults"}), 1024);
  EXPECT_EQ(rays({"rsphere", "-Sa", ".005", "-defaults"}), 4096);
  EXPECT_EQ(rays({"rsphere", "-S-", "-defaults"}), 0);
}

// -defaults prints what rtrace prints, but a repeated ray is a new sample only where -u+ is given.
TEST(Help, StatesWhetherRepeatedRaysAreNewSamples) {
  const auto stated = [](std::initializer_list<const char*> words) {
    const std::string text = helpText(parse(words));
    const size_t at = text.find("  -u[+|-]");
    return at == text.npos
               ? text
               : text.substr(text.find('[', at + 10), text.find('\n', at) - text.find('[', at + 10));
  };
  EXPECT_EQ(stated({"rtrace", "-help"}), "[off]");
  EXPECT_EQ(stated({"rtrace", "-u+", "-help"}), "[on]");
  EXPECT_EQ(stated({"rtrace", "-u-", "-help"}), "[off]");
  EXPECT_NE(defaultsText(parse({"rtrace", "-defaults"})).find("-u+\t"), std::string::npos);
}

TEST(Help, HasALineForEveryOptionThatWorks) {
  const std::string text = helpText(parse({"rsphere", "-help"}));
  for (const OptionEntry& entry : optionTable())
    EXPECT_EQ(
        text.find(fmt::format("\n  {}{}", entry.name, arity(entry) > 0 ? " " : "")) != std::string::npos,
        entry.support != Support::refused)
        << entry.name;
}

// Not "limit distance on [off]", as -defaults would print it for a switch that is on.
TEST(Help, NamesSwitchesByWhatTheyToggle) {
  const std::string text = helpText(parse({"rsphere", "-help"}));
  EXPECT_NE(text.find(" limit distance [off]\n"), text.npos);
  EXPECT_NE(text.find(" separate answers for each goal or lamp [off]\n"), text.npos);
}

TEST(Help, HasTwelveUsualOptionsOfEachMode) {
  const auto options = [](const std::string& text) {
    size_t lines = 0;
    for (size_t at = 0; (at = text.find("\n  -", at)) != text.npos; ++at) ++lines;
    return lines;
  };
  const std::string points = usualHelp(parse({"rsphere", "-Sa", ".02", "-help"}));
  const std::string rays = usualHelp(parse({"rtrace", "-help"}));
  EXPECT_EQ(options(points), 12u);
  EXPECT_EQ(options(rays), 12u);
  EXPECT_NE(points.find("is reached: .01 is 1% [0.02]\n"), points.npos);
  for (const std::string& text : {points, rays}) {
    for (size_t at = 0, end; (end = text.find('\n', at)) != text.npos; at = end + 1)
      EXPECT_LE(end - at, 110u) << text.substr(at, end - at);
    for (const OptionEntry& entry : optionTable())
      EXPECT_TRUE(worksIn(entry, text == points) ||
                  text.find(fmt::format("\n  {} ", entry.name)) == text.npos)
          << entry.name;
  }
}

TEST(Features, AreListedAndAskedFor) {
  const Options options = parse({"rtrace", "-features", "-ab", "x"});
  EXPECT_EQ(options.request, Request::features);
  EXPECT_EQ(options.features, (std::vector<std::string>{"-ab", "x"}));
  const auto ask = [](std::vector<std::string> words) { return featureReport(words); };
  EXPECT_NE(ask({}).text.find("RussianRoulette\n"), std::string::npos);
  EXPECT_EQ(ask({"Aliases", "InputFormats=a,d"}).missing, "");
  EXPECT_EQ(ask({"InputFormats"}).text, "InputFormats=a,f,d\n");
  EXPECT_EQ(ask({"InputFormats=a,c"}).missing, "InputFormats=a,c");
  EXPECT_EQ(ask({"Aliases=x"}).missing, "Aliases=x");
  EXPECT_EQ(ask({"Alias"}).missing, "Alias");
  EXPECT_EQ(ask({"Aliases", "Hyperspectral"}).missing, "Hyperspectral");
}

// The letters that -o accepts behind these words.
std::string acceptedLetters(std::vector<std::string> words) {
  std::string accepted;
  words.insert(words.end(), {"-o", "s.oct"});
  for (char letter = '!'; letter <= '~'; ++letter) {
    words[words.size() - 2] = std::string("-o") + letter;
    try {
      if (parseOptions(words).outputs == std::string_view(&letter, 1)) accepted += letter;  // t, T: trees
    } catch (const rad::Error&) {
    }
  }
  return accepted;
}

TEST(OutputLetters, HaveNamesInDefaults) {
  const std::vector<std::vector<std::string>> modes = {
      {"rtrace"}, {"rsphere", "-Sz", "4"}, {"rsphere", "-Sd"}, {"rsphere", "-Su"}, {"rsphere", "-Su", "-Sd"}};
  for (const auto& mode : modes) {
    const std::string letters = acceptedLetters(mode);
    EXPECT_GE(letters.size(), 6u);
    for (const char letter : letters) {
      if (letter == 'c') continue;  // has no name in rtrace either
      std::vector<std::string> words = mode;
      words.insert(words.end(), {std::string("-o") + letter, "s.oct"});
      const std::string text = defaultsText(parseOptions(words));
      const size_t line = text.find(std::string("\n-o") + letter + ' ');
      ASSERT_NE(line, std::string::npos) << mode.back() << ' ' << letter;
      EXPECT_LT(text.find("# output ", line), text.find('\n', line + 1)) << mode.back() << ' ' << letter;
    }
  }
}

TEST(OutputLetters, OfRaysAreListedAmongTheFeatures) {
  const std::string letters = acceptedLetters({"rtrace"});
  EXPECT_GE(letters.size(), 19u);
  for (const char letter : letters) {
    const std::vector<std::string> wanted = {std::string("Outputs=") + letter};
    EXPECT_EQ(featureReport(wanted).missing, "") << letter;
  }
}

}  // namespace
}  // namespace rsphere
