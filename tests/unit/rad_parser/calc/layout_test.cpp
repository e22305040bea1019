#include "rad_parser/calc/layout.h"

#include <gtest/gtest.h>

#include <set>

namespace rad::calc {
namespace {

Id choice(Graph& graph, Id condition, Id yes, Id no) {
  Node n;
  n.op = Op::ifPositive;
  n.a = condition;
  n.b = yes;
  n.c = no;
  return graph.add(n);
}

// if(x, sin(y), 3): only the branch needs the sine.
TEST(CalcLayout, ValueOfOneBranchIsInThatBranch) {
  FrameGraph frame;
  Graph& graph = frame.graph;
  const Id x = graph.leaf(Op::input, 0), sine = graph.operate(Op::sin, graph.leaf(Op::input, 1));
  const Id result = choice(graph, x, sine, graph.constant(3));
  frame.results = {result};
  const Layout layout = layOut(frame);
  EXPECT_EQ(layout.nodes[result].block, Layout::kRoot);
  EXPECT_EQ(layout.nodes[sine].block, layout.nodes[result].firstBlock);
  EXPECT_TRUE(layout.blocks[layout.nodes[sine].block].isInline);
  EXPECT_EQ(layout.blocks[layout.nodes[sine].block].parent, Layout::kRoot);
  EXPECT_FALSE(layout.nodes[sine].isCell);
  EXPECT_EQ(layout.cells, 0u);
  EXPECT_EQ(layout.constants, std::vector<double>{3});
}

// if(x, sin(y), 3) + if(y, sin(y), 4): the sine may be needed twice or never.
TEST(CalcLayout, ExpensiveValueOfSeveralBranchesIsACell) {
  FrameGraph frame;
  Graph& graph = frame.graph;
  const Id x = graph.leaf(Op::input, 0), y = graph.leaf(Op::input, 1), sine = graph.operate(Op::sin, y);
  const Id first = choice(graph, x, sine, graph.constant(3)),
           second = choice(graph, y, sine, graph.constant(4));
  frame.results = {graph.operate(Op::add, first, second)};
  const Layout layout = layOut(frame);
  EXPECT_TRUE(layout.nodes[sine].isCell);
  EXPECT_FALSE(layout.blocks[layout.nodes[sine].block].isInline);
  EXPECT_EQ(layout.blocks[layout.nodes[sine].block].parent, Layout::kRoot);
  EXPECT_EQ(layout.cells, 1u);
  std::set<uint32_t> registers;
  for (const Placement& p : layout.nodes) registers.insert(p.reg);
  EXPECT_EQ(registers.size(), graph.size());
  EXPECT_EQ(layout.registers, graph.size());
}

// The same with y + 1, which costs less than the test whether it has been computed; and with a sine that the
// root needs too.
TEST(CalcLayout, CheapOrCertainValueIsComputedAtOnce) {
  FrameGraph frame;
  Graph& graph = frame.graph;
  const Id x = graph.leaf(Op::input, 0), y = graph.leaf(Op::input, 1);
  const Id sum = graph.operate(Op::add, y, graph.constant(1)), sine = graph.operate(Op::sin, y);
  frame.results = {choice(graph, x, sum, sine), choice(graph, y, sum, sine), sine};
  const Layout layout = layOut(frame);
  for (Id id : {sum, sine}) {
    EXPECT_FALSE(layout.nodes[id].isCell);
    EXPECT_EQ(layout.nodes[id].block, Layout::kRoot);
  }
}

TEST(CalcLayout, UnusedNodesHaveNoPlace) {
  FrameGraph frame;
  const Id unused = frame.graph.leaf(Op::input, 0);
  frame.results = {frame.graph.constant(2)};
  const Layout layout = layOut(frame);
  EXPECT_EQ(layout.nodes[unused].block, kNone);
  EXPECT_TRUE(layout.blocks[Layout::kRoot].nodes.empty());
  EXPECT_EQ(layout.registers, 1u);
}

}  // namespace
}  // namespace rad::calc
