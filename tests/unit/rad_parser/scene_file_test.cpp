#include "rad_parser/scene_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>

#include "rad_parser/printable.h"
#include "tests/unit/rad_parser/scene_text.h"

namespace {

using rad::Description;
using rad::kVoid;
using rad::Primitive;
using rad::PrimitiveId;
using rad::Status;
using rad::Type;

TEST(SceneFile, EveryTypeIsKept) {
  std::string text = "void plastic m 0 0 0\n";
  for (int i = 0; i < rad::kTypes; ++i) {
    const std::string_view type = typeName(static_cast<Type>(i));
    if (type != "alias") text += fmt::format("m {} n{} 2 a 'b c' 0 3 1 2 3\n", type, i);
  }
  const Description d = readText(text);
  ASSERT_EQ(d.primitives.size(), static_cast<size_t>(rad::kTypes));
  for (int i = 0; i + 1 < rad::kTypes; ++i) {
    const Primitive& p = d.primitives.at(i + 1);
    EXPECT_EQ(p.type, static_cast<Type>(i));
    EXPECT_EQ(p.name, fmt::format("n{}", i));
    EXPECT_EQ(p.modifier, PrimitiveId(0));
    EXPECT_EQ(p.place.line, static_cast<uint32_t>(i + 2));
    ASSERT_EQ(p.strings, 2u);
    EXPECT_EQ(d.string(p, 1), "b c");
    EXPECT_EQ(std::vector<double>(d.reals(p).begin(), d.reals(p).end()), (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(isMixture(p.type), typeName(p.type).starts_with("mix"));
  }
  Type type = Type::mesh;
  EXPECT_TRUE(rad::findType("BRTDfunc", type));
  EXPECT_EQ(type, Type::brtdfunc);
  EXPECT_FALSE(rad::findType("brtdfunc", type));
  EXPECT_FALSE(rad::findType("", type));
}

TEST(SceneFile, CommentsBlanksAndLineEnds) {
  const Description d = readText(
      "# a comment\r\n\r\n   \t# another\r\nvoid plastic red 0 0 5\r\n .5 .1 .1\t0\f0\r\nred "
      "sphere\r\n\r\nball 0 0 4 0 0 0 "
      "+1.\r\n#last");
  EXPECT_EQ(printScene(d), "void plastic red\n0\n0\n5 0.5 0.1 0.1 0 0\nred sphere ball\n0\n0\n4 0 0 0 1\n");
  EXPECT_EQ(d.at(d.primitives.at(1).place), "room.rad:6");
}

TEST(SceneFile, QuotedWords) {
  const Description d =
      readText("void brighttext \"my sign\" 4 a\"b c\"d 'say \"x\"' \"\" 'two\nlines' 0 0\n");
  const Primitive& p = d.primitives.at(0);
  EXPECT_EQ(p.name, "my sign");
  EXPECT_EQ(d.string(p, 0), "ab cd");
  EXPECT_EQ(d.string(p, 1), "say \"x\"");
  EXPECT_EQ(d.string(p, 2), "");
  EXPECT_EQ(d.string(p, 3), "two\nlines");
}

TEST(SceneFile, TheLastDefinitionCounts) {
  const Description d = readText(R"(
void plastic a 0 0 5 1 1 1 0 0
a sphere one 0 0 4 0 0 0 1
void metal a 0 0 5 1 1 1 0 0
a sphere two 0 0 4 0 0 0 1
a glow a 0 0 4 1 1 1 0
a sphere a 0 0 4 0 0 0 1
a sphere three 0 0 4 0 0 0 1
)");
  EXPECT_EQ(d.primitives.at(1).modifier, PrimitiveId(0));
  EXPECT_EQ(d.primitives.at(3).modifier, PrimitiveId(2));
  EXPECT_EQ(d.primitives.at(4).modifier, PrimitiveId(2));
  EXPECT_EQ(d.primitives.at(6).modifier, PrimitiveId(4)) << "a surface is no modifier, whatever its name";

  const rad::ModifierIndex index(d);
  EXPECT_EQ(index.before("a", PrimitiveId(0)), kVoid);
  EXPECT_EQ(index.before("a", PrimitiveId(1)), PrimitiveId(0));
  EXPECT_EQ(index.before("a", PrimitiveId(2)), PrimitiveId(0));
  EXPECT_EQ(index.before("a", PrimitiveId(4)), PrimitiveId(2));
  EXPECT_EQ(index.before("a", PrimitiveId(7)), PrimitiveId(4));
  EXPECT_EQ(index.before("one", PrimitiveId(7)), kVoid);
  EXPECT_EQ(index.before("void", PrimitiveId(7)), kVoid);
}

TEST(SceneFile, AliasesStandForACopyWithAModifier) {
  const Description d = readText(R"(
void brightfunc dirt 2 d d.cal 0 0
void brightfunc rust 2 r r.cal 0 0
dirt plastic wall 0 0 5 1 1 1 0 0
rust alias wall2 wall
inherit alias wall3 wall
inherit alias wall4 wall2
void alias wall5 wall4
dirt alias wall6 wall3
void metal wall 0 0 5 1 1 1 0 0
wall6 sphere s 0 0 4 0 0 0 1
)");
  const auto alias = [&](int i) {
    return std::pair(d.primitives.at(i).modifier, d.primitives.at(i).aliased);
  };
  EXPECT_EQ(alias(3), std::pair(PrimitiveId(1), PrimitiveId(2)));
  EXPECT_EQ(alias(4), std::pair(PrimitiveId(0), PrimitiveId(2)));
  EXPECT_EQ(alias(5), std::pair(PrimitiveId(1), PrimitiveId(2)))
      << "with the modifier of the alias that it names";
  EXPECT_EQ(alias(6), std::pair(PrimitiveId(kVoid), PrimitiveId(2)));
  EXPECT_EQ(alias(7), std::pair(PrimitiveId(0), PrimitiveId(2)));
  EXPECT_EQ(d.primitives.at(9).modifier, PrimitiveId(7));
  EXPECT_EQ(d.string(d.primitives.at(6), 0), "wall4");
}

TEST(SceneFile, MisspeltModifiersHaveTheNearestName) {
  const std::string defined =
      "void plastic window_frame 0 0 5 0 0 0 0 0\nvoid glass window_glass 0 0 3 1 1 1\n"
      "window_glass polygon window_glaz 0 0 0\n";
  const auto messageOf = [&](std::string_view text) { return errorOfText(defined + std::string(text)); };
  EXPECT_EQ(messageOf("window_glas sphere s 0 0 0"),
            "room.rad:4: undefined modifier \"window_glas\"; the nearest is \"window_glass\"");
  EXPECT_EQ(
      messageOf("void alias pane window_glas"),
      "room.rad:4: alias \"pane\": undefined modifier \"window_glas\"; the nearest is \"window_glass\"");
  EXPECT_EQ(messageOf("viod sphere s 0 0 0"),
            "room.rad:4: undefined modifier \"viod\"; the nearest is \"void\"");
  EXPECT_EQ(messageOf("Void sphere s 0 0 0"),
            "room.rad:4: undefined modifier \"Void\"; the nearest is \"void\"");
  EXPECT_EQ(messageOf("plaster sphere s 0 0 0"), "room.rad:4: undefined modifier \"plaster\"");
}

// A count of arguments that is too small leaves numbers over, of which the first would be a modifier.
TEST(SceneFile, NumbersThatAreLeftOverNameThePrimitiveBefore) {
  EXPECT_EQ(
      errorOfText("\nvoid polygon wall\n0 0 11\n0 0 0 4 0 0 4 0 2.8\n0 0 2.8\n"),
      "room.rad:5: undefined modifier \"2.8\"; a number follows the 11 numbers of polygon \"wall\" (line 2): "
      "is that count too small?");
  EXPECT_EQ(errorOfText("0 0 0"), "room.rad:1: undefined modifier \"0\"");
}

TEST(SceneFile, AWavefrontFileIsRecognized) {
  constexpr std::string_view kRemedy =
      "; this seems to be a Wavefront .obj file, which obj2rad converts to a scene file";
  for (const auto& [text, word] :
       {std::pair("# Blender\no Chair\nv 0 0 0\n", "o"), std::pair("mtllib chair.mtl\n", "mtllib"),
        std::pair("\nv 1.5 0 0\nv 0 1 0\n", "v")}) {
    const std::string message = errorOfText(text);
    EXPECT_NE(message.find(fmt::format(": undefined modifier \"{}\"{}", word, kRemedy)), std::string::npos)
        << message;
  }
  // Not where a scene has begun, nor where a primitive follows.
  EXPECT_EQ(errorOfText("void sphere s 0 0 0\no Chair\n"), "room.rad:2: undefined modifier \"o\"");
  EXPECT_EQ(errorOfText("o sphere s 0 0 0\n"), "room.rad:1: undefined modifier \"o\"");
}

TEST(SceneFile, FaultsAndTheirPlaces) {
  EXPECT_EQ(errorOfText("\n\nwall sphere s 0 0 4 0 0 0 1"), "room.rad:3: undefined modifier \"wall\"");
  EXPECT_EQ(errorOfText("s sphere s 0 0 4 0 0 0 1"), "room.rad:1: undefined modifier \"s\"");
  EXPECT_EQ(errorOfText("void\nspere s 0 0 0"),
            "room.rad:2: unknown type \"spere\"; the nearest is \"sphere\"");
  EXPECT_EQ(errorOfText("void Sphere s 0 0 0"),
            "room.rad:1: unknown type \"Sphere\"; the nearest is \"sphere\"");
  EXPECT_EQ(errorOfText("void teapot s 0 0 0"), "room.rad:1: unknown type \"teapot\"");
  EXPECT_EQ(errorOfText("inherit plastic s 0 0 0"), "room.rad:1: \"inherit\" is for aliases only");
  EXPECT_EQ(errorOfText("void plastic inherit 0 0 0"), "room.rad:1: no modifier can be named \"inherit\"");
  EXPECT_EQ(errorOfText("void plastic void 0 0 0"), "room.rad:1: no modifier can be named \"void\"");
  EXPECT_EQ(errorOfText("void sphere void 0 0 0"), "");
  EXPECT_EQ(errorOfText("void alias a void"), "room.rad:1: alias \"a\": undefined modifier \"void\"");
  EXPECT_EQ(errorOfText("void alias a a"), "room.rad:1: alias \"a\": undefined modifier \"a\"");
  EXPECT_EQ(errorOfText("void sphere 'a\tb' 0 0 0"), "room.rad:1: tab in name \"a\\x09b\"");
  EXPECT_EQ(errorOfText("void sphere s x 0 0"),
            "room.rad:1: sphere \"s\": expected the number of string arguments, got \"x\"");
  EXPECT_EQ(errorOfText("void sphere s 0 0\n4.0 1 2 3 4"),
            "room.rad:2: sphere \"s\": expected the number of real arguments, got \"4.0\"");
  EXPECT_EQ(errorOfText("void sphere s 0 1 7 0"),
            "room.rad:1: sphere \"s\": 1 integer arguments, but no type has any");
  EXPECT_EQ(errorOfText("void sphere s 0 0 4 1 2\n3,5 1"),
            "room.rad:2: sphere \"s\": expected 4 numbers, but number 3 is \"3,5\"");
  EXPECT_EQ(errorOfText("void sphere s 0 0 1 1e999"),
            "room.rad:1: sphere \"s\": expected 1 numbers, but number 1 is \"1e999\"");
}

TEST(SceneFile, TruncatedTextsAreErrorsAtThePrimitive) {
  const std::string whole = "void texfunc t 3 dx dy f.cal 0 2 1 2";
  EXPECT_EQ(errorOfText(whole), "");
  for (size_t length = 1; length + 2 < whole.size(); ++length) {
    const std::string error = errorOfText(fmt::format("\n{}", whole.substr(0, length)));
    EXPECT_EQ(error.substr(0, 12), "room.rad:2: ") << length << " " << error;
  }
  EXPECT_EQ(errorOfText("void sphere s 0 0 4 1 2"), "room.rad:1: text ends within sphere \"s\"");
  EXPECT_EQ(errorOfText("void"), "room.rad:1: text ends after \"void\"");
}

TEST(SceneFile, HostileCounts) {
  EXPECT_EQ(errorOfText("void polygon p 0 0 99999999999 1 2 3"),
            "room.rad:1: polygon \"p\": 99999999999 real arguments");
  EXPECT_EQ(errorOfText("void polygon p -1 0 0"), "room.rad:1: polygon \"p\": -1 string arguments");
  EXPECT_EQ(errorOfText("void polygon p 2000000000 0 0"), "room.rad:1: text ends within polygon \"p\"");
  EXPECT_EQ(errorOfText("void polygon p 0 0 2147483647 1 2 3"), "room.rad:1: text ends within polygon \"p\"");
  EXPECT_EQ(
      errorOfText("void polygon p 0 0 99999999999999999999999 1"),
      "room.rad:1: polygon \"p\": expected the number of real arguments, got \"99999999999999999999999\"");
}

TEST(SceneFile, Utf16IsNamed) {
  using namespace std::string_view_literals;
  const std::string message =
      "room.rad:1: the text is in UTF-16; convert it to UTF-8: iconv -f UTF-16 -t UTF-8";
  EXPECT_EQ(errorOfText("\xff\xfev\0o\0i\0d\0 \0"sv), message);
  EXPECT_EQ(errorOfText("\xfe\xff\0v\0o\0i\0d\0 "sv), message);
  EXPECT_EQ(errorOfText("\xff\xfe"sv), message);
}

TEST(SceneFile, HostileBytes) {
  using namespace std::string_view_literals;
  EXPECT_EQ(errorOfText("void sphere\n s\0 0 0 0"sv), "room.rad:2: NUL byte: this is not scene text");
  EXPECT_EQ(errorOfText("void sphere 's\0' 0 0 0"sv), "room.rad:1: NUL byte: this is not scene text");
  EXPECT_EQ(errorOfText("# \0 in a comment is harmless\n"sv), "");
  EXPECT_EQ(errorOfText("void sphere 'abc"), "room.rad:1: unclosed quote: '");
  const std::string longWord(70000, 'x');
  EXPECT_EQ(errorOfText(longWord), "room.rad:1: word longer than 65536 bytes: \"xxxxxxxxxxxxxxxxxxxx...\"");
  EXPECT_EQ(errorOfText("'" + longWord),
            "room.rad:1: word longer than 65536 bytes: \"xxxxxxxxxxxxxxxxxxxx...\"");
  EXPECT_EQ(errorOfText("\x01\x02\x1b[31m\xff x y"),
            "room.rad:1: undefined modifier \"\\x01\\x02\\x1b[31m\\xff\"");
  EXPECT_LT(errorOfText("void sphere " + std::string(60000, 'y') + " 0 0 x").size(), 200u);
  EXPECT_EQ(errorOfText("!" + std::string(2 << 20, 'x')), "room.rad:1: command longer than 1048576 bytes");
}

// Any bytes are read, or refused with one line that contains a place. Sanitizers detect other faults.
TEST(SceneFile, SpoiledTextsAreReadOrRefused) {
  const std::string whole =
      "# text\nvoid plastic m 0 0 5 .5 .5 .5 0 0\nm alias n m\nn polygon 'a b' 0 0 9 0 0 0 1e0 0 0 0 +1. 0\n"
      "void texfunc t 3 x \"y z\" f.cal 0 1 -.5E-1\nt sphere s 0 0 4 0 0 0 1\n";
  std::mt19937 random(7);
  int refused = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string text = whole;
    for (int k = static_cast<int>(random() % 3) + 1; k > 0 && !text.empty(); --k) {
      const size_t at = random() % text.size();
      switch (random() % 4) {
        case 0: text[at] = static_cast<char>(random()); break;
        case 1: text.erase(at, random() % 5); break;
        case 2: text.insert(at, text.substr(random() % text.size(), random() % 12)); break;
        case 3: text.resize(at + 1); break;
      }
    }
    std::replace(text.begin(), text.end(), '!', '?');
    const std::string error = errorOfText(text);
    refused += !error.empty();
    if (!error.empty()) {
      ASSERT_EQ(error.substr(0, 9), "room.rad:") << text;
      ASSERT_EQ(error.find('\n'), error.npos);
    }
  }
  EXPECT_GT(refused, 10000);
  EXPECT_LT(refused, 19900);
}

TEST(SceneFile, WordsAcrossBlocks) {
  // Two million bytes of words of many lengths, some of which cross the boundaries of
  // the blocks that are read.
  std::mt19937 random(3);
  std::string text;
  std::vector<std::string> names;
  while (text.size() < 2'000'000) {
    std::string name(1 + random() % 5000, static_cast<char>('a' + random() % 26));
    if (random() % 2) name[name.size() / 2] = ' ';
    text += fmt::format("#{}\nvoid sphere {} 1 \"{}\" 0 2 {}.{} 7\n", name, sceneWord(name), name, random(),
                        random() % 10);
    names.push_back(std::move(name));
  }
  const TestFolder folder;
  const Description file = readFile(folder.write("a.rad", text)), memory = readText(text);
  EXPECT_EQ(printScene(file), printScene(memory));
  ASSERT_EQ(file.primitives.size(), names.size());
  for (size_t i = 0; i < names.size(); ++i) {
    ASSERT_EQ(file.primitives.at(i).name, names[i]);
    ASSERT_EQ(file.primitives.at(i).place.line, 2 * i + 2);
  }
}

// Random descriptions that are printed and read again are equal, digit for digit.
TEST(SceneFile, PrintedScenesReadBackTheSame) {
  std::mt19937_64 random(11);
  for (int round = 0; round < 50; ++round) {
    std::string text = "void plastic m0 0 0 0\n";
    int modifiers = 1;
    for (int i = 0; i < 40; ++i) {
      const Type type = static_cast<Type>(random() % rad::kTypes);
      const auto modifier = [&] { return fmt::format("m{}", random() % modifiers); };
      const std::string name = isSurface(type)
                                   ? sceneWord(std::string(random() % 4, "ab'\" #!"[random() % 7]))
                                   : fmt::format("m{}", modifiers);
      const bool inherits = type == Type::alias && random() % 3 == 0;
      text += fmt::format("{} {} {}\n",
                          inherits       ? "inherit"
                          : random() % 4 ? modifier()
                                         : "void",
                          typeName(type), name);
      if (type == Type::alias) {
        text += modifier() + "\n";
      } else {
        const int strings = random() % 4, reals = random() % 5;
        text += fmt::format("{}", strings);
        for (int k = 0; k < strings; ++k)
          text += fmt::format(" {}", sceneWord(std::string(random() % 3, " -\nx'"[random() % 5])));
        text += fmt::format(" 0 {}", reals);
        for (int k = 0; k < reals; ++k)
          text += fmt::format(
              " {}", std::ldexp(static_cast<double>(random()), static_cast<int>(random() % 400) - 200));
        text += '\n';
      }
      modifiers += !isSurface(type);
    }
    const Description once = readText(text), twice = readText(printScene(once));
    EXPECT_EQ(once.realArgs, twice.realArgs);
    EXPECT_EQ(once.vertices, twice.vertices);
    ASSERT_EQ(once.primitives.size(), twice.primitives.size());
    for (size_t i = 0; i < once.primitives.size(); ++i) {
      const Primitive &a = once.primitives.at(i), &b = twice.primitives.at(i);
      EXPECT_EQ(a.type, b.type);
      EXPECT_EQ(a.modifier, b.modifier);
      EXPECT_EQ(a.aliased, b.aliased);
      EXPECT_EQ(a.name, b.name);
      ASSERT_EQ(a.strings, b.strings);
      for (uint32_t k = 0; k < a.strings; ++k) EXPECT_EQ(once.string(a, k), twice.string(b, k));
      EXPECT_EQ(a.reals, b.reals);
    }
    EXPECT_EQ(printScene(once), printScene(twice));
  }
}

TEST(SceneFile, SeveralFilesShareTheirModifiers) {
  const TestFolder folder;
  const std::vector<std::string> names = {folder.write("a.rad", "void plastic m 0 0 0\n"),
                                          folder.write("b.rad", "\nm sphere s 0 0 0\n")};
  const Description d = rad::readScene(names);
  EXPECT_EQ(d.primitives.at(1).modifier, PrimitiveId(0));
  EXPECT_EQ(d.at(d.primitives.at(1).place), names[1] + ":2");
}

TEST(SceneFile, FilesThatCannotBeRead) {
  const TestFolder folder;
  const std::string none = folder.path("none.rad");
  EXPECT_EQ(errorOf([&] { readFile(none); }, Status::system),
            none + ": cannot open scene file: No such file or directory");
  EXPECT_EQ(errorOf([&] { readFile(folder.path()); }, Status::system),
            folder.path() + ": cannot read: Is a directory");
  const std::string locked = folder.write("locked.rad", "");
  chmod(locked.c_str(), 0);
  const std::string denied = errorOf([&] { readFile(locked); }, Status::system);  // except for root
  EXPECT_EQ(denied, geteuid() == 0 ? "" : locked + ": cannot open scene file: Permission denied");
  EXPECT_EQ(errorOf([] { readFile(""); }, Status::system),
            "\"\": cannot open scene file: No such file or directory");
  EXPECT_EQ(errorOf([] { readFile("/dev/zero"); }), "/dev/zero:1: NUL byte: this is not scene text");
}

TEST(SceneFile, EmptyFilesAreAWarning) {
  const TestFolder folder;
  const std::string file = folder.write("empty.rad", "# nothing\n");
  std::vector<std::string> warnings;
  readFile(file, &warnings);
  EXPECT_EQ(warnings, std::vector{file + ":1: empty file"});
  warnings.clear();
  readFile(fmt::format("!xform -a 5 -mx {}", file), &warnings);
  EXPECT_EQ(warnings.size(), 1u) << "an array reads it five times, and says so once";
}

TEST(SceneFile, Commands) {
  std::vector<std::string> warnings;
  rad::ReadOptions options;
  options.warn = [&](std::string_view text) { warnings.emplace_back(text); };
  const auto read = [&](std::string_view text) {
    warnings.clear();
    return rad::readSceneText(text, "room.rad", options);
  };

  Description d = read(
      "void plastic m 0 0 0\n!printf '\\nm sphere a 0 0 0\\n' | \\\n  cat; echo void sphere b 0 0 0\r\nm "
      "sphere c 0 0 0\n");
  EXPECT_EQ(d.primitives.size(), 4u);
  EXPECT_EQ(d.at(d.primitives.at(1).place),
            "!printf '\\nm sphere a 0 0 0\\n' |    cat; echo void sphere b 0 0 0:2 (from room.rad:2)");
  EXPECT_EQ(d.at(d.primitives.at(3).place), "room.rad:4");
  EXPECT_TRUE(warnings.empty());

  EXPECT_EQ(errorOf([&] { read("\n!echo; echo wall sphere s 0 0 0"); }),
            "!echo; echo wall sphere s 0 0 0:2 (from room.rad:2): undefined modifier \"wall\"");
  EXPECT_EQ(errorOf([&] { readFile("!echo wall sphere"); }),
            "!echo wall sphere:1: undefined modifier \"wall\"");
}

TEST(SceneFile, AByteOrderMarkIsSkipped) {
  const std::string text = "\xef\xbb\xbfvoid sphere s 0 0 4 0 0 0 1\n";
  EXPECT_EQ(readText(text).primitives.size(), 1u);
  EXPECT_EQ(readText("\xef\xbb\xbf# a remark\nvoid sphere s 0 0 0").primitives.size(), 1u);
  EXPECT_EQ(readText("\xef\xbb\xbf").primitives.size(), 0u);
  const TestFolder folder;
  const std::string file = folder.write("marked.rad", text);
  EXPECT_EQ(readFile(file).primitives.size(), 1u);
  EXPECT_EQ(readFile("!xform -mx " + file).primitives.size(), 1u);
  EXPECT_EQ(readFile("!cat " + file).primitives.size(), 1u);
  // A pipe may deliver it byte by byte.
  EXPECT_EQ(
      readText("!printf '\\357'; sleep .02; printf '\\273'; sleep .02; printf '\\277void sphere s 0 0 0'\n")
          .primitives.size(),
      1u);
  EXPECT_EQ(errorOfText("void sphere s 0 0 0\n" + text),
            "room.rad:2: undefined modifier \"\xef\xbb\xbfvoid\"");
  EXPECT_EQ(errorOfText("\xef\xbb"), "room.rad:1: undefined modifier \"\\xef\\xbb\"");
}

// Without the error, their surfaces would be missing, and the results would not show it.
TEST(SceneFile, ACommandThatFailsIsAnErrorWithItsPlace) {
  constexpr std::string_view kMissing = "; surfaces that it makes may be missing from the scene";
  EXPECT_EQ(errorOfText("\n!echo void sphere s 0 0 0; exit 3\n"),
            fmt::format("room.rad:2: bad status from \"!echo void sphere s 0 0 0; exit 3\": exit status 3{}",
                        kMissing));
  EXPECT_EQ(
      errorOfText("!no-such-command-anywhere 2>/dev/null\n"),
      fmt::format("room.rad:1: bad status from \"!no-such-command-anywhere 2>/dev/null\": exit status 127 "
                  "(command not found; if it is one of RADIANCE's programs, add their folder to PATH){}",
                  kMissing));
  EXPECT_EQ(errorOfText("void sphere s 0 0 0\n!kill -9 $$\n"),
            fmt::format("room.rad:2: bad status from \"!kill -9 $$\": signal 9{}", kMissing));

  const TestFolder folder;
  const std::string inner = folder.write("inner.rad", "void sphere s 0 0 4 0 0 0 1\n!exit 5\n");
  const std::string outer = folder.write("outer.rad", fmt::format("!xform -mx {}\n", inner));
  EXPECT_EQ(
      errorOf([&] { readFile(outer); }),
      fmt::format("{}:2 (from {}:1): bad status from \"!exit 5\": exit status 5{}", inner, outer, kMissing));

  // Given as a scene file, alone or with others. rtrace would continue with the output of the command.
  const std::string command = "!echo void sphere s 0 0 0; exit 3";
  const std::string why = fmt::format("{0}:1: bad status from \"{0}\": exit status 3{1}", command, kMissing);
  EXPECT_EQ(errorOf([&] { readFile(command); }), why);
  const std::string whole = folder.write("whole.rad", "void sphere s 0 0 4 0 0 0 1\n");
  EXPECT_EQ(errorOf([&] { rad::readScene(std::vector<std::string>{whole, command}); }), why);
}

TEST(SceneFile, CommandsDoNotReadTheRecordsOfTheProgram) {
  EXPECT_EQ(readText("!cat; echo void sphere s 0 0 0\n").primitives.size(), 1u);
}

TEST(SceneFile, ACommandWhoseTextIsWrongIsNotWaitedFor) {
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_NE(errorOfText("!echo what is this; sleep 60 2>/dev/null\n"), "");
  EXPECT_NE(errorOfText("!yes\n"), "");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

TEST(SceneFile, CommandsCanBeForbidden) {
  const TestFolder folder;
  const std::string ball = folder.write("ball.rad", "void sphere s 0 0 4 0 0 0 1\n");
  const std::string room =
      folder.write("room.rad", fmt::format("!xform -t 1 0 0 {}\n!touch {}\n", ball, folder.path("ran")));
  std::vector<std::string> warnings;
  EXPECT_EQ(errorOf([&] { readFile(room, &warnings, false); }).substr(room.size()),
            ":2: commands are not allowed: \"" +
                rad::printable(fmt::format("!touch {}", folder.path("ran"))) + "\"");
  EXPECT_FALSE(std::filesystem::exists(folder.path("ran")));
  EXPECT_EQ(readFile("!xform -mx " + ball, &warnings, false).primitives.size(), 1u);
  EXPECT_NE(errorOf([&] { readFile("!xform -mx " + ball + " | cat", &warnings, false); }), "");
}

TEST(SceneFile, ACommandThatReadsItsOwnFileEndsInAnError) {
  const TestFolder folder;
  const std::string file = folder.write("self.rad", "");
  folder.write("self.rad", fmt::format("!cat {}\n", file));
  const std::string error = errorOf([&] { readFile(file); });
  EXPECT_NE(error.find("100 nested files and commands"), error.npos) << error;
}

TEST(SceneFile, PlacesShowTheirChainCut) {
  Description d;
  d.files.push_back({"a.rad", {rad::SourceFile::kNoFile, 0}});
  for (uint32_t i = 1; i < 20; ++i) d.files.push_back({fmt::format("f{}", i), {i - 1, i}});
  EXPECT_EQ(d.at({0, 3}), "a.rad:3");
  EXPECT_EQ(d.at({2, 9}), "f2:9 (from f1:2, a.rad:1)");
  EXPECT_EQ(d.at({19, 9}), "f19:9 (from f18:19, f17:18, f16:17, f15:16, ..., a.rad:1)");
}

}  // namespace
