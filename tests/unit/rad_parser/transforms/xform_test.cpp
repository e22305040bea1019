#include "rad_parser/transforms/xform.h"

#include <gtest/gtest.h>

#include <cmath>

#include "rad_parser/transforms/xform_command.h"
#include "tests/unit/rad_parser/scene_text.h"

namespace {

using rad::Description;
using rad::Primitive;
using rad::Similarity;
using rad::Type;
using rad::V3d;

constexpr std::string_view kEachRule = R"(
void spotlight spot 0 0 7 10 10 10 30 0 0 -2
void glow near 0 0 4 1 2 3 5
void dielectric amber 0 0 5 .5 .6 .7 1.5 0
void interface skin 0 0 8 .5 .6 .7 1.5 .9 .8 .95 1.3
void mist fog 2 a>b c 0 7 .1 .2 .3 .9 .9 .9 .5
void brighttext sign 2 helvet.fnt hello 0 11 1 2 3 1 0 0 0 -1 0 .5 .6
void brightfunc dirt 2 dirt dirt.cal 0 1 .3
void BSDF blind 6 0 blind.xml 0 0 1 . 0 0
spot source sun 0 0 4 0 1 2 .5
spot sphere ball 0 0 4 0 1 2 .5
spot bubble hole 0 0 4 0 1 2 .5
spot polygon face 0 0 12 0 0 0 2 0 0 2 1 0 0 1 0
spot cone hat 0 0 8 1 2 3 4 5 6 .1 .2
spot cup bowl 0 0 8 1 2 3 4 5 6 .1 .2
spot cylinder rod 0 0 7 1 2 3 4 5 6 .1
spot tube pipe 0 0 7 1 2 3 4 5 6 .1
spot ring disk 0 0 8 1 2 3 0 0 1 .1 .2
spot instance tree 3 tree.oct -rz 10 0 0
spot mesh woman 1 woman.rtm 0 0
)";
constexpr std::string_view kTriangle = "void polygon p 0 0 3 1 0 0\n";

// The program xform writes 12 digits, and 6 of absorption.
void expectSame(const Description& ours, const Description& theirs) {
  ASSERT_EQ(ours.primitives.size(), theirs.primitives.size());
  for (size_t i = 0; i < ours.primitives.size(); ++i) {
    const Primitive &a = ours.primitives.at(i), &b = theirs.primitives.at(i);
    SCOPED_TRACE(fmt::format("{} {}", typeName(b.type), b.name));
    EXPECT_EQ(typeName(a.type), typeName(b.type));
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.modifier, b.modifier);
    ASSERT_EQ(a.strings, b.strings);
    for (uint32_t k = 0; k < a.strings; ++k) EXPECT_EQ(ours.string(a, k), theirs.string(b, k));
    ASSERT_EQ(a.reals, b.reals);
    const bool absorbs = a.type == Type::dielectric || a.type == Type::interface || a.type == Type::mist;
    for (uint32_t k = 0; k < a.reals; ++k)
      EXPECT_NEAR(ours.reals(a)[k], theirs.reals(b)[k], absorbs ? 1e-6 : 1e-10) << k;
  }
}

struct Case {
  std::string_view arguments, file, theirs;
};

class XformProgram : public testing::TestWithParam<Case> {};

TEST_P(XformProgram, SameArguments) {
  const TestFolder folder;
  const std::string file = folder.write("t.rad", GetParam().file);
  expectSame(readFile(fmt::format("!xform {} {}", GetParam().arguments, file)), readText(GetParam().theirs));
}

