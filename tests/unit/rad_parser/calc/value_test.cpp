#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <random>
#include <thread>

#include "fixture.h"
#include "rad_parser/calc/syntax.h"

namespace rad::calc {
namespace {

// RADIANCE 6.1a: rcalc -n -e '$1=EXPRESSION'. It lacks erf and erfc; their values are those of glibc.
TEST(CalcValue, LibraryFunctionsAsTheOriginals) {
  const std::pair<const char*, double> table[] = {
      {"sin(.7)", 0.644217687},
      {"cos(.7)", 0.764842187},
      {"tan(.7)", 0.84228838},
      {"asin(.7)", 0.775397497},
      {"acos(.7)", 0.79539883},
      {"atan(.7)", 0.610725964},
      {"atan2(-1,-2)", -2.67794504},
      {"exp(.7)", 2.01375271},
      {"log(.7)", -0.356674944},
      {"log10(.7)", -0.15490196},
      {"sqrt(.7)", 0.836660027},
      {"floor(-.5)", -1},
      {"ceil(.5)", 1},
      {"rand(.3)", 0.64873052},
      {"rand(-5.2)", 0.823676307},
      {"rand(1e8)", 0.721199528},
      {"min(3,-1,2)", -1},
      {"max(3,-1,2)", 3},
      {"min(4)", 4},
      {"select(0,5,6,7)", 3},
      {"select(1.4,5,6,7)", 5},
      {"select(1.6,5,6,7)", 6},
      {"if(0,1,2)", 2},
      {"if(1e-300,1,2)", 1},
      {"-2^2", 4},
      {"2^3^2", 512},
      {"7-3-2", 2},
      {"8/4/2", 1},
      {"2--3", 5},
      {"2^-1", .5},
      {"erf(.4)", 0.428392355},
      {"erfc(2.5)", 0.000406952017},
  };
  Files files;
  for (const auto& [text, expected] : table)
    EXPECT_NEAR(files.value(text), expected, 5e-9 * (1 + std::abs(expected))) << text;
  // The same, evaluated at run time instead of in advance.
  for (const auto& [text, expected] : table) {
    std::string late;
    for (const char* c = text; *c != '\0'; ++c) {
      late += *c;
      // "(" + .7 -> "(" + (x-x) + ...: makes each argument variable
      if (*c == '(' || *c == ',') late += "(x-.25)+";
    }
    if (late.find("+-") == std::string::npos) {
      EXPECT_NEAR(files.value(late), expected, 5e-9 * (1 + std::abs(expected))) << late;
    }
  }
}

// Abramowitz and Stegun, tables 9.1 and 9.2.
TEST(CalcValue, BesselFunctions) {
  Files files;
  EXPECT_NEAR(files.value("j0(2)"), 0.223890779141236, 1e-14);
  EXPECT_NEAR(files.value("j1(2)"), 0.576724807756873, 1e-14);
  EXPECT_NEAR(files.value("jn(2,2)"), 0.352834028615638, 1e-14);
  EXPECT_NEAR(files.value("y0(2)"), 0.510375672649745, 1e-14);
  EXPECT_NEAR(files.value("y1(2)"), -0.107032431540938, 1e-14);
  EXPECT_NEAR(files.value("yn(2,2)"), -0.617408104190683, 1e-14);
}

// As in rcalc: rcalc -n -e 'x=0;$1=1/x' prints "Division by zero" and 0, and so on.
TEST(CalcValue, FaultsAreZeroAndAreNoted) {
  const std::tuple<const char*, double, uint32_t> table[] = {
      {"1/(x-.25)", 0, kDivisionByZero},
      {"1+1/(x-.25)", 1, kDivisionByZero},
      {"(x-.25)/(x-.25)", 0, kDivisionByZero},
      {"log(z)", 0, kDomainError},
      {"log(x-.25)", 0, kRangeError},
      {"sqrt(z)", 0, kDomainError},
      {"exp(500*-z)", 0, kRangeError},
      {"(z*4)^(1/3)", 0, kIllegalPower},
      {"(x-.25)^-1", 0, kIllegalPower},
      {"(x*1e200)^2", 0, kRangeError},
      {"acos(z)", 0, kDomainError},
      {"atan2(x-.25,x-.25)", 0, 0},
      {"select(x*40,1,2)", 0, kDomainError},
      {"select(z,1,2)", 0, kDomainError},
      {"if(x,x*1e300*1e300,0)", 0, kRangeError},
      {"max(x*1e300*1e300,0)", 0, kRangeError},
      {"(x-.25)^0", 1, 0},
      {"(x*1e-200)^2", 0, 0},
      {"x*1e300*1e300", HUGE_VAL, 0},
      {"0^(x-.25)", 0, 0},
  };
  Files files;
  for (const auto& [text, expected, faults] : table) {
    EXPECT_EQ(files.value(text), expected) << text;
    EXPECT_EQ(files.faults, faults) << text;
  }
}

// rtrace reports "bad constant expression". rcalc, which evaluates no constants in advance, returns 0.
TEST(CalcValue, ConstantsWithoutValueAreErrors) {
  Files files;
  EXPECT_EQ(files.error("1/0*x"), "room.rad:3: constant expression has no value: division by zero");
  EXPECT_EQ(files.error("x/0"), "room.rad:3: constant expression has no value: division by zero");
  EXPECT_EQ(files.error("sqrt(-1)"), "room.rad:3: constant expression has no value: domain error");
  EXPECT_EQ(files.error("log(0)"), "room.rad:3: constant expression has no value: range error");
  EXPECT_EQ(files.error("(-1)^.5"), "room.rad:3: constant expression has no value: illegal power");
  EXPECT_EQ(files.error("select(3,1,2)"), "room.rad:3: constant expression has no value: domain error");
  files.files["c.cal"] = "a = x;\nb : 1/(2-2);";
  EXPECT_EQ(files.error("c.cal", "a"), "c.cal:2: constant expression has no value: division by zero");
}

TEST(CalcValue, ConstantExpressionsTakeNoInstructions) {
  Files files;
  files.files["c.cal"] =
      "f(n) : if(n-1.5, n*f(n-1), 1); K : f(10)/f(8); g = K*x; octaves(s) = if(s-1.01, 0, "
      "sin(x/s) + octaves(2*s));";
  EXPECT_EQ(files.value("c.cal", "K"), 90);
  EXPECT_TRUE(files.compile("c.cal", "K")->isConstant());
  // The unused first instruction, the input, the product and the end.
  EXPECT_EQ(files.compile("c.cal", "g")->size(), 4u);
  EXPECT_EQ(files.compile("c.cal", "g")->inputs(), 1u);
  EXPECT_FALSE(files.compile("c.cal", "g")->isConstant());
  // Recursion over a constant is expanded: no call is left, and common parts are merged.
  const auto octaves = files.compile("c.cal", "octaves(1/8)");
  EXPECT_LT(octaves->size(), 17u);
  EXPECT_NEAR(files.value("c.cal", "octaves(1/8)"),
              std::sin(2.) + std::sin(1.) + std::sin(.5) + std::sin(.25), 1e-15);
}

TEST(CalcValue, EqualPartsAreEvaluatedOnce) {
  static int calls;
  calls = 0;
  Files files;
  files.hosts = {{"count", 1, 0, [](const Point&, std::span<const double> a) {
                    ++calls;
                    return a[0];
                  }}};
  files.files["c.cal"] =
      "v = count(x); f(a,b) = a+a+b*a+g(a); g(t) = t+t; r(n) = if(n-.5, v+r(n-1), count(y));";
  const auto once = [&](const std::string& text, double expected, int times) {
    calls = 0;
    EXPECT_EQ(files.value("c.cal", text), expected) << text;
    EXPECT_EQ(calls, times) << text;
  };
  once("v+v*v", .25 + .0625, 1);
  once("f(v,v)", 1.0625, 1);
  once("if(x, v, 3) + if(y, v, 4)", .5, 1);  // in branches that may not be reached
  once("if(z, v, 3) + if(z, v, 4)", 7, 0);
  once("if(z, count(y), count(x)) + if(y, count(y), 1)", .75, 2);
  once("select(1+x, v, count(y), v*v)", .25, 1);
  once("r(x*20)", 5 * .25 + .5, 2);  // a variable in a recursive function
  once("if(z, f(v,count(z)), 1)", 1, 0);
}

TEST(CalcValue, ArgumentsAreEvaluatedWhenNeeded) {
  Files files;
  files.files["c.cal"] =
      "mine(c,a,b) = if(c,a,b);\n"
      "fact(n) = mine(n-1.5, n*fact(n-1), 1);\n"
      "endless(n) = endless(n+1);\n"
      "first(a,b) = a;\n"
      "late(n,v) = if(n-.5, late(n-1,v), v);\n"
      "never(n,v) = if(n-.5, never(n-1,v), 5);\n"
      "sum(n,acc) = if(n-.5, sum(n-1,acc+n), acc);\n"
      "fib(n) = if(n-1.5, fib(n-1)+fib(n-2), n);\n";
  EXPECT_EQ(files.value("c.cal", "fact(6)"), 720);
  EXPECT_EQ(files.value("c.cal", "fact(x*24)"), 720);
  EXPECT_EQ(files.value("c.cal", "first(3, endless(x))"), 3);
  EXPECT_EQ(files.value("c.cal", "late(y*20, sin(x))"), std::sin(.25));
  EXPECT_EQ(files.value("c.cal", "never(y*20, endless(x))"), 5);
  EXPECT_EQ(files.value("c.cal", "never(y*20, undefined_name)"), 5);
  EXPECT_EQ(files.value("c.cal", "sum(y*200, 0)"), 5050);
  EXPECT_EQ(files.value("c.cal", "fib(y*40)"), 6765);
}

TEST(CalcValue, FunctionsAsArguments) {
  Files files;
  files.files["c.cal"] =
      "d1(f,x) = (f(x+1e-7)-f(x-1e-7))/1e-7/2;\n"
      "twice(f,v) = f(f(v)); sq(v) = v*v; compose(f,g,v) = f(g(v));\n"
      "total(f,n) = if(n-.5, f(n)+total(f,n-1), 0);\n"
      "swap(f,g,n) = if(n-.5, f(n)+swap(g,f,n-1), 0);\n"
      "dot(a,b) = a(1)*b(1)+a(2)*b(2); P(i) = select(i,x,y); Q(i) = i;\n"
      "pass(f,v) = twice(f,v);\n";
  EXPECT_NEAR(files.value("c.cal", "d1(sin,1.1)"), std::cos(1.1), 1e-8);
  EXPECT_EQ(files.value("c.cal", "twice(sq,y)"), .0625);
  EXPECT_EQ(files.value("c.cal", "pass(sq,y)"), .0625);
  EXPECT_EQ(files.value("c.cal", "compose(sqrt,sq,z)"), 2);
  EXPECT_EQ(files.value("c.cal", "total(sq,y*8)"), 30);
  EXPECT_NEAR(files.value("c.cal", "swap(sq,sqrt,y*8)"), 16 + std::sqrt(3) + 4 + 1, 1e-14);
  EXPECT_EQ(files.value("c.cal", "dot(P,Q)"), 1.25);
  EXPECT_EQ(files.error("c.cal", "twice(3,x)"), "c.cal:2: f(): argument that is called is not a function");
  EXPECT_EQ(files.error("c.cal", "twice(x,x)"), "c.cal:2: undefined function \"x()\"");
}

TEST(CalcValue, EndlessRecursionIsAnError) {
  Files files;
  files.files["c.cal"] =
      "f(n) = f(n+1);\ng(n) = h(n)+1; h(n) = g(n);\na = b; b = a;\nt(n) = t(n)+t(n+1);\n"
      "c : k(1); k(n) : k(n);\nboth(n) = if(n-1, both(n-1)+both(n-2), 1);\ndown(n) = if(n, 1+down(n-1), 0);";
  const std::string end = "recursion is too deep or endless";
  EXPECT_EQ(files.error("c.cal", "f(x)"), "c.cal:1: f(): " + end);
  EXPECT_EQ(files.error("c.cal", "f(1)"), "c.cal:1: f(): " + end);
  EXPECT_NE(files.error("c.cal", "g(x)").find(end), std::string::npos);
  EXPECT_EQ(files.error("c.cal", "t(x)"), "c.cal:4: t(): " + end);
  EXPECT_NE(files.error("c.cal", "a").find("is defined in terms of itself"), std::string::npos);
  EXPECT_EQ(files.value("c.cal", "down(y*180000)"), 90000);
  // The recursion is not deep, but has about 1e12 calls.
  EXPECT_EQ(files.error("c.cal", "both(y*120)"), "c.cal:6: both(): more than 20000000 calls");
  // The state is usable after an error.
  State state;
  const auto bad = files.compile("c.cal", "f(x)");
  EXPECT_THROW(bad->evaluate({files.inputs, {}, {}}, state), Error);
  EXPECT_EQ(files.compile("c.cal", "down(y*10)")->evaluate({files.inputs, {}, {}}, state), 5);
}

TEST(CalcValue, DeepDefinitionsAreAnErrorNotACrash) {
  Files files;
  std::string text = "v0 = x;";
  for (int i = 1; i < 20000; ++i) text += "v" + std::to_string(i) + " = v" + std::to_string(i - 1) + "+1;";
  files.files["c.cal"] = text;
  EXPECT_EQ(files.value("c.cal", "v1000"), 1000.25);
  EXPECT_NE(files.error("c.cal", "v19999").find("nested too deeply"), std::string::npos);
  std::string wide = "f0(a) = a+x;";
  for (int i = 1; i < 30; ++i) {
    const std::string f = "f" + std::to_string(i - 1);
    wide += "f" + std::to_string(i) + "(a) = " + f + "(a+1)+" + f + "(a);";
  }
  files.files["wide.cal"] = wide;
  EXPECT_EQ(files.value("wide.cal", "f10(x)"), 1024 * (.5 + 5));
  EXPECT_NO_THROW(files.compile("wide.cal", "f29(x)"));
}

TEST(CalcValue, RealArguments) {
  Files files;
  files.files["c.cal"] = "A1 = arg(1); n = arg(0); late(i) = arg(i);";
  EXPECT_EQ(files.value("c.cal", "A1+n*100"), 307);
  EXPECT_EQ(files.value("c.cal", "late(1.6)"), 8);
  EXPECT_EQ(files.value("c.cal", "arg(-5)+arg(y*6)"), 12);
  EXPECT_EQ(files.error("c.cal", "A1+arg(4)"), "room.rad:3: missing real argument 4");
  EXPECT_EQ(files.error("c.cal", "late(9)"), "room.rad:3: c.cal:1: missing real argument 9");
  // They are constants if they are given in advance.
  const std::vector<double> reals = {2, 5};
  const std::vector<std::string> texts = {"A1*n+late(2)"};
  Request request;
  request.file = "c.cal";
  request.expressions = texts;
  request.reals = reals;
  EXPECT_TRUE(files.library().compile(request)->isConstant());
  State state;
  EXPECT_EQ(files.library().compile(request)->evaluate({}, state), 9);
  const std::vector<std::string> missing = {"if(z,arg(3),1)"};
  request.expressions = missing;
  EXPECT_EQ(files.library().compile(request)->evaluate({files.inputs, {}, {}}, state), 1);
}

// An independent evaluation for the tests: by name, each argument anew at every use, nothing in advance.
class Plain {
 public:
  std::map<std::string, const Definition*> definitions;
  std::map<std::string, double> inputs;

