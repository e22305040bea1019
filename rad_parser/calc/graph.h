#pragma once
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "rad_parser/calc/program.h"

// Expressions as graphs of operations, between the syntax trees (syntax.h) and the code (program.h). Graphs
// are made by expand.h, and turned into programs by layout.h and code_writer.h.
namespace rad::calc {

// Index of a node in its graph.
using Id = uint32_t;
inline constexpr Id kNone = 0xffffffff;

// An operation and its operands. A graph has at most one node for each combination of op, a, b, c, value and
// list.
struct Node {
  Op op = Op::constant;
  // The first directOperands(op) of these are operands. For other operations, `a` is the index of an input,
  // an argument, a parameter, a message, a frame, a host function or a node of the first frame (global). For
  // realArgument, `b` is the index of its message.
  uint32_t a = 0, b = 0, c = 0;
  double value = 0;  // constant
  // host, call: operands. select: its index; a constant, the number of choices, which is the value for
  // index 0; then the choices.
  std::vector<Id> list{};

  uint32_t cost = 0;  // of this operation and all its operands as if no node were shared; unit: one addition
  bool mayFail = false;   // whether evaluation may throw an error or recurse endlessly
  bool isFinite = false;  // whether its value is finite at every point

  bool operator==(const Node& n) const {
    return op == n.op && a == n.a && b == n.b && c == n.c &&
           std::bit_cast<uint64_t>(value) == std::bit_cast<uint64_t>(n.value) && list == n.list;
  }
};

// The number of operands among Node::a, b and c: 0 to 3.
int directOperands(Op op);

// The operations of one frame. Each occurs once; operands come before the operations that use them.
class Graph {
 public:
  const Node& operator[](Id id) const { return nodes_[id]; }
  size_t size() const { return nodes_.size(); }

  // The node that equals n; it is appended if it does not exist.
  Id add(Node n);

  Id constant(double value);
  Id leaf(Op op, uint32_t a);
  bool isConstant(Id id) const { return nodes_[id].op == Op::constant; }
  bool isConstant(Id id, double value) const { return isConstant(id) && nodes_[id].value == value; }

  // An operation with one to three operands, simplified. Operations on constants are evaluated, unless this
  // causes a fault: faults must be reported whenever the program runs.
  Id operate(Op op, Id a, Id b = kNone, Id c = kNone);

 private:
  Id product(Id a, int times);
  Id raise(Id a, Id b);
  void weigh(Node& n) const;
  bool isAlwaysFinite(const Node& n) const;

  std::vector<Node> nodes_;
  std::unordered_multimap<uint64_t, Id> known_;  // by hash
};

// A frame while it is being compiled: its graph and the nodes of its results.
struct FrameGraph {
  Graph graph;
  std::string name;  // for messages
  uint32_t parameters = 0;
  std::vector<Id> results;
  std::vector<Id> globals;  // nodes of the first frame that are used in other frames
};

}  // namespace rad::calc
