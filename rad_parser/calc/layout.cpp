#include "rad_parser/calc/layout.h"

#include <algorithm>

namespace rad::calc {
namespace {

// Nodes up to this cost are computed even if no use is certain. Unit: one addition.
constexpr uint32_t kCheap = 8;

bool isPostponed(const Node& n) { return n.cost > kCheap || n.mayFail; }

class Planner {
 public:
  explicit Planner(const FrameGraph& frame) : frame_(frame), graph_(frame.graph) {
    out_.nodes.resize(graph_.size());
    hasCertainUse_.resize(graph_.size());
  }

  Layout plan() {
    placeNodes();
    assignRegisters();
    return std::move(out_);
  }

 private:
  uint32_t newBlock(uint32_t parent, bool isInline) {
    const auto index = static_cast<uint32_t>(out_.blocks.size());
    const uint32_t depth = parent == kNone ? 0 : out_.blocks[parent].depth + 1;
    out_.blocks.push_back({parent, depth, isInline, {}});
    return index;
  }

  // The innermost block that contains both blocks.
  uint32_t common(uint32_t a, uint32_t b) const {
    while (a != b) {
      if (out_.blocks[a].depth >= out_.blocks[b].depth) {
        a = out_.blocks[a].parent;
      } else {
        b = out_.blocks[b].parent;
      }
    }
    return a;
  }

  void use(Id id, uint32_t block) {
    Placement& p = out_.nodes[id];
    if (p.block == kNone) {
      p.block = block;
      hasCertainUse_[id] = true;
      return;
    }
    const uint32_t shared = common(p.block, block);
    hasCertainUse_[id] = (hasCertainUse_[id] && shared == p.block) || shared == block;
    p.block = shared;
  }

  // Proceeds from users to operands, so that all uses of a node are known before it is placed.
  void placeNodes() {
    newBlock(kNone, true);
    for (Id id : frame_.results) use(id, Layout::kRoot);
    std::vector<bool> isGlobal(graph_.size(), false);
    for (Id id : frame_.globals) {
      use(id, Layout::kRoot);
      isGlobal[id] = true;
    }
    for (Id id = static_cast<Id>(graph_.size()); id-- > 0;) {
      Placement& p = out_.nodes[id];
      const Node& n = graph_[id];
      if (p.block == kNone || n.op == Op::constant || n.op == Op::parameter) continue;
      p.isCell = isGlobal[id] || (!hasCertainUse_[id] && isPostponed(n));
      if (p.isCell) p.block = newBlock(p.block, false);
      out_.blocks[p.block].nodes.push_back(id);
      useOperands(id, p.block);
    }
    for (Block& b : out_.blocks) std::ranges::reverse(b.nodes);
  }

  void useOperands(Id id, uint32_t block) {
    const Node& n = graph_[id];
    switch (n.op) {
      case Op::ifPositive:
        use(n.a, block);
        branch(id, block, n.b, true);
        branch(id, block, n.c, true);
        break;
      case Op::select:
        use(n.list[0], block);
        for (size_t i = 1; i < n.list.size(); ++i) branch(id, block, n.list[i], true);
        break;
      case Op::call:
        for (Id operand : n.list) {
          if (isThunk(graph_[operand])) {
            branch(id, block, operand, false);
          } else {
            use(operand, block);
          }
        }
        break;
      default: {
        const int operands = directOperands(n.op);
        if (operands > 0) use(n.a, block);
        if (operands > 1) use(n.b, block);
        if (operands > 2) use(n.c, block);
        for (Id operand : n.list) use(operand, block);
      }
    }
  }

  void branch(Id id, uint32_t block, Id operand, bool isInline) {
    const uint32_t inner = newBlock(block, isInline);
    if (out_.nodes[id].firstBlock == kNone) out_.nodes[id].firstBlock = inner;
    use(operand, inner);
  }

  void assignRegisters() {
    for (Id id = 0; id < graph_.size(); ++id) {
      if (out_.nodes[id].block == kNone || graph_[id].op != Op::constant) continue;
      out_.nodes[id].reg = static_cast<uint32_t>(out_.constants.size());
      out_.constants.push_back(graph_[id].value);
    }
    const auto constants = static_cast<uint32_t>(out_.constants.size());
    uint32_t next = constants + frame_.parameters;
    out_.cells = frame_.parameters;
    for (Id id = 0; id < graph_.size(); ++id) {
      const Node& n = graph_[id];
      Placement& p = out_.nodes[id];
      if (p.block == kNone || n.op == Op::constant) continue;
      if (n.op == Op::parameter) {
        p.reg = constants + n.a;
        p.cell = n.a;
        continue;
      }
      p.reg = next++;
      if (p.isCell) p.cell = out_.cells++;
    }
    out_.registers = std::max(next, 1u);
  }

  const FrameGraph& frame_;
  const Graph& graph_;
  std::vector<bool> hasCertainUse_;  // by Id: whether the block that contains all uses itself uses it
  Layout out_;
};

}  // namespace

bool isThunk(const Node& argument) { return argument.op == Op::parameter || isPostponed(argument); }

Layout layOut(const FrameGraph& frame) { return Planner(frame).plan(); }

}  // namespace rad::calc