// theirs: the output of "xform ARGUMENTS t.rad" of RADIANCE 6.1a, with blanks folded.
INSTANTIATE_TEST_SUITE_P(All, XformProgram,
                         testing::Values(Case{"-n x -t 1 2 3 -rz 90 -s 2", kEachRule, R"(
void spotlight spot 0 0 7 10 10 10 30 0 0 -4
void glow near 0 0 4 1 2 3 10
void dielectric amber 0 0 5 0.707107 0.774597 0.83666 1.5 0
void interface skin 0 0 8 0.707107 0.774597 0.83666 1.5 0.948683 0.894427 0.974679 1.3
void mist fog 2 x.a>x.b x.c 0 7 0.05 0.1 0.15 0.9 0.9 0.9 0.5
void brighttext sign 2 helvet.fnt hello 0 11 -8 4 12 1.22464679915e-16 2 0 2 -1.22464679915e-16 0 0.5 0.6
void brightfunc dirt 12 dirt dirt.cal -i 1 -t 1 2 3 -rz 90 -s 2 0 1 0.3
void BSDF blind 16 0 blind.xml 0 0 1 . -i 1 -t 1 2 3 -rz 90 -s 2 0 0
spot source x.sun 0 0 4 -2 1.22464679915e-16 4 0.5
spot sphere x.ball 0 0 4 -6 2 10 1
spot bubble x.hole 0 0 4 -6 2 10 1
spot polygon x.face 0 0 12 -4 2 6 -4 6 6 -6 6 6 -6 2 6
spot cone x.hat 0 0 8 -8 4 12 -14 10 18 0.2 0.4
spot cup x.bowl 0 0 8 -8 4 12 -14 10 18 0.2 0.4
spot cylinder x.rod 0 0 7 -8 4 12 -14 10 18 0.2
spot tube x.pipe 0 0 7 -8 4 12 -14 10 18 0.2
spot ring x.disk 0 0 8 -8 4 12 0 0 2 0.2 0.4
spot instance x.tree 13 tree.oct -rz 10 -i 1 -t 1 2 3 -rz 90 -s 2 0 0
spot mesh x.woman 11 woman.rtm -i 1 -t 1 2 3 -rz 90 -s 2 0 0
)"},
                                         Case{"-I -rx 30", kEachRule, R"(
void spotlight spot 0 0 7 10 10 10 30 0 1 -1.73205080757
void glow near 0 0 4 1 2 3 5
void dielectric amber 0 0 5 0.5 0.6 0.7 1.5 0
void interface skin 0 0 8 0.5 0.6 0.7 1.5 0.9 0.8 0.95 1.3
void mist fog 2 a>b c 0 7 0.1 0.2 0.3 0.9 0.9 0.9 0.5
void brighttext sign 2 helvet.fnt hello 0
  11 1 0.232050807569 3.59807621135 1 0 0 0 -0.866025403784 -0.5 0.5 0.6
void brightfunc dirt 6 dirt dirt.cal -i 1 -rx 30 0 1 0.3
void BSDF blind 10 0 blind.xml 0 0 1 . -i 1 -rx 30 0 0
spot source sun 0 0 4 0 -0.133974596216 2.23205080757 0.5
spot bubble ball 0 0 4 0 -0.133974596216 2.23205080757 0.5
spot sphere hole 0 0 4 0 -0.133974596216 2.23205080757 0.5
spot polygon face 0 0 12 0 0.866025403784 0.5 2 0.866025403784 0.5 2 0 0 0 0 0
spot cup hat 0 0 8 1 0.232050807569 3.59807621135 4 1.33012701892 7.69615242271 0.1 0.2
spot cone bowl 0 0 8 1 0.232050807569 3.59807621135 4 1.33012701892 7.69615242271 0.1 0.2
spot tube rod 0 0 7 1 0.232050807569 3.59807621135 4 1.33012701892 7.69615242271 0.1
spot cylinder pipe 0 0 7 1 0.232050807569 3.59807621135 4 1.33012701892 7.69615242271 0.1
spot ring disk 0 0 8 1 0.232050807569 3.59807621135 -0 0.5 -0.866025403784 0.1 0.2
spot instance tree 7 tree.oct -rz 10 -i 1 -rx 30 0 0
spot mesh woman 5 woman.rtm -i 1 -rx 30 0 0
)"},
                                         Case{"-mx", kEachRule, R"(
void spotlight spot 0 0 7 10 10 10 30 0 0 -2
void glow near 0 0 4 1 2 3 5
void dielectric amber 0 0 5 0.5 0.6 0.7 1.5 0
void interface skin 0 0 8 0.5 0.6 0.7 1.5 0.9 0.8 0.95 1.3
void mist fog 2 a>b c 0 7 0.1 0.2 0.3 0.9 0.9 0.9 0.5
void brighttext sign 2 helvet.fnt hello 0 11 -1 2 3 -1 0 0 0 -1 0 0.5 0.6
void brightfunc dirt 5 dirt dirt.cal -i 1 -mx 0 1 0.3
void BSDF blind 9 0 blind.xml 0 0 1 . -i 1 -mx 0 0
spot source sun 0 0 4 0 1 2 0.5
spot sphere ball 0 0 4 0 1 2 0.5
spot bubble hole 0 0 4 0 1 2 0.5
spot polygon face 0 0 12 0 1 0 -2 1 0 -2 0 0 0 0 0
spot cone hat 0 0 8 -1 2 3 -4 5 6 0.1 0.2
spot cup bowl 0 0 8 -1 2 3 -4 5 6 0.1 0.2
spot cylinder rod 0 0 7 -1 2 3 -4 5 6 0.1
spot tube pipe 0 0 7 -1 2 3 -4 5 6 0.1
spot ring disk 0 0 8 -1 2 3 0 0 1 0.1 0.2
spot instance tree 6 tree.oct -rz 10 -i 1 -mx 0 0
spot mesh woman 4 woman.rtm -i 1 -mx 0 0
)"},
                                         Case{"-m void -I -mz -s .5", kEachRule, R"(
void spotlight spot 0 0 7 10 10 10 30 0 0 1
void glow near 0 0 4 1 2 3 2.5
void dielectric amber 0 0 5 0.25 0.36 0.49 1.5 0
void interface skin 0 0 8 0.25 0.36 0.49 1.5 0.81 0.64 0.9025 1.3
void mist fog 2 a>b c 0 7 0.2 0.4 0.6 0.9 0.9 0.9 0.5
void brighttext sign 2 helvet.fnt hello 0 11 0.5 1 -1.5 0.5 0 0 0 -0.5 0 0.5 0.6
void brightfunc dirt 7 dirt dirt.cal -i 1 -mz -s .5 0 1 0.3
void BSDF blind 11 0 blind.xml 0 0 1 . -i 1 -mz -s .5 0 0
void source sun 0 0 4 0 0.5 -1 0.5
void bubble ball 0 0 4 0 0.5 -1 0.25
void sphere hole 0 0 4 0 0.5 -1 0.25
void polygon face 0 0 12 0 0 0 1 0 0 1 0.5 0 0 0.5 0
void cup hat 0 0 8 0.5 1 -1.5 2 2.5 -3 0.05 0.1
void cone bowl 0 0 8 0.5 1 -1.5 2 2.5 -3 0.05 0.1
void tube rod 0 0 7 0.5 1 -1.5 2 2.5 -3 0.05
void cylinder pipe 0 0 7 0.5 1 -1.5 2 2.5 -3 0.05
void ring disk 0 0 8 0.5 1 -1.5 -0 -0 0.5 0.05 0.1
void instance tree 8 tree.oct -rz 10 -i 1 -mz -s .5 0 0
void mesh woman 6 woman.rtm -i 1 -mz -s .5 0 0
)"},
                                         Case{"-a 3 -t 1 0 0", kTriangle, R"(
void polygon a0.p 0 0 3 1 0 0
void polygon a1.p 0 0 3 2 0 0
void polygon a2.p 0 0 3 3 0 0
)"},
                                         Case{"-n q -a 2 -t 2 0 0 -a 2 -t 0 3 0 -i 1 -s 2", kTriangle, R"(
void polygon q.0.0.p 0 0 3 2 0 0
void polygon q.0.1.p 0 0 3 2 6 0
void polygon q.1.0.p 0 0 3 6 0 0
void polygon q.1.1.p 0 0 3 6 6 0
)"},
                                         Case{"-i 3 -rz 30 -t 0 0 1", kTriangle, R"(
void polygon p 0 0 3 2.07170436782e-16 1 3
)"},
                                         Case{"-i 0 -t 5 5 5", kTriangle, R"(
void polygon p 0 0 3 1 0 0
)"},
                                         Case{"-s -2 -rx 45 -ry 45", kTriangle, R"(
void polygon p 0 0 3 -1.41421356237 0 1.41421356237
)"}));

std::string printXform(std::string_view arguments, std::string_view text) {
  const TestFolder folder;
  return printScene(readFile(fmt::format("!xform {} {}", arguments, folder.write("t.rad", text))));
}

TEST(Xform, MatrixIsExactWhereItCanBe) {
  EXPECT_EQ(printXform("-t 1 2 3 -s 2 -my", "void sphere s 0 0 4 1 1 1 .5"),
            "void sphere s\n0\n0\n4 4 -6 8 1\n");
  EXPECT_EQ(printXform("", "void sphere s 0 0 4 .1 .2 .3 .4"), "void sphere s\n0\n0\n4 0.1 0.2 0.3 0.4\n");
}

// xform -n out -m steel -s 2 outer.rad, where outer.rad contains inner.rad, which contains a command. "xform
// outer.rad" gives the same.
TEST(Xform, CommandsWithinFilesAreTransformedTwice) {
  const TestFolder folder;
  folder.write("lib/inner.rad",
               "void mist fog 1 a>b 0 0\nvoid texfunc t 1 f.cal 0 0\nt tube p 0 0 7 0 0 0 0 0 1 1\n");
  folder.write("lib/outer.rad",
               "!xform -n in -I -t 1 0 0 inner.rad\n!printf 'void sphere s 0 0 4 0 0 0 %d\\n' 3\n");
  const std::string text = "void plastic steel 0 0 5 1 1 1 0 0\n!xform -n out -m steel -mz -s 2 " +
                           folder.path("lib/outer.rad") + "\n";
  EXPECT_EQ(printScene(readText(text)),
            "void plastic steel\n0\n0\n5 1 1 1 0 0\n"
            "void mist fog\n1 out.in.a>out.in.b\n0\n0\n"
            "void texfunc t\n12 f.cal -i 1 -t 1 0 0 -i 1 -mz -s 2\n0\n0\n"
            "steel cylinder out.in.p\n0\n0\n7 2 0 0 2 0 -2 2\n"
            "steel sphere out.s\n0\n0\n4 0 0 0 6\n");
}

TEST(Xform, ModifierOfTheCommandNeedNoOther) {
  EXPECT_EQ(printXform("-m void", "nothing sphere s 0 0 4 0 0 0 1"), "void sphere s\n0\n0\n4 0 0 0 1\n");
  EXPECT_EQ(printXform("-m void -m nothing", "x sphere s 0 0 4 0 0 0 1"), "void sphere s\n0\n0\n4 0 0 0 1\n");
}

TEST(Xform, ArgumentFile) {
  const TestFolder folder;
  folder.write("p.rad", "void source s 0 0 4 1 0 0 .5\n");
  folder.write("where.txt", "# two places\r\n\r\n-s 2\r\n!xform -n 'a name' -a 2 -s 3\r\n");
  const std::string command =
      fmt::format("!xform -f {} -s 10 {}", folder.path("where.txt"), folder.path("p.rad"));
  // xform -f where.txt -s 10 p.rad
  EXPECT_EQ(printScene(readFile(command)),
            "void source i0.s\n0\n0\n4 20 0 0 0.5\n"
            "void source \"a name.1.0.s\"\n0\n0\n4 1 0 0 0.5\n"
            "void source \"a name.1.1.s\"\n0\n0\n4 30 0 0 0.5\n");
}

TEST(Xform, FilesAreFoundAlongThePathAndCommandsRunInTheirFolder) {
  const TestFolder folder;
  folder.write("lib/desk/desk.rad", "!cat leg.txt\n!xform -t 1 0 0 ./leg.txt\n");
  folder.write("lib/desk/leg.txt", "void sphere leg 0 0 4 0 0 0 1\n");
  const char* before = getenv("RAYPATH");
  const std::string kept = before ? before : "";
  setenv("RAYPATH", folder.path("lib").c_str(), 1);
  const Description d = readText("!xform desk/desk.rad\n");
  before ? setenv("RAYPATH", kept.c_str(), 1) : unsetenv("RAYPATH");
  EXPECT_EQ(d.primitives.size(), 2u);
  EXPECT_EQ(d.at(d.primitives.at(0).place),
            fmt::format("!cat leg.txt:1 (from {}:1, room.rad:1)", folder.path("lib/desk/desk.rad")));
  EXPECT_EQ(d.at(d.primitives.at(1).place),
            fmt::format("{0}/./leg.txt:1 (from {0}/desk.rad:2, room.rad:1)", folder.path("lib/desk")));
}

TEST(Xform, ACountIsTheIntegerThatItsWordBeginsWith) {
  const TestFolder folder;
  folder.write("p.rad", kTriangle);
  const auto copies = [&](const std::string& count) {
    return readText(fmt::format("!xform -a {} -t 1 0 0 {}\n", count, folder.path("p.rad"))).primitives.size();
  };
  for (const char* count : {"3", "3.0", "3.7", "+3", "03", "3e1", "' 3'", "3x"})
    EXPECT_EQ(copies(count), 3u) << count;
}

TEST(Xform, FaultsHaveThePlaceOfTheCommand) {
  const TestFolder folder;
  folder.write("p.rad", kTriangle);
  const auto fault = [&](std::string_view arguments) {
    const std::string file = folder.path("p.rad");
    return errorOfText(fmt::format("\n!xform {}\n", fmt::vformat(arguments, fmt::make_format_args(file))));
  };
  EXPECT_EQ(fault("-t 1 0 {0}"), "room.rad:2: xform: bad option or argument at \"-t\"");
  EXPECT_EQ(fault("-s 0 {0}"), "room.rad:2: xform: bad option or argument at \"-s\"");
  EXPECT_EQ(fault("-s 1,5 {0}"), "room.rad:2: xform: bad option or argument at \"-s\"");
  EXPECT_EQ(fault("-rw 1 {0}"), "room.rad:2: xform: bad option or argument at \"-rw\"");
  EXPECT_EQ(fault("-mx -n late {0}"), "room.rad:2: xform: bad option or argument at \"-n\"");
  EXPECT_EQ(fault("-a 0 -mx {0}"), "room.rad:2: xform: missing count for -a");
  EXPECT_EQ(fault("-a {0}"), "room.rad:2: xform: missing count for -a");
  EXPECT_EQ(fault("-a .5 -mx {0}"), "room.rad:2: xform: missing count for -a");
  EXPECT_EQ(fault("-a -2 -mx {0}"), "room.rad:2: xform: missing count for -a");
  const std::string tooMany =
      "room.rad:2: xform: more than 10000000 copies: make an octree (oconv -f) of a part, and copy instances "
      "of it";
  EXPECT_EQ(fault("-a 99999999999 {0}"), tooMany);
  // They used to be copied, one after the other, until memory was used up or minutes had passed.
  EXPECT_EQ(fault("-a 100000 -t 1 0 0 -a 100000 {0}"), tooMany);
  EXPECT_EQ(fault("-a 1000 -t 1 0 0 -a 1000 -t 0 1 0 -a 11 {0}"), tooMany);
  folder.write("row.rad", "!xform -a 5000 -t 1 0 0 p.rad\n");
  EXPECT_EQ(errorOfText(fmt::format("!xform -a 5000 {}\n", folder.path("row.rad"))),
            fmt::format("{}:1 (from room.rad:1): {}", folder.path("row.rad"), tooMany.substr(12)));
  EXPECT_EQ(fault("-rx 30"),
            "room.rad:2: xform: no file named: it would read standard input, which a scene must not");
  EXPECT_EQ(fault("-f - {0}"), "room.rad:2: xform: -f - would read standard input, which a scene must not");
  EXPECT_EQ(fault("{0} -f"), "room.rad:2: xform: missing file for -f");
  EXPECT_EQ(
      errorOf([] { readText("!xform -mx no/such.rad\n"); }, rad::Status::system),
      "room.rad:1: xform: cannot find file \"no/such.rad\"" + rad::FileAccess().remark("no/such.rad", true));
  EXPECT_EQ(fault("-s 1e308 -s 10 {0}").substr(folder.path("p.rad").size()),
            ":1 (from room.rad:2): polygon \"p\": transformed arguments are not finite numbers");
}

TEST(Xform, PrimitivesThatCannotBeTransformed) {
  const TestFolder folder;
  for (const char* text :
       {"void sphere s 0 0 3 0 0 0", "void polygon p 0 0 4 0 0 0 0", "void ring r 1 a 0 8 1 2 3 4 5 6 7 8",
        "void glow g 0 0 3 1 1 1", "void brighttext t 2 f x 0 8 1 2 3 4 5 6 7 8"}) {
    EXPECT_FALSE(errorOf([&] { printXform("-mx", text); }).empty()) << text;
    EXPECT_EQ(errorOfText(text), "") << "is looked at by its user only";
  }
}

TEST(Xform, AFileThatReadsItselfEndsInAnError) {
  const TestFolder folder;
  const std::string file = folder.write("self.rad", "");
  folder.write("self.rad", fmt::format("void sphere s 0 0 4 0 0 0 1\n!xform -t 1 0 0 {}\n", file));
  const std::string error = errorOf([&] { readFile(file); });
  EXPECT_NE(error.find("100 nested files and commands"), error.npos) << error;
  EXPECT_LT(error.size(), 1000u);
  EXPECT_EQ(error.substr(0, file.size() + 3), file + ":2 ");

  const std::string list = folder.write("self.txt", "");
  folder.write("self.txt", fmt::format("-f {}\n", list));
  EXPECT_NE(errorOf([&] {
              readFile(fmt::format("!xform -f {} {}", list, file));
            }).find(":1: xform: argument files include each other without end"),
            std::string::npos);
}

TEST(Xform, PlainWords) {
  using Words = std::vector<std::string>;
  EXPECT_EQ(rad::plainWords("xform -t 1 2 3 a.rad"), (Words{"xform", "-t", "1", "2", "3", "a.rad"}));
  EXPECT_EQ(rad::plainWords("xform\t-mx \\\n  a.rad # a | b"), (Words{"xform", "-mx", "a.rad"}));
  EXPECT_EQ(rad::plainWords("xform -n \"a b\"'c' a#b"), (Words{"xform", "-n", "a bc", "a#b"}));
  EXPECT_EQ(rad::plainWords("xform -n ''"), (Words{"xform", "-n", ""}));
  EXPECT_EQ(rad::plainWords(""), Words{});
  for (const char* command :
       {"xform a | xform b", "xform a; b", "xform < a", "xform a > b", "xform $A", "xform \"$A\"",
        "xform `a`", "xform *.rad", "xform a?", "xform a\\ b", "xform 'a", "xform {a,b}", "xform a &"})
    EXPECT_EQ(rad::plainWords(command), std::nullopt) << command;
}

Similarity transformOf(std::string_view text, size_t expectUsed) {
  std::vector<std::string_view> words;
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find(' ', at), text.size());
    words.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  size_t used = 0;
  const Similarity s = rad::readTransform(words, used);
  EXPECT_EQ(used, expectUsed) << text;
  return s;
}

TEST(Similarity, InverseAndScale) {
  const Similarity s = transformOf("-rx 12 -t 1 2 3 -my -s 3 -i 5 -rz 7 -t 1 0 .5 -i 1 -ry 40", 21);
  EXPECT_NEAR(s.scale, -3, 1e-15);
  const V3d p(.3, -7, 12), q = s.inverse().point(s.point(p));
  EXPECT_NEAR((p - q).length(), 0, 1e-13);
  EXPECT_NEAR((s.point(p) - s.point(V3d(1, 1, 1))).length(), 3 * (p - V3d(1, 1, 1)).length(), 1e-12);
  EXPECT_NEAR(s.inverse().vector(s.vector(p)).x, p.x, 1e-13);
}

TEST(Similarity, StopsAtTheFirstWordThatIsNoTransform) {
  transformOf("-t 1 2 3 -s", 4);
  transformOf("-t 1 2 x", 0);
  transformOf("-mx file -my", 1);
  transformOf("-i 2 -rx 1", 4);
  transformOf("-i x", 0);
}

TEST(Similarity, RepetitionIsRepeatedMultiplication) {
  const Similarity many = transformOf("-i 2000000000 -rz 90", 4),
                   once = transformOf("-i 7 -rz 30 -t 1 0 0", 8);
  EXPECT_NEAR((many.point(V3d(1, 2, 3)) - V3d(1, 2, 3)).length(), 0, 1e-6);
  V3d p(1, 2, 3);
  const Similarity step = transformOf("-rz 30 -t 1 0 0", 6);
  for (int i = 0; i < 7; ++i) p = step.point(p);
  EXPECT_NEAR((once.point(V3d(1, 2, 3)) - p).length(), 0, 1e-13);
}

}  // namespace