  struct Frame {
    const Syntax* call = nullptr;
    const Frame* caller = nullptr;
  };

  double value(const Syntax& s, const Frame* frame) {
    switch (s.kind) {
      case Syntax::Kind::number:
        return s.number;
      case Syntax::Kind::channel:
        return inputs.at("x");
      case Syntax::Kind::name:
        return inputs.count(s.text) ? inputs[s.text] : value(definitions.at(s.text)->body, nullptr);
      case Syntax::Kind::parameter:
        return value(frame->call->args[static_cast<size_t>(s.index) + 1], frame->caller);
      case Syntax::Kind::negate:
        return -value(s.args[0], frame);
      case Syntax::Kind::power:
        return finite(std::pow(value(s.args[0], frame), value(s.args[1], frame)));
      case Syntax::Kind::sum:
      case Syntax::Kind::product: {
        double v = value(s.args[0], frame);
        for (size_t i = 0; i < s.text.size(); ++i) {
          const double w = value(s.args[i + 1], frame);
          switch (s.text[i]) {
            case '+':
              v += w;
              break;
            case '-':
              v -= w;
              break;
            case '*':
              v *= w;
              break;
            default:
              v = w == 0 ? 0 : v / w;
          }
        }
        return v;
      }
      case Syntax::Kind::call:
        return call(s, frame);
    }
    return 0;
  }

