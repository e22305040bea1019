#include "rad_parser/calc/syntax.h"

#include <gtest/gtest.h>

#include <random>

#include "rad_parser/error.h"
#include "tests/unit/support/print_syntax.h"

namespace rad::calc {
namespace {

std::string errorOf(std::string_view text) {
  try {
    parseDefinitions(text, "fun.cal");
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

std::string errorOfExpression(std::string_view text) {
  try {
    parseExpression(text, "room.rad:3");
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

TEST(CalcSyntax, DefinitionsAsFilesHaveThem) {
  const auto all = parseDefinitions(
      "{ a comment { within } one }\n"
      ";; PI : 3.14 ;\n"
      "f(a,b_2)=a+b_2 ; `own.name = f (1,\n 2);last`ctx` : $3",
      "fun.cal");
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(print(all[0]), "PI : 3.14;");
  EXPECT_EQ(print(all[1]), "f(a, b_2) = a+b_2;");
  EXPECT_EQ(print(all[2]), "`own.name = f(1, 2);");
  EXPECT_EQ(print(all[3]), "last`ctx` : $3;");
  EXPECT_EQ(all[1].body.args[0].kind, Syntax::Kind::parameter);
  EXPECT_EQ(all[1].line, 3u);
  EXPECT_EQ(all[3].line, 4u);
}

TEST(CalcSyntax, ErrorsHaveTheirPlace) {
  EXPECT_EQ(errorOf("a=1;\nb=2\nc=3;"), "fun.cal:3: expected ';', got \"c\"");
  EXPECT_EQ(errorOf("a = sin(1;"), "fun.cal:1: expected ')', got \";\"");
  EXPECT_EQ(errorOf("a = (1+2;"), "fun.cal:1: expected ')', got \";\"");
  EXPECT_EQ(errorOf("\n\n{ never {closed}\n\n"),
            "fun.cal:3: expected '}' to end the comment that begins here");
  EXPECT_EQ(errorOf("a 1;"), "fun.cal:1: expected '=' or ':', got \"1\"");
  EXPECT_EQ(errorOf("1 = 2;"), "fun.cal:1: expected a name to define, got \"1\"");
  EXPECT_EQ(errorOf("f(1) = 2;"), "fun.cal:1: expected a parameter's name, got \"1\"");
  EXPECT_EQ(errorOf("f(a`b) = 2;"), "fun.cal:1: expected a parameter's name without '`', got \"a`b\"");
  EXPECT_EQ(errorOf("a = ;"), "fun.cal:1: expected a number, a name or '(', got \";\"");
  EXPECT_EQ(errorOf("a = 1 +"), "fun.cal:1: expected a number, a name or '(', got the end");
  EXPECT_EQ(errorOf("a = f();"), "fun.cal:1: expected a number, a name or '(', got \")\"");
  EXPECT_EQ(errorOf("a = .;"), "fun.cal:1: expected a digit, got \";\"");
  EXPECT_EQ(errorOf("a = 1e;"), "fun.cal:1: expected an exponent, got \";\"");
  EXPECT_EQ(errorOf("a = --1;"), "fun.cal:1: expected a number, a name or '(', got \"-\"");
  EXPECT_EQ(errorOf("a = \x01;"), "fun.cal:1: expected a number, a name or '(', got \"\\x01\"");
  EXPECT_EQ(errorOf("gr\u00f6sse = 1;"), "fun.cal:1: expected '=' or ':', got \"\u00f6\"");
  EXPECT_EQ(errorOf("a = ``;"), "fun.cal:1: expected a name after '`', got \";\"");
  EXPECT_EQ(errorOfExpression("1 2"), "room.rad:3: expected an operator or the end, got \"2\" in \"1 2\"");
  EXPECT_EQ(errorOfExpression(""), "room.rad:3: expected a number, a name or '(', got the end in \"\"");
}

TEST(CalcSyntax, NestingIsLimitedChainsAreNot) {
  EXPECT_EQ(errorOfExpression(std::string(300, '(') + "1" + std::string(300, ')')), "no error");
  EXPECT_NE(errorOfExpression(std::string(100000, '(')).find("nested more than 400 deep"), std::string::npos);
  std::string power = "2";
  for (int i = 0; i < 100000; ++i) power += "^2";
  EXPECT_NE(errorOfExpression(power).find("nested more than 400 deep"), std::string::npos);
  std::string sum = "1";
  for (int i = 0; i < 100000; ++i) sum += "+1*2";
  EXPECT_EQ(errorOfExpression(sum), "no error");
}

// A random tree of the grammar as text, with random blanks and comments.
class Trees {
 public:
  explicit Trees(uint32_t seed) : random_(seed) {}

  Syntax tree(int depth) {
    Syntax s;
    const int kind = depth > 0 ? pick(9) : pick(4);
    switch (kind) {
      case 0:
      case 1:
        s.kind = Syntax::Kind::number;
        s.number = pick(2) ? pick(100) : std::ldexp(static_cast<double>(random_()), pick(80) - 60);
        break;
      case 2:
        s.kind = Syntax::Kind::channel;
        s.index = pick(30);
        break;
      case 3:
        s.kind = Syntax::Kind::name;
        s.text = name();
        break;
      case 4:
        s.kind = Syntax::Kind::negate;
        s.args.push_back(tree(depth - 1));
        break;
      case 5:
        s.kind = Syntax::Kind::power;
        s.args = {tree(depth - 1), tree(depth - 1)};
        break;
      case 6:
        s.kind = Syntax::Kind::call;
        s.args.emplace_back();
        s.args[0].kind = Syntax::Kind::name;
        s.args[0].text = name();
        for (int i = 0; i <= pick(3); ++i) s.args.push_back(tree(depth - 1));
        break;
      default:
        s.kind = kind == 7 ? Syntax::Kind::sum : Syntax::Kind::product;
        s.args.push_back(tree(depth - 1));
        for (int i = 0; i <= pick(3); ++i) {
          s.text += kind == 7 ? "+-"[pick(2)] : "*/"[pick(2)];
          s.args.push_back(tree(depth - 1));
        }
    }
    return s;
  }

  int pick(int n) { return static_cast<int>(random_() % static_cast<uint32_t>(n)); }

 private:
  std::string name() {
    static const char* names[] = {"a",  "Px",   "noise3",       "`own", "un2`P.",
                                  "A_", "Qa_5", "x_rand`local", "glob`"};
    return names[pick(9)];
  }

  std::mt19937 random_;
};

TEST(CalcSyntax, PrintedTreesParseToTheSame) {
  Trees trees(1);
  for (int i = 0; i < 2000; ++i) {
    const Syntax tree = trees.tree(5);
    const std::string text = print(tree);
    Syntax again;
    ASSERT_NO_THROW(again = parseExpression(text, "test")) << text;
    EXPECT_TRUE(same(tree, again)) << text << "\n" << print(again);
    if (i % 10 == 0) {
      // The comparison detects a different operator.
      const size_t plus = text.find('+');
      if (plus != std::string::npos && text[plus - 1] != 'e') {
        std::string spoiled = text;
        spoiled[plus] = '-';
        EXPECT_FALSE(same(tree, parseExpression(spoiled, "test"))) << spoiled;
      }
    }
  }
}

}  // namespace
}  // namespace rad::calc
