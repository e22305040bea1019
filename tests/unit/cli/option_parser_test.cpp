#include "tests/unit/support/command_line.h"

namespace rsphere {
namespace {

using Names = std::vector<std::string>;

TEST(ParseOptions, ModeComesFromTheNameAndFromS) {
  EXPECT_TRUE(parse({"rsphere", "s.oct"}).sphereMode);
  EXPECT_TRUE(parse({"/usr/bin/rsphere", "s.oct"}).sphereMode);
  EXPECT_FALSE(parse({"rtrace", "s.oct"}).sphereMode);
  EXPECT_FALSE(parse({"/a.b/rtrace", "s.oct"}).sphereMode);
  EXPECT_TRUE(parse({"/rtrace/x", "s.oct"}).sphereMode);
  EXPECT_FALSE(parse({"rsphere", "-S-", "s.oct"}).sphereMode);
  EXPECT_FALSE(parse({"rsphere", "-S", "s.oct"}).sphereMode);
  EXPECT_TRUE(parse({"rtrace", "-S", "s.oct"}).sphereMode);
  EXPECT_TRUE(parse({"rtrace", "-S+", "-S-", "-S1", "s.oct"}).sphereMode);
}

TEST(ParseOptions, DefaultsAreThoseOfTheModeWhereverItIsGiven) {
  const Options options = parse({"rsphere", "-ad", "7", "-dt", ".5", "-S-", "s.oct"});
  EXPECT_EQ(options.ray.ambientDivisions, 7);
  EXPECT_EQ(options.ray.directThreshold, .5);
  EXPECT_EQ(options.ray.directJitter, 0);
  EXPECT_EQ(parse({"rtrace", "-ab", "2", "-S+", "s.oct"}).ray.directJitter, 1);
}

// The part of a fault's text that rtrace writes too, which precedes the reason.
std::string beginningOfFault(std::initializer_list<const char*> words) {
  const std::string fault = faultOfOptions(words);
  const size_t reason = fault.find(": ");
  EXPECT_NE(reason, std::string::npos) << fault << ": no reason";
  return fault.substr(0, reason);
}

TEST(ParseOptions, SwitchesToggleOrAreSet) {
  EXPECT_FALSE(parse({"rtrace", "-h", "s.oct"}).header);
  EXPECT_TRUE(parse({"rtrace", "-h", "-h", "s.oct"}).header);
  for (const char* on : {"-ld+", "-ld1", "-ldy", "-ldY", "-ldt", "-ldT"})
    EXPECT_TRUE(parse({"rtrace", "-ld", on, "s.oct"}).limitDistance);
  for (const char* off : {"-w-", "-w0", "-wn", "-wN", "-wf", "-wF"})
    EXPECT_FALSE(parse({"rtrace", off, "s.oct"}).messages.warnings);
  for (const char* wrong : {"-hx", "-h2", "-h+-", "-w+1", "-u?"})
    EXPECT_EQ(beginningOfFault({"rtrace", wrong, "s.oct"}),
              std::string("command line error at '") + wrong + "'");
}

TEST(ParseOptions, LettersAfterSAreOptionsNotSwitches) {
  EXPECT_EQ(parse({"rsphere", "-Sn", "5", "s.oct"}).sphere.baseDirections, 5);
  EXPECT_FALSE(parse({"rsphere", "-Sc-", "s.oct"}).commands);
  EXPECT_TRUE(parse({"rsphere", "-Sd", "s.oct"}).sphere.everyDirection);
}

// The words of rtrace (6.1a), with exit status 1.
TEST(ParseOptions, ErrorsAreWordedAsThoseOfRtrace) {
  EXPECT_EQ(beginningOfFault({"rtrace", "-ab", "1.5", "s.oct"}), "command line error at '-ab'");
  EXPECT_EQ(beginningOfFault({"rtrace", "-ab", "x", "s.oct"}), "command line error at '-ab'");
  EXPECT_EQ(beginningOfFault({"rtrace", "-ab", "s.oct"}), "command line error at '-ab'");
  EXPECT_EQ(beginningOfFault({"rtrace", "-av", "1", "2", "s.oct"}), "command line error at '-av'");
  EXPECT_EQ(beginningOfFault({"rtrace", "-dt", "1e", "s.oct"}), "command line error at '-dt'");
  EXPECT_EQ(beginningOfFault({"rtrace", "-dt", "1,5", "s.oct"}), "command line error at '-dt'");
  EXPECT_EQ(beginningOfFault({"rtrace", "-q", "3", "s.oct"}), "command line error at '-q'");
  EXPECT_EQ(beginningOfFault({"rtrace", "-", "s.oct"}), "command line error at '-'");
  EXPECT_EQ(beginningOfFault({"rtrace", "-abc", "s.oct"}), "command line error at '-abc'");
  EXPECT_EQ(beginningOfFault({"rtrace", "-pRG", "s.oct"}), "command line error at '-pRG'");
  EXPECT_EQ(beginningOfFault({"rtrace", "-n", "-1", "s.oct"}), "bad number of processes");
  EXPECT_EQ(beginningOfFault({"rtrace"}), "missing octree argument");
  EXPECT_EQ(beginningOfFault({"rtrace", "-ab", "1"}), "missing octree argument");
  EXPECT_EQ(beginningOfFault({"rtrace", "s.oct", "-ab", "1"}), "command line error at 's.oct'");
  EXPECT_EQ(beginningOfFault({"rsphere", "a.rad", "b.rad", "-h"}), "command line error at 'a.rad'");
}

// The text after rtrace's words gives the reason and a remedy.
TEST(ParseOptions, ErrorsOfTheCommandLineSayWhy) {
  const auto why = [](std::initializer_list<const char*> words) {
    const std::string fault = faultOfOptions(words);
    EXPECT_TRUE(fault.ends_with("; see -help")) << fault;
    return fault.substr(0, fault.rfind("; see -help"));
  };
  EXPECT_EQ(why({"rtrace", "-h"}),
            "missing octree argument: an octree, scene files or a '!command' that makes them come after the "
            "options");
  EXPECT_EQ(why({"rtrace", "-ab", "2.5", "s.oct"}),
            "command line error at '-ab': \"2.5\" is not a whole number of at least 0");
  EXPECT_EQ(why({"rsphere", "-Sa", "1%", "s.oct"}),
            "command line error at '-Sa': \"1%\" is not a number from 0 to 1: 1% is written 0.01");
  EXPECT_EQ(why({"rsphere", "-Sn", "1e9", "s.oct"}),
            "command line error at '-Sn': \"1e9\" is not a whole number in digits from 1 to 1000000");
  EXPECT_EQ(why({"rsphere", "-Sn", "1000000000", "s.oct"}),
            "command line error at '-Sn': 1000000000 is not from 1 to 1000000");
  EXPECT_EQ(why({"rtrace", "-lw", "0,1", "s.oct"}),
            "command line error at '-lw': \"0,1\" is not a number of at least 0: use a decimal point");
  EXPECT_EQ(why({"rtrace", "-lw", "-1", "s.oct"}), "command line error at '-lw': -1 is less than 0");
  EXPECT_EQ(why({"rtrace", "-I", "-ab"}),
            "command line error at '-ab': its value is missing (-ab N): the command line ends");
  EXPECT_EQ(why({"rtrace", "-av", "1"}),
            "command line error at '-av': 2 of its 3 values are missing (-av red grn blu): the command line "
            "ends");
  EXPECT_EQ(
      why({"rtrace", "-av", ".1", "box.rad"}),
      "command line error at '-av': \"box.rad\" is not a number, as value 2 of 3 (-av red grn blu) must be");
  EXPECT_EQ(
      why({"rtrace", "-av", ".1", ".1", "box.rad", "s.oct"}),
      "command line error at '-av': \"box.rad\" is not a number, as value 3 of 3 (-av red grn blu) must be");
  EXPECT_EQ(
      why({"rtrace", "s.oct", "t.oct", "-ab", "1"}),
      "command line error at 's.oct': the scene begins here, but '-ab' follows; options come before the "
      "scene");
  EXPECT_EQ(why({"rtrace", "-q", "s.oct"}), "command line error at '-q': there is no such option");
  // The nearest option, if one alone is near.
  EXPECT_EQ(why({"rtrace", "-abb", "s.oct"}),
            "command line error at '-abb': there is no such option; the nearest is \"-ab\"");
  EXPECT_EQ(why({"rsphere", "-Ab", "s.oct"}),
            "command line error at '-Ab': there is no such option; the nearest is \"-ab\"");
  EXPECT_EQ(why({"rtrace", "-aq", "s.oct"}), "command line error at '-aq': there is no such option");
  EXPECT_EQ(why({"rtrace", "--ab", "1", "s.oct"}),
            "command line error at '--ab': options begin with one hyphen: -ab");
  EXPECT_EQ(why({"rtrace", "-h", "-features"}),
            "command line error at '-features': it must be the first option");
  EXPECT_EQ(why({"rtrace", "-oq", "s.oct"}),
            "unrecognized output option 'q': the letters are odveVwWlLcpnNsmMrRxX~ and t, T for ray trees");
}

TEST(ParseOptions, NumbersOutsideTheirRangeSayWhich) {
  EXPECT_EQ(faultOfOptions({"rsphere", "-Sn", "0", "s.oct"}),
            "command line error at '-Sn': 0 is not from 1 to 1000000; see -help");
  EXPECT_EQ(faultOfOptions({"rtrace", "-ab", "99999999999", "s.oct"}),
            "command line error at '-ab': 99999999999 is not from 0 to 2147483647; see -help");
}

TEST(ParseOptions, Formats) {
  const auto formats = [](const char* word) {
    const Options options = parse({"rtrace", word, "s.oct"});
    return std::string{static_cast<char>(options.in), static_cast<char>(options.out)};
  };
  for (const char in : {'a', 'f', 'd'}) {
    EXPECT_EQ(formats((std::string("-f") + in).c_str()), std::string({in, in}));
    for (const char out : {'a', 'f', 'd', 'c'})
      EXPECT_EQ(formats((std::string("-f") + in + out).c_str()), std::string({in, out}));
  }
  for (const char* wrong : {"-fc", "-fca", "-fx", "-fax", "-faaa"})
    EXPECT_EQ(beginningOfFault({"rtrace", wrong, "s.oct"}),
              std::string("command line error at '") + wrong + "'");
}

TEST(ParseOptions, OutputLettersBelongToTheMode) {
  EXPECT_EQ(parse({"rtrace", "s.oct"}).outputs, "v");
  EXPECT_EQ(parse({"rsphere", "s.oct"}).outputs, "v");
  EXPECT_EQ(parse({"rsphere", "-Sd", "s.oct"}).outputs, "odwv");
  EXPECT_NO_THROW(parse({"rtrace", "-oodvVwWlLcpnNsmMrRxX~", "s.oct"}));
  EXPECT_NO_THROW(parse({"rsphere", "-ooveECShHuk", "s.oct"}));
  EXPECT_NO_THROW(parse({"rsphere", "-Sd", "-oiodwvlLpnNsmM", "s.oct"}));
  EXPECT_EQ(beginningOfFault({"rtrace", "-ovz", "s.oct"}), "unrecognized output option 'z'");
  EXPECT_EQ(beginningOfFault({"rtrace", "-oE", "s.oct"}), "unrecognized output option 'E'");
  EXPECT_EQ(beginningOfFault({"rsphere", "-ol", "s.oct"}), "unrecognized output option 'l' (sphere mode)");
  EXPECT_EQ(beginningOfFault({"rsphere", "-Sd", "-oE", "s.oct"}),
            "unrecognized output option 'E' (sphere mode)");
  EXPECT_EQ(beginningOfFault({"rtrace", "-o", "s.oct"}), "empty output specification");
}

// As in rtrace, the letters of the tree follow the last t that has letters after it. A t
// at the end has no effect.
TEST(ParseOptions, LettersBehindTAreForTrees) {
  const auto letters = [](const char* word) {
    const Options o = parse({"rtrace", word, "s.oct"});
    return o.outputs + "," + o.treeOutputs + (o.treeShadows ? ",T" : "");
  };
  EXPECT_EQ(letters("-ov"), "v,");
  EXPECT_EQ(letters("-ov~tmW"), "v~,mW");
  EXPECT_EQ(letters("-oTvW"), ",vW,T");
  EXPECT_EQ(letters("-ot"), ",");
  EXPECT_EQ(letters("-ovt"), "v,");
  EXPECT_EQ(letters("-ovtmTs"), "v,s,T");
  EXPECT_EQ(letters("-ovtmT"), "v,m,T");
  EXPECT_EQ(beginningOfFault({"rtrace", "-otz", "s.oct"}), "unrecognized output option 'z'");
  EXPECT_EQ(faultOfOptions({"rtrace", "-fac", "-ovtv", "s.oct"}), "color format only with -ov, -or, -ox");
  EXPECT_EQ(beginningOfFault({"rsphere", "-ovt", "s.oct"}), "unrecognized output option 't' (sphere mode)");
  EXPECT_NO_THROW(parse({"rtrace", "-otL", "-I", "s.oct"}));
}

// Some programs write -te and the modifier as one word, which rtrace itself does not accept.
TEST(ParseOptions, NamesOfTreeModifiersMayBeGlued) {
  EXPECT_EQ(parse({"rtrace", "-tewall", "-te", "roof", "s.oct"}).treeExcluded, (Names{"wall", "roof"}));
  EXPECT_EQ(parse({"rtrace", "-tifloor", "-t", "5", "s.oct"}).treeIncluded, (Names{"floor"}));
  EXPECT_EQ(faultOfOptions({"rtrace", "-tE", "/no/such/file", "s.oct"}, rad::Status::system),
            "cannot open trace exclude file \"/no/such/file\": No such file or directory");
}

TEST(ParseOptions, DefinitionsKeepTheirOrder) {
  const Options o =
      parse({"rtrace", "-e", "a=1", "-f", "b.cal", "-e", "c:2;d(x)=x", "-e", "err.txt", "s.oct"});
  ASSERT_EQ(o.ray.definitions.size(), 3u);
  EXPECT_EQ(o.ray.definitions[0].text, "a=1");
  EXPECT_FALSE(o.ray.definitions[0].isFile);
  EXPECT_EQ(o.ray.definitions[1].text, "b.cal");
  EXPECT_TRUE(o.ray.definitions[1].isFile);
  EXPECT_EQ(o.ray.definitions[2].text, "c:2;d(x)=x");
  EXPECT_EQ(o.messages.errorFile, "err.txt");
}

TEST(ParseOptions, PixelsHoldOneColor) {
  for (const char* letters : {"-ov", "-or", "-ox"})
    EXPECT_NO_THROW(parse({"rtrace", "-fac", letters, "s.oct"}));
  for (const char* letters : {"-ovv", "-oo", "-oW", "-ol"})
    EXPECT_EQ(faultOfOptions({"rtrace", "-fac", letters, "s.oct"}), "color format only with -ov, -or, -ox");
  for (const char* letters : {"-ov", "-oE", "-oC", "-oS", "-oh", "-oe"})
    EXPECT_NO_THROW(parse({"rsphere", "-fac", letters, "s.oct"}));
  EXPECT_EQ(faultOfOptions({"rsphere", "-fac", "-oH", "s.oct"}),
            "color format only with -ov, -oe, -oE, -oC, -oS, -oh");
}

TEST(ParseOptions, IrradianceCountsAsInRtrace) {
  EXPECT_EQ(parse({"rtrace", "-i", "s.oct"}).irradiance, IrradianceAt::surface);
  EXPECT_EQ(parse({"rtrace", "-i", "-I+", "s.oct"}).irradiance, IrradianceAt::point);
  EXPECT_EQ(parse({"rtrace", "-i", "-I", "-I", "s.oct"}).irradiance, IrradianceAt::surface);
  EXPECT_EQ(parse({"rtrace", "-i-", "-I-", "s.oct"}).irradiance, IrradianceAt::none);
  EXPECT_EQ(faultOfOptions({"rtrace", "-I", "-oodL", "s.oct"}),
            "-I+ and -i+ options require some value output");
  EXPECT_EQ(parse({"rtrace", "-I", "-ovr", "s.oct"}).messages.remarks,
            (Names{"-orRxX options incompatible with -I+ and -i+"}));
  EXPECT_EQ(parse({"rtrace", "-oVW", "s.oct"}).messages.remarks,
            (Names{"-oVW options require trace mode"}));
}

TEST(ParseOptions, WhatNeedsRaysIsRefusedInSphereMode) {
  EXPECT_EQ(
      faultOfOptions({"rsphere", "-I+", "s.oct"}),
      "command line error at '-I': needs ray mode (-S-): in sphere mode -oE, -oC and -oH give irradiances; "
      "see -help");
  EXPECT_EQ(
      faultOfOptions({"rsphere", "-i", "s.oct"}),
      "command line error at '-i': needs ray mode (-S-): in sphere mode -oE, -oC and -oH give irradiances; "
      "see -help");
  EXPECT_EQ(faultOfOptions({"rsphere", "-ld", "s.oct"}),
            "command line error at '-ld': needs ray mode (-S-): points have no direction vector; see -help");
}

// No option is accepted where it has no effect, except for switches that are off.
TEST(ParseOptions, OptionsOfTheOtherModeAreRefused) {
  int refused = 0;
  for (const OptionEntry& entry : optionTable()) {
    if (entry.mode == Mode::both) continue;
    ++refused;
    const bool points = entry.mode == Mode::points,
               isSwitch = std::holds_alternative<SwitchValue>(entry.value);
    std::vector<std::string> words{points ? "rtrace" : "rsphere", std::string(entry.name)};
    if (isSwitch) words.back() += '+';
    for (int i = 0; i < arity(entry); ++i) words.emplace_back(entry.name == "-Sw" ? "h" : "1");
    const TemporaryFile sensors("0 0 0 0 0 1");
    if (entry.arguments == "file") words.back() = sensors.path;
    words.emplace_back("s.oct");
    EXPECT_NE(faultOf([&] { parseOptions(words); }).find(points ? "needs sphere mode" : "needs ray mode"),
              std::string::npos)
        << entry.name;
    if (!isSwitch) continue;
    words[1].back() = '-';
    EXPECT_NO_THROW(parseOptions(words)) << entry.name;
  }
  EXPECT_GE(refused, 20);
}

TEST(ParseOptions, SwitchesOfSphereModeTakeNoLetters) {
  EXPECT_EQ(faultOfOptions({"rsphere", "-SN", "512", "s.oct"}),
            "command line error at '-SN': there is no such option; the nearest is \"-Sn\"; see -help");
  for (const char* word : {"-Sy", "-SF", "-Sdn", "-SuT"})
    EXPECT_NE(faultOfOptions({"rsphere", word, "s.oct"}).find("there is no such option"), std::string::npos);
  EXPECT_FALSE(parse({"rsphere", "-S0", "s.oct"}).sphereMode);
  EXPECT_TRUE(parse({"rtrace", "-S1", "s.oct"}).sphereMode);
  EXPECT_TRUE(parse({"rsphere", "-bvN", "-wy", "s.oct"}).messages.warnings) << "as in rtrace";
}

TEST(ParseOptions, ListsAreWordsAsInScenes) {
  const TemporaryFile quoted("\xef\xbb\xbf'lum light' \"it's\" a'b c'\n"), open("x\ny 'z");
  EXPECT_EQ(parse({"rtrace", "-aE", quoted.path.c_str(), "s.oct"}).ray.ambientExcluded,
            (Names{"lum light", "it's", "ab c"}));
  EXPECT_EQ(parse({"rtrace", "-tI", quoted.path.c_str(), "s.oct"}).treeIncluded,
            (Names{"lum light", "it's", "ab c"}));
  EXPECT_EQ(parse({"rtrace", "-ab", "1", ("@" + quoted.path).c_str()}).scene,
            (Names{"lum light", "it's", "ab c"}));
  EXPECT_EQ(faultOfOptions({"rtrace", "-aE", open.path.c_str(), "s.oct"}),
            open.path + ":2: unclosed quote: '");
  EXPECT_EQ(faultOfOptions({"rtrace", ("@" + open.path).c_str()}), open.path + ":2: unclosed quote: '");
}

TEST(ParseOptions, ABoundOfMemoryIsRefusedWithAnAmbientFile) {
  EXPECT_EQ(parse({"rsphere", "-Sm", "1.5", "s.oct"}).ray.fieldMemory, 1.5);
  EXPECT_EQ(faultOfOptions({"rsphere", "-Sm", "1.5", "-af", "a.af", "s.oct"}),
            "-Sm and -af exclude each other: an ambient file is kept in memory as a whole");
}

TEST(ParseOptions, MostDirectionsFollowTheBase) {
  EXPECT_EQ(parse({"rsphere", "s.oct"}).sphere.mostDirections, 4096);
  EXPECT_EQ(parse({"rsphere", "-Sn", "10000", "s.oct"}).sphere.mostDirections, 20000);
  EXPECT_EQ(parse({"rsphere", "-Sx", "5000", "-Sn", "4500", "s.oct"}).sphere.mostDirections, 5000);
  EXPECT_EQ(faultOfOptions({"rsphere", "-Sx", "100", "s.oct"}),
            "command line error at '-Sx': 100 is less than -Sn 2048; see -help");
}

TEST(ParseOptions, PicturesHaveDefaultsOfTheirOwnAndTheOptionsThatAreGiven) {
  const RayOptions usual = parse({"rsphere", "-ab", "3", "-Si", "a.png", "s.oct"}).pictureRay;
  EXPECT_EQ(usual.ambientBounces, 3);
  EXPECT_EQ(usual.ambientDivisions, pictureDefaults().ambientDivisions);
  EXPECT_EQ(usual.ambientAccuracy, pictureDefaults().ambientAccuracy);
  const Options given = parse({"rsphere", "-ad", "64", "-aa", "0", "-Si", "a.png", "-af", "x.amb", "s.oct"});
  EXPECT_EQ(given.pictureRay.ambientDivisions, 64);
  EXPECT_EQ(given.pictureRay.ambientAccuracy, 0);
  EXPECT_EQ(given.pictureRay.specularSampling, pictureDefaults().specularSampling);
  EXPECT_EQ(given.pictureRay.ambientFile, "") << "its light would be that of other options";
  EXPECT_EQ(given.ray.ambientFile, "x.amb");
  EXPECT_EQ(given.ray.specularSampling, modeDefaults(true).ray.specularSampling);
}

TEST(ParseOptions, Words) {
  const Options options = parse({"rsphere", "-Sg", "a", "-Sg", "b", "-Sw", "h", "-Sr", "12345678901", "-e",
                                 "err", "-af", "x.amb", "s.oct"});
  EXPECT_EQ(options.goals, (Names{"a", "b"}));
  EXPECT_EQ(options.sphere.weights, Weights::homogeneous);
  EXPECT_EQ(options.sphere.rotation, 12345678901u);
  EXPECT_EQ(options.messages.errorFile, "err");
  EXPECT_EQ(options.ray.ambientFile, "x.amb");
  EXPECT_EQ(faultOfOptions({"rsphere", "-Sw", "x", "s.oct"}),
            "command line error at '-Sw': \"x\" is not one of h, v, c; see -help");
  EXPECT_EQ(beginningOfFault({"rsphere", "-Sr", "-1", "s.oct"}), "command line error at '-Sr'");
  for (const char* number : {"nan", "-nan", "inf", "1e999"}) {
    EXPECT_EQ(beginningOfFault({"rsphere", "-lw", number, "s.oct"}), "command line error at '-lw'");
    EXPECT_EQ(beginningOfFault({"rsphere", "-av", "0", number, "0", "s.oct"}), "command line error at '-av'");
    EXPECT_EQ(beginningOfFault({"rsphere", "-Sk", number, "s.oct"}), "command line error at '-Sk'");
  }
  EXPECT_EQ(beginningOfFault({"rsphere", "-af", " ", "s.oct"}), "command line error at '-af'");
}

TEST(ParseOptions, AmbientModifiersAreOneKindOnly) {
  const TemporaryFile file("c d\n\te");
  Options options = parse({"rtrace", "-ae", "a", "-ae", "b", "-aE", file.path.c_str(), "s.oct"});
  EXPECT_EQ(options.ray.ambientExcluded, (Names{"a", "b", "c", "d", "e"}));
  options = parse({"rtrace", "-ae", "a", "-ai", "b", "-aI", file.path.c_str(), "s.oct"});
  EXPECT_TRUE(options.ray.ambientExcluded.empty());
  EXPECT_EQ(options.ray.ambientIncluded, (Names{"b", "c", "d", "e"}));
  EXPECT_EQ(faultOfOptions({"rtrace", "-aE", "/no/file", "s.oct"}, rad::Status::system),
            "cannot open ambient exclude file \"/no/file\": No such file or directory");
  EXPECT_EQ(faultOfOptions({"rtrace", "-aI", "/tmp", "s.oct"}, rad::Status::system),
            "/tmp: cannot read: Is a directory");
  EXPECT_EQ(faultOfOptions({"rtrace", "-tE", "/dev/zero", "s.oct"}),
            "/dev/zero:1: NUL byte: this is not scene text");
}

TEST(ParseOptions, SceneTakesTheRest) {
  EXPECT_EQ(parse({"rsphere", "-h", "a.rad", "b.rad"}).scene, (Names{"a.rad", "b.rad"}));
  EXPECT_EQ(parse({"rsphere", "!oconv a.rad"}).scene, (Names{"!oconv a.rad"}));
}

TEST(ParseOptions, FilesAndVariablesStandForTheirWords) {
  const TemporaryFile inner("-ab 3\n\t-ad  64"),
      outer("-h @" + inner.path + "\n-lw 1e-3 $RSPHERE_TEST_WORDS\n");
  ASSERT_EQ(setenv("RSPHERE_TEST_WORDS", "-x 7 -I", 1), 0);
  ASSERT_EQ(setenv("RSPHERE_TEST_SCENE", " a.rad  b.rad ", 1), 0);
  const Options options =
      parse({"rtrace", ("@" + outer.path).c_str(), "-y", "2", "$RSPHERE_TEST_SCENE", "c.rad"});
  EXPECT_FALSE(options.header);
  EXPECT_EQ(options.ray.ambientBounces, 3);
  EXPECT_EQ(options.ray.ambientDivisions, 64);
  EXPECT_EQ(options.width, 7);
  EXPECT_EQ(options.height, 2);
  EXPECT_EQ(options.scene, (Names{"a.rad", "b.rad", "c.rad"}));
  EXPECT_EQ(options.words, (Names{"-h", "-ab", "3", "-ad", "64", "-lw", "1e-3", "-x", "7", "-I", "-y", "2"}));
}

TEST(ParseOptions, WhatCannotBeExpandedIsASystemFault) {
  EXPECT_EQ(faultOfOptions({"rtrace", "@/no/file", "s.oct"}, rad::Status::system),
            "cannot expand '@/no/file': No such file or directory");
  EXPECT_EQ(faultOfOptions({"rtrace", "$RSPHERE_NO_VARIABLE", "s.oct"}, rad::Status::system),
            "cannot expand '$RSPHERE_NO_VARIABLE': No such file or directory");
  EXPECT_NE(faultOfOptions({"rtrace", "@/tmp", "s.oct"}, rad::Status::system), "no fault");
  // As in rtrace, the words after an option are not expanded.
  EXPECT_EQ(beginningOfFault({"rtrace", "-ab", "$HOME", "s.oct"}), "command line error at '-ab'");
}

TEST(ParseOptions, ExpansionEnds) {
  const TemporaryFile file;
  std::ofstream(file.path) << "-h @" << file.path;
  EXPECT_EQ(faultOfOptions({"rtrace", ("@" + file.path).c_str()}),
            "cannot expand '@" + file.path + "': too many words");
  ASSERT_EQ(setenv("RSPHERE_TEST_SELF", "$RSPHERE_TEST_SELF", 1), 0);
  EXPECT_EQ(faultOfOptions({"rtrace", "$RSPHERE_TEST_SELF"}),
            "cannot expand '$RSPHERE_TEST_SELF': too many words");
  EXPECT_NE(faultOfOptions({"rtrace", "@/dev/zero"}), "no fault");
}

TEST(ParseOptions, RequestsEndTheCommandLine) {
  EXPECT_EQ(parse({"rtrace", "-version", "-nonsense"}).request, Request::version);
  EXPECT_EQ(parse({"rtrace", "-ab", "2", "-help"}).request, Request::help);
  EXPECT_EQ(parse({"rtrace", "--version", "-nonsense"}).request, Request::version);
  EXPECT_EQ(parse({"rtrace", "-ab", "2", "--help"}).request, Request::help);
  EXPECT_EQ(parse({"rtrace", "-ab", "2", "-help", "all"}).request, Request::helpAll);
  EXPECT_EQ(parse({"rtrace", "-help", "-nonsense"}).request, Request::help);
  EXPECT_EQ(parse({"rtrace", "-ab", "2", "-defaults", "x"}).ray.ambientBounces, 2);
  EXPECT_EQ(beginningOfFault({"rtrace", "-nonsense", "-version"}), "command line error at '-nonsense'");
  EXPECT_EQ(beginningOfFault({"rtrace", "-h", "-features"}), "command line error at '-features'");
}

TEST(ParseOptions, NothingAtAll) {
  const std::string fault = faultOf([] { parseOptions(std::vector<std::string>{}); });
  EXPECT_TRUE(fault.starts_with("missing octree argument: ")) << fault;
}

}  // namespace
}  // namespace rsphere