 private:
  static double finite(double v) { return std::isfinite(v) ? v : 0; }

  double call(const Syntax& s, const Frame* frame) {
    const Syntax* callee = &s.args[0];
    for (const Frame* f = frame; callee->kind == Syntax::Kind::parameter; f = f->caller) {
      callee = &f->call->args[static_cast<size_t>(callee->index) + 1];
    }
    const auto found = definitions.find(callee->text);
    if (found != definitions.end()) {
      const Frame inner{&s, frame};
      return value(found->second->body, &inner);
    }
    const auto arg = [&](size_t i) { return value(s.args[i], frame); };
    const std::string& f = callee->text;
    if (f == "if") return finite(arg(1) > 0 ? arg(2) : arg(3));
    if (f == "select") {
      const double x = arg(1);
      const int n = static_cast<int>(x + .5), count = static_cast<int>(s.args.size()) - 1;
      if (x < -.5 || x > 100 || n >= count) return 0;
      return n == 0 ? count - 1 : finite(arg(static_cast<size_t>(n) + 1));
    }
    if (f == "min") return finite(std::min(arg(1), arg(2)));
    if (f == "max") return finite(std::max(arg(1), arg(2)));
    if (f == "sin") return finite(std::sin(arg(1)));
    if (f == "cos") return finite(std::cos(arg(1)));
    if (f == "sqrt") return finite(std::sqrt(arg(1)));
    if (f == "log") return finite(std::log(arg(1)));
    if (f == "exp") return finite(std::exp(arg(1)));
    if (f == "atan2") return finite(std::atan2(arg(1), arg(2)));
    ADD_FAILURE() << f;
    return 0;
  }
};

// Random files of variables, functions, functions of functions and recursive functions,
// and expressions with these.
class RandomFile {
 public:
  explicit RandomFile(uint32_t seed) : random_(seed) {
    for (int i = 0; i < 4; ++i) {
      parameters_ = {};
      constant_ = pick(4) == 0;
      text += "v" + std::to_string(i) + (constant_ ? " : " : " = ") + tree(constant_ ? 2 : 3) + ";\n";
      variables_.push_back(constant_);
      parameters_ = {"a", "b"};
      constant_ = pick(4) == 0;
      text +=
          "f" + std::to_string(i) + "(a, b)" + (constant_ ? " : " : " = ") + tree(constant_ ? 2 : 3) + ";\n";
      functions_.push_back(constant_);
    }
    constant_ = false;
    parameters_ = {"a"};
    text += joined({"h(g, a) = g(a, ", tree(1), ")*.5 + g(", tree(1), ", a);\n"});
    parameters_ = {"n", "a"};
    text += joined({"r(n, a) = if(n - .53, ", tree(2), " + .5*r(n - 1, ", tree(2), "), ", tree(1), ");\n"});
    complete_ = true;
    parameters_ = {};
  }

