#include "fixture.h"

namespace rad::calc {
namespace {

TEST(CalcScope, ContextsAreNamedAfterFiles) {
  EXPECT_EQ(contextOf("."), "");
  EXPECT_EQ(contextOf("wood.cal"), "`wood");
  EXPECT_EQ(contextOf("wood.CAL"), "`wood");
  EXPECT_EQ(contextOf("lib/wood-2.cal"), "`lib_wood_2");
  EXPECT_EQ(contextOf(".cal"), "`.cal");
  EXPECT_EQ(contextOf("`a`"), "`a");
}

TEST(CalcScope, FilesDoNotSeeEachOther) {
  Files files;
  files.files = {{"a.cal", "v = 1; f(t) = t+v;"}, {"b.cal", "v = 2; f(t) = t*10+v;"}};
  EXPECT_EQ(files.value("a.cal", "f(v)"), 2);
  EXPECT_EQ(files.value("b.cal", "f(v)"), 22);
  EXPECT_EQ(files.error(".", "v"), "room.rad:3: undefined variable \"v\"");
  const std::string name(600, 'v'), shown(80, 'v');
  EXPECT_EQ(files.error(".", name), "room.rad:3: undefined variable \"" + shown + "...\"");
  EXPECT_EQ(files.error(".", name + "(1)"), "room.rad:3: undefined function \"" + shown + "...()\"");
  EXPECT_EQ(files.value(".", "v`a` + 10*f`b`(0)"), 21);
  EXPECT_EQ(files.value("a.cal", "v`b`"), 2);
}

TEST(CalcScope, NearestDefinitionWins) {
  Files files;
  files.prelude = "mod(n,d) = 100; k = 7; only = 5; kept = 6;";
  files.files["a.cal"] =
      "before = mod(7,3);\n"  // the shared one, because this file has none yet
      "mod(n,d) = n-d*2;\n"
      "after = mod(7,3);\n"  // its own one
      "shared = mod`(7,3);\n"
      "own = `late + `mod(7,3); late = 9;\n"
      "self(n) = k; k = k+1;\n"  // k is the shared one in self(), and in k+1
      "k2 = k;\n"
      "further = down; down = 3;\n"  // defined further down
      "hidden = `kept;";
  EXPECT_EQ(files.value("a.cal", "before"), 100);
  EXPECT_EQ(files.value("a.cal", "after"), 1);
  EXPECT_EQ(files.value("a.cal", "shared"), 100);
  EXPECT_EQ(files.value("a.cal", "own"), 10);
  EXPECT_EQ(files.value("a.cal", "self(1)"), 7);
  EXPECT_EQ(files.value("a.cal", "k2"), 8);
  EXPECT_EQ(files.value("a.cal", "further"), 3);
  EXPECT_EQ(files.value("a.cal", "only"), 5);
  EXPECT_EQ(files.error("a.cal", "hidden"), "a.cal:9: undefined variable \"kept`a\"");
}

TEST(CalcScope, LibraryFunctionsCanBeHidden) {
  Files files;
  files.files["a.cal"] = "first = sqrt(4); sqrt(v) = 11; second = sqrt(4); third = sqrt`(4);";
  EXPECT_EQ(files.value("a.cal", "first"), 2);
  EXPECT_EQ(files.value("a.cal", "second"), 11);
  EXPECT_EQ(files.value("a.cal", "third"), 2);
  EXPECT_EQ(files.value(".", "sqrt(4)"), 2);
  files.library().define("sqrt(v) = 12;", "-e");
  EXPECT_EQ(files.value(".", "sqrt(4)"), 12);
}

TEST(CalcScope, FilesCanDefineSharedNames) {
  Files files;
  files.files["a.cal"] = "deep`P.(t) = t+1; v`  = 3; w = deep`P.(1);";
  EXPECT_EQ(files.value("a.cal", "w"), 2);
  EXPECT_EQ(files.value(".", "v"), 3);
}

// The rules of RADIANCE 6.1a and its file formats: a constant that is known by then is replaced by its value.
TEST(CalcScope, ConstantsKeepTheValueOfTheirPlace) {
  Files files;
  files.files["a.cal"] =
      "c : 3; d = c*2; f(t) : t*c; e = f(2); c : 5; g = f(2); h = c;\n"
      "late : below*2; below : 4; v = 1; w = v; v = 2;";
  EXPECT_EQ(files.value("a.cal", "d"), 6);
  EXPECT_EQ(files.value("a.cal", "e"), 6);
  EXPECT_EQ(files.value("a.cal", "g"), 6);
  EXPECT_EQ(files.value("a.cal", "h"), 5);
  EXPECT_EQ(files.value("a.cal", "late"), 8);
  EXPECT_EQ(files.value("a.cal", "w"), 2);
  ASSERT_EQ(files.warnings.size(), 1u);
  EXPECT_EQ(files.warnings[0], "a.cal:1: constant \"c`a\" redefined");
}

// RADIANCE 6.1a: "ray parameter used in constant expression", and for arg() "illegal constant in .cal file?".
TEST(CalcScope, ConstantsOfARayAreRefusedWhereTheyAreUsed) {
  Files files;
  files.hosts = {{"ray", 1, 1, [](const Point& at, std::span<const double>) { return at.inputs[0]; }}};
  const std::string why = ": constant expression depends on the ray or the primitive";
  files.files["a.cal"] =
      "k : x; f(t) : x*t; chosen(t) : if(t, 2, x); m = y; km : m; late : further; further = 4; a : arg(1); h "
      ": ray(1); c : $1; v = 1;";
  EXPECT_EQ(files.value("a.cal", "v"), 1);
  EXPECT_EQ(files.value("a.cal", "f(y)"), .125);
  EXPECT_EQ(files.value("a.cal", "chosen(1)"), 2);
  EXPECT_EQ(files.value("a.cal", "late"), 4);
  for (const char* use : {"-k", "f(1)", "chosen(-1)", "km", "a", "h", "c"}) {
    EXPECT_EQ(files.error("a.cal", use), "room.rad:3" + why) << use;
  }
  files.files["b.cal"] = "f(t) : x*t;\ng = f(2);";
  EXPECT_EQ(files.error("b.cal", "1"), "b.cal:2" + why);
}

TEST(CalcScope, InputsAreVariablesThatMayBeMissing) {
  Files files;
  EXPECT_EQ(files.value("$1+y*10+$3"), 3.25);
  EXPECT_EQ(files.error("$4"), "room.rad:3: there is no channel $4");
  EXPECT_EQ(files.compile(".", "if(x,y,1)")->inputs(), 3u);
  Request request;
  request.place = "room.rad:3";
  request.available = 3;
  std::vector<std::string> texts = {"x+y"};
  request.expressions = texts;
  EXPECT_NO_THROW(files.library().compile(request));
  texts = {"z"};
  EXPECT_THROW(files.library().compile(request), Error);
  // A variable of the file hides an input.
  files.files["a.cal"] = "z = 4;";
  EXPECT_EQ(files.value("a.cal", "z+z`"), 2);
}

TEST(CalcScope, ErrorsNameTheirPlace) {
  Files files;
  files.files = {{"a.cal", "\nf(t) = t + nothing;\ng(t) = none(t);\nh(s,t) = s+t;"},
                 {"bad.cal", "v = 1;\nw = (2;"}};
  EXPECT_EQ(files.error("a.cal", "f(1)"), "a.cal:2: undefined variable \"nothing`a\"");
  EXPECT_EQ(files.error("a.cal", "g(1)"), "a.cal:3: undefined function \"none`a()\"");
  EXPECT_EQ(files.error("a.cal", "h(1)"), "a.cal:4: h(): too few arguments");
  EXPECT_EQ(files.error("a.cal", "sin"), "room.rad:3: undefined variable \"sin\"");
  EXPECT_EQ(files.error("a.cal", "if(x)"), "room.rad:3: if(): too few arguments");
  EXPECT_EQ(files.value("a.cal", "h(1,2,3)"), 3);
  // A name that is not evaluated may be undefined.
  EXPECT_EQ(files.value("a.cal", "if(x,1,f(1))"), 1);
  EXPECT_EQ(files.error("a.cal", "if(z,1,f(1))"), "a.cal:2: undefined variable \"nothing`a\"");
  // A file with an error reports it at every request.
  EXPECT_EQ(files.error("bad.cal", "v"), "bad.cal:2: expected ')', got \";\"");
  EXPECT_EQ(files.error("bad.cal", "v"), "bad.cal:2: expected ')', got \";\"");
  EXPECT_EQ(files.error("gone.cal", "v"),
            "room.rad:3: cannot find function file \"gone.cal\" (not even \"gone.cal\")");
  EXPECT_EQ(files.error("a.cal", "v v"), "room.rad:3: expected an operator or the end, got \"v\" in \"v v\"");
}

TEST(CalcScope, FilesAreReadOnceAndWhenNeeded) {
  Files files;
  files.files = {{"a.cal", "v = 1;"}, {"prelude.cal", "p = 2;"}};
  files.prelude = "p = 3;";
  files.library();
  EXPECT_EQ(files.loads, 0);
  EXPECT_EQ(files.value("a.cal", "v+p"), 3);
  EXPECT_EQ(files.value("a.cal", "v*2"), 2);
  EXPECT_EQ(files.loads, 2);
  EXPECT_EQ(files.compile("a.cal", "v*2"), files.compile("a.cal", "v*2"));
}

TEST(CalcScope, DefinitionsOfTheCommandLine) {
  Files files;
  files.prelude = "p = 3; q = p+1;";
  files.files["more.cal"] = "r(t) = t*p;";
  files.library().define("p = 10; e = 2.5", "-e");
  files.library().include("more.cal");
  EXPECT_EQ(files.value("q+e"), 13.5);
  EXPECT_EQ(files.value("r(2)"), 20);
  EXPECT_EQ(files.compile(".", "q"), files.compile(".", "q"));
  files.library().define("p = 20;", "-e");
  EXPECT_EQ(files.value("q"), 21);
  EXPECT_THROW(files.library().include("gone.cal"), Error);
  try {
    files.library().define("p = ;", "-e");
    FAIL();
  } catch (const Error& e) {
    EXPECT_STREQ(e.what(), "-e:1: expected a number, a name or '(', got \";\"");
  }
}

TEST(CalcScope, CallsByName) {
  Files files;
  files.prelude = "noop(v) : v; shared(a,b) = a*b+x;";
  files.files["a.cal"] = "corr(v) = v*arg(1); rec(n) = if(n-.5, n*rec(n-1), 1);";
  Request request;
  request.place = "room.rad:3";
  request.file = "a.cal";
  State state;
  const auto call = [&](const char* name, std::vector<double> arguments) {
    const auto program = files.library().compileCall(request, name, static_cast<int>(arguments.size()));
    return program->evaluate({files.inputs, files.reals, arguments}, state);
  };
  EXPECT_EQ(call("noop", {4}), 4);
  EXPECT_EQ(call("shared", {4, 5}), 20.25);
  EXPECT_EQ(call("corr", {3}), 21);
  EXPECT_EQ(call("rec", {5}), 120);
  EXPECT_EQ(call("max", {3, 9, 4}), 9);
  EXPECT_THROW(call("nothing", {3}), Error);
  EXPECT_THROW(call("shared", {3}), Error);
  EXPECT_THROW(call("1+1", {3}), Error);
  EXPECT_EQ(files.library().functionArity(request, "corr"), 1);
  EXPECT_EQ(files.library().functionArity(request, "shared"), 2);
  EXPECT_EQ(files.library().functionArity(request, "atan2"), 2);
  EXPECT_EQ(files.library().functionArity(request, "x"), 0);
  EXPECT_EQ(files.library().functionArity(request, "none"), 0);
}

}  // namespace
}  // namespace rad::calc
