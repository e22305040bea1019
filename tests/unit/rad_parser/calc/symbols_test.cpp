#include "rad_parser/calc/symbols.h"

#include <gtest/gtest.h>

#include "tests/unit/support/print_syntax.h"

namespace rad::calc {
namespace {

using Names = std::vector<std::string>;

TEST(CalcSymbols, CandidatesAreNearestFirst) {
  EXPECT_EQ(candidates("a", ""), Names{"a"});
  EXPECT_EQ(candidates("a", "`wood"), (Names{"a`wood", "a"}));
  EXPECT_EQ(candidates("`a", "`wood"), Names{"a`wood"});
  EXPECT_EQ(candidates("a`", "`wood"), Names{"a"});
  EXPECT_EQ(candidates("a`b", "`wood"), (Names{"a`b`wood", "a`b"}));
}

bool define(SymbolTable& table, std::string_view text, const std::string& context) {
  return table.define(parseDefinitions(text, "a.cal").front(), context);
}

TEST(CalcSymbols, ReferencesFindOneSymbol) {
  SymbolTable table(0, {}, {});
  const int before = table.refer("v", "`a");
  EXPECT_EQ(table[before].name, "v`a");
  EXPECT_EQ(table[before].definition, nullptr);
  EXPECT_FALSE(define(table, "v = 1;", "`a"));
  EXPECT_EQ(table.refer("v", "`a"), before);
  EXPECT_NE(table[before].definition, nullptr);
  EXPECT_EQ(table.find("v"), -1);
  EXPECT_NE(table.refer("v", "`b"), before);
  EXPECT_NE(table[table.refer("sin", "`a")].library, nullptr);
}

// Only these can change what other requests mean.
TEST(CalcSymbols, RedefinitionsAndOtherContextsAreReported) {
  Names warnings;
  SymbolTable table(0, {}, [&](std::string_view warning) { warnings.emplace_back(warning); });
  EXPECT_FALSE(define(table, "v : 1;", "`a"));
  EXPECT_FALSE(define(table, "w = 1;", "`a"));
  EXPECT_TRUE(define(table, "w = 2;", "`a"));
  EXPECT_TRUE(define(table, "u = 1;", ""));
  EXPECT_TRUE(define(table, "u`b` = 1;", "`a"));
  EXPECT_TRUE(warnings.empty());
  EXPECT_TRUE(define(table, "v : 2;", "`a"));
  EXPECT_EQ(warnings, Names{"a.cal:1: constant \"v`a\" redefined"});
}

TEST(CalcSymbols, ConstantPartsBecomeNumbers) {
  SymbolTable table(1, {}, {});
  define(table, "k : 3;", "");
  define(table, "f(t) : t * k;", "");
  define(table, "v = 5;", "");
  const auto bound = [&](std::string_view text) {
    Syntax tree = parseExpression(text, "room.rad:3");
    table.bind(tree, "", "room.rad:3", false);
    return print(tree);
  };
  EXPECT_EQ(bound("k + 1"), "4");
  EXPECT_EQ(bound("f(k - 1) + $1"), "6+$1");
  EXPECT_EQ(bound("sqrt(k * k) * v"), "3*v");
  EXPECT_EQ(bound("f(v)"), "f(v)");
  EXPECT_THROW(bound("k / 0"), Error);
}

}  // namespace
}  // namespace rad::calc