  std::string tree(int depth) {
    if (depth == 0 || pick(6) == 0) {
      const int kind = pick(4);
      if (kind == 0) return std::to_string(pick(40) / 8. - 1.13).substr(0, 5);
      if (kind == 1 && !parameters_.empty())
        return parameters_[static_cast<size_t>(pick(2)) % parameters_.size()];
      if (kind == 2 && isThere(variables_)) return "v" + std::to_string(one(variables_));
      return constant_ ? "." + std::to_string(pick(90)) : std::string(1, "xyz"[pick(3)]);
    }
    const auto t = [&] { return tree(depth - 1); };
    switch (pick(18)) {
      case 0:
        return joined({"if(", t(), " - .0317, ", t(), ", ", t(), ")"});
      case 1:
        return joined({"select(", t(), " + 1.0717, ", t(), ", ", t(), ", ", t(), ")"});
      case 2:
        return joined({"min(", t(), ", ", t(), ")"});
      case 3:
        return joined({"max(", t(), ", ", t(), ")"});
      case 4:
        return "sin(" + t() + ")";
      case 5:
        return "sqrt(" + t() + ")";
      case 6:
        return "log(" + t() + ")";
      case 7:
        return joined({"atan2(", t(), ", ", t(), ")"});
      case 8:
        return joined({"(", t(), ")^", std::to_string(pick(5))});
      case 9:
        return "(-" + std::string("(") + t() + "))";
      case 10:
        return joined({"(", t(), ")/(", t(), ")"});
      case 11:
      case 12:
        if (isThere(functions_))
          return joined({"f", std::to_string(one(functions_)), "(", t(), ", ", t(), ")"});
        return "cos(" + t() + ")";
      case 13:
        if (complete_) return joined({"h(f", std::to_string(pick(4)), ", ", t(), ")"});
        return joined({"(", t(), "-", t(), ")"});
      case 14:
        if (complete_) return joined({"r(", pick(2) ? "3" : "12*y", ", ", t(), ")"});
        return "exp(" + t() + ")";
      case 15:
        return joined({"(", t(), ")/", std::to_string(pick(7) + 1)});
      default:
        return joined({"(", t(), "*", t(), "+", t(), ")"});
    }
  }

