#include "rad_parser/calc/graph.h"

#include <gtest/gtest.h>

#include <limits>

namespace rad::calc {
namespace {

TEST(CalcGraph, EqualOperationsAreOneNode) {
  Graph graph;
  const Id x = graph.leaf(Op::input, 0), y = graph.leaf(Op::input, 1);
  EXPECT_EQ(graph.operate(Op::add, x, y), graph.operate(Op::add, y, x));
  EXPECT_NE(graph.operate(Op::subtract, x, y), graph.operate(Op::subtract, y, x));
  EXPECT_EQ(graph.operate(Op::sin, x), graph.operate(Op::sin, graph.leaf(Op::input, 0)));
  EXPECT_NE(graph.constant(0.), graph.constant(-0.));
}

TEST(CalcGraph, OperationsAreSimplified) {
  Graph graph;
  const Id x = graph.leaf(Op::input, 0), zero = graph.constant(0), one = graph.constant(1);
  EXPECT_EQ(graph.operate(Op::add, x, zero), x);
  EXPECT_EQ(graph.operate(Op::multiply, one, x), x);
  EXPECT_EQ(graph.operate(Op::multiply, x, zero), zero);
  EXPECT_EQ(graph.operate(Op::negate, graph.operate(Op::negate, x)), x);
  EXPECT_EQ(graph.operate(Op::subtract, x, one), graph.operate(Op::add, x, graph.constant(-1)));
  EXPECT_EQ(graph.operate(Op::divide, x, graph.constant(4)),
            graph.operate(Op::multiply, x, graph.constant(.25)));
  EXPECT_EQ(graph.operate(Op::power, x, one), x);  // inputs are finite
  EXPECT_EQ(graph.operate(Op::power, x, graph.constant(.5)), graph.operate(Op::sqrt, x));
  EXPECT_TRUE(graph.isConstant(graph.operate(Op::add, one, one), 2));
}

TEST(CalcGraph, FaultsAreLeftToEvaluation) {
  Graph graph;
  const Id zero = graph.constant(0), one = graph.constant(1);
  EXPECT_FALSE(graph.isConstant(graph.operate(Op::divide, one, zero)));
  EXPECT_FALSE(graph.isConstant(graph.operate(Op::log, zero)));
  EXPECT_FALSE(
      graph.isConstant(graph.operate(Op::finite, graph.constant(std::numeric_limits<double>::infinity()))));
}

TEST(CalcGraph, CostsAndFailuresComeFromOperands) {
  Graph graph;
  const Id x = graph.leaf(Op::input, 0), failure = graph.leaf(Op::fail, 0);
  const Id sum = graph.operate(Op::add, x, graph.constant(1)), sine = graph.operate(Op::sin, sum);
  EXPECT_EQ(graph[x].cost, 0u);
  EXPECT_EQ(graph[sum].cost, 1u);
  EXPECT_GT(graph[sine].cost, graph[sum].cost);
  EXPECT_FALSE(graph[sine].mayFail);
  EXPECT_TRUE(graph[graph.operate(Op::add, sine, failure)].mayFail);
  EXPECT_TRUE(graph[sine].isFinite);
  EXPECT_FALSE(graph[sum].isFinite);
  // A cost that would overflow is capped.
  Id large = sine;
  for (int i = 0; i < 40; ++i) large = graph.operate(Op::multiply, large, large);
  EXPECT_LE(graph[large].cost, 1u << 20);
}

}  // namespace
}  // namespace rad::calc
