#pragma once
#include <bit>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "rad_parser/calc/program.h"

// Expressions as graphs of operations, between the trees of syntax.h and the code of program.h. For expand.h,
// which makes graphs, and layout.h and code_writer.h, which turn them into programs.
namespace rad::calc {

// Index of a node in its graph.
using Id = uint32_t;
inline constexpr Id kNone = 0xffffffff;

// An operation and its operands. Nodes with equal members op, a, b, c, value and list are the same node.
struct Node {
  Op op = Op::constant;
  // The first directOperands(op) of these are operands. In other operations `a` is the index of an input, an
  // argument, a parameter, a message, a frame, a host function or a node of the first frame (global);
  // realArgument has its message in `b`.
  uint32_t a = 0, b = 0, c = 0;
  double value = 0;  // constant
  // Operands of host and call. select: its index, the number of its choices as a node, the choices.
  std::vector<Id> list;

  uint32_t cost = 0;  // of this operation and all its operands as if no node were shared; unit: an addition
  bool mayFail = false;   // evaluating it can throw an error or recur without end
  bool isFinite = false;  // its value is finite at every point

  bool operator==(const Node& n) const {
    return op == n.op && a == n.a && b == n.b && c == n.c &&
           std::bit_cast<uint64_t>(value) == std::bit_cast<uint64_t>(n.value) && list == n.list;
  }
};

// How many of Node::a, b and c are operands: 0 to 3.
int directOperands(Op op);

// The operations of one frame. Each occurs once; operands come before the operations that use them.
class Graph {
 public:
  const Node& operator[](Id id) const { return nodes_[id]; }
  size_t size() const { return nodes_.size(); }

  // The node that equals n; appended if there is none yet.
  Id add(Node n);

  Id constant(double value);
  Id leaf(Op op, uint32_t a);
  bool isConstant(Id id) const { return nodes_[id].op == Op::constant; }
  bool isConstant(Id id, double value) const { return isConstant(id) && nodes_[id].value == value; }

  // An operator or function of one to three arguments, simplified. Operations on constants are evaluated
  // unless they fault: a fault must be reported each time that the program runs.
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
  std::vector<Id> globals;  // nodes of the first frame that other frames refer to
};

}  // namespace rad::calc