  // In this order with every compiler, as the operands of + are not.
  static std::string joined(std::initializer_list<std::string> parts) {
    std::string result;
    for (const std::string& part : parts) result += part;
    return result;
  }

  int pick(int n) { return static_cast<int>(random_() % static_cast<uint32_t>(n)); }

  std::string text;

 private:
  // The definitions so far, by whether they are constant, because a constant may use only constants.
  bool isThere(const std::vector<bool>& defined) const {
    return std::any_of(defined.begin(), defined.end(), [&](bool c) { return c || !constant_; });
  }
  int one(const std::vector<bool>& defined) {
    while (true) {
      const auto i = static_cast<size_t>(pick(static_cast<int>(defined.size())));
      if (defined[i] || !constant_) return static_cast<int>(i);
    }
  }

  std::mt19937 random_;
  std::vector<std::string> parameters_;
  std::vector<bool> variables_, functions_;
  bool constant_ = false;  // a constant is being written
  bool complete_ = false;
};

TEST(CalcValue, RandomExpressionsAgainstPlainEvaluation) {
  int compared = 0, refused = 0;
  for (uint32_t seed = 0; seed < 250; ++seed) {
    RandomFile random(seed);
    Files files;
    files.files["c.cal"] = random.text;
    std::vector<Definition> definitions;
    for (Definition& d : parseDefinitions(random.text, "c.cal")) definitions.push_back(std::move(d));
    Plain plain;
    for (const Definition& d : definitions) plain.definitions[d.name] = &d;
    for (int k = 0; k < 6; ++k) {
      const std::string text = random.tree(4);
      const Syntax tree = parseExpression(text, "test");
      std::shared_ptr<const Program> program;
      try {
        program = files.compile("c.cal", text);
      } catch (const Error& e) {
        // Constants that the language refuses, such as 1/0.
        ASSERT_NE(std::string(e.what()).find("constant expression has no value"), std::string::npos)
            << e.what();
        ++refused;
        continue;
      }
      for (int point = 0; point < 4; ++point) {
        for (double& v : files.inputs) v = random.pick(1000) / 250. - 2;
        plain.inputs = {{"x", files.inputs[0]}, {"y", files.inputs[1]}, {"z", files.inputs[2]}};
        State state;
        const double value = program->evaluate({files.inputs, {}, {}}, state);
        const double expected = plain.value(tree, nullptr);
        // The difference is rounding: a division by a constant is done by multiplication, and
        // small powers by products.
        if (std::isfinite(expected)) {
          EXPECT_NEAR(value, expected, 1e-9 * (1 + std::abs(expected))) << text << "\n" << random.text;
        }
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 4000);
  EXPECT_LT(refused, 500);
}

TEST(CalcValue, ThreadsShareProgramsAndLibrary) {
  RandomFile random(8);
  Files files;
  files.files["c.cal"] = random.text;
  std::vector<std::string> texts;
  for (int i = 0; i < 40; ++i) texts.push_back("sin(" + std::to_string(i) + "*x)+v0*h(f1,r(12*y,z))");
  std::vector<double> alone;
  for (const std::string& text : texts) alone.push_back(files.value("c.cal", text));
  Files fresh;
  fresh.files = files.files;
  fresh.library();
  std::vector<std::vector<double>> together(4);
  std::vector<std::thread> threads;
  for (auto& mine : together) {
    threads.emplace_back([&] {
      for (const std::string& text : texts) {
        State state;
        mine.push_back(fresh.compile("c.cal", text)->evaluate({fresh.inputs, fresh.reals, {}}, state));
      }
    });
  }
  for (std::thread& t : threads) t.join();
  for (const auto& mine : together) EXPECT_EQ(mine, alone);
  EXPECT_EQ(fresh.loads, 1);
}

// A fault that is found in advance is still a fault: x*0 is known to be 0.
TEST(CalcValue, FaultsOfWhatFoldsToConstantsAreSeen) {
  Files files;
  EXPECT_EQ(files.value("1/(x*0)"), 0);
  EXPECT_EQ(files.faults, kDivisionByZero);
  EXPECT_EQ(files.value("(x*0)/(y*0)"), 0);
  EXPECT_EQ(files.faults, kDivisionByZero);
  EXPECT_EQ(files.value("sqrt(x*0-1)+2"), 2);
  EXPECT_EQ(files.faults, kDomainError);
}

}  // namespace
}  // namespace rad::calc
