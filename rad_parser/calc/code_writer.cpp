#include "rad_parser/calc/code_writer.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "rad_parser/calc/layout.h"
#include "rad_parser/error.h"

namespace rad::calc {

// Writes the nodes of a block in the order of their creation, in which operands precede their users.
class CodeWriter {
 public:
  explicit CodeWriter(Expansion expansion) : frames_(std::move(expansion.frames)) {
    program_->messages_ = std::move(expansion.messages);
    program_->hosts_ = std::move(expansion.hosts);
  }

  std::shared_ptr<const Program> write() {
    emit(Op::fail);  // at 0, which is never the target of a jump
    program_->frames_.resize(frames_.size());
    for (size_t i = 0; i < frames_.size(); ++i) writeFrame(i);
    summarize();
    return program_;
  }

 private:
  using Instruction = Program::Instruction;
  static constexpr uint32_t kRoot = Layout::kRoot;

  struct Postponed {  // a block that is written after the frame's root
    uint32_t block;
    Id result;
    uint32_t patch;  // index of the entry for its start: in cellStarts_ for a cell, otherwise in lists_
    bool isCell;
  };

  uint32_t emit(Op op, uint32_t to = 0, uint32_t a = 0, uint32_t b = 0, uint32_t c = 0) {
    program_->code_.push_back({op, to, a, b, c});
    return static_cast<uint32_t>(program_->code_.size() - 1);
  }
  uint32_t here() const { return static_cast<uint32_t>(program_->code_.size()); }

  const Node& node(Id id) const { return (*graph_)[id]; }
  const Placement& placed(Id id) const { return layout_.nodes[id]; }
  uint32_t reg(Id id) const { return layout_.nodes[id].reg; }

  void writeFrame(size_t index) {
    const FrameGraph& frame = frames_[index];
    graph_ = &frame.graph;
    layout_ = layOut(frame);
    ensured_.assign(layout_.blocks.size(), {});
    postponed_.clear();
    Program::Frame& out = program_->frames_[index];
    out.name = frame.name;
    out.parameters = frame.parameters;
    reserve(out);
    if (index == 0) refuseCertainFailure();

    out.begin = here();
    writeBlock(kRoot);
    for (Id id : frame.results) ensure(id, kRoot);
    if (index == 0) {
      for (Id id : frame.results) program_->outputs_.push_back(reg(id));
      emit(Op::halt);
    } else {
      emit(Op::returnCall, 0, reg(frame.results[0]));
    }
    for (Id id = 0; id < graph_->size(); ++id) {
      if (placed(id).isCell)
        postponed_.push_back({placed(id).block, id, out.firstCell + placed(id).cell, true});
    }
    for (Id id : frame.globals) globals_[id] = {placed(id).cell, reg(id)};
    writePostponed();
  }

  // Reserves constants and cells of the frame in the program.
  void reserve(Program::Frame& out) {
    std::vector<double>& constants = program_->constants_;
    out.firstConstant = static_cast<uint32_t>(constants.size());
    out.constants = static_cast<uint32_t>(layout_.constants.size());
    constants.insert(constants.end(), layout_.constants.begin(), layout_.constants.end());
    out.registers = layout_.registers;
    out.firstCell = static_cast<uint32_t>(program_->cellStarts_.size());
    out.cells = layout_.cells;
    program_->cellStarts_.resize(out.firstCell + out.cells);
  }

  void refuseCertainFailure() const {
    for (Id id : layout_.blocks[kRoot].nodes) {
      if (node(id).op == Op::fail) throw Error(program_->messages_[node(id).a]);
    }
  }

  // Writing a postponed block may postpone more blocks.
  void writePostponed() {
    for (size_t i = 0; i < postponed_.size(); ++i) {
      const Postponed p = postponed_[i];
      (p.isCell ? program_->cellStarts_ : program_->lists_)[p.patch] = here();
      writeBlock(p.block);
      if (!p.isCell) ensure(p.result, p.block);
      emit(Op::returnCell, 0, reg(p.result));
    }
  }

  void writeBlock(uint32_t block) {
    for (Id id : layout_.blocks[block].nodes) writeNode(id, block);
  }

  // Ensures that a node's register holds its value when the code of the block continues.
  void ensure(Id id, uint32_t block) {
    if (!placed(id).isCell && node(id).op != Op::parameter) return;
    if (isEnsured(id, block)) return;
    emit(Op::force, reg(id), placed(id).cell);
    ensured_[block].push_back(id);
  }

  bool isEnsured(Id id, uint32_t block) const {
    while (true) {
      const std::vector<Id>& ensured = ensured_[block];
      if (std::ranges::find(ensured, id) != ensured.end()) return true;
      const Block& b = layout_.blocks[block];
      if (!b.isInline || b.parent == kNone) return false;
      block = b.parent;
    }
  }

  void writeNode(Id id, uint32_t block) {
    const Node& n = node(id);
    const uint32_t to = reg(id);
    switch (n.op) {
      case Op::constant:
      case Op::parameter: break;
      case Op::input:
      case Op::argument:
      case Op::fail: emit(n.op, to, n.a); break;
      case Op::global: {
        const auto& [cell, from] = globals_.at(n.a);
        emit(Op::forceGlobal, from, cell);
        emit(Op::global, to, from);
        break;
      }
      case Op::ifPositive: writeIf(id, block); break;
      case Op::select: writeSelect(id, block); break;
      case Op::host: writeHostCall(id, block); break;
      case Op::call: writeCall(id, block); break;
      case Op::realArgument:
        ensure(n.a, block);
        emit(n.op, to, reg(n.a), n.b);
        break;
      default: {
        const int operands = directOperands(n.op);
        ensure(n.a, block);
        if (operands > 1) ensure(n.b, block);
        if (operands > 2) ensure(n.c, block);
        emit(n.op, to, reg(n.a), operands > 1 ? reg(n.b) : 0, operands > 2 ? reg(n.c) : 0);
      }
    }
  }

  void writeBranch(uint32_t block, Id result, uint32_t to) {
    writeBlock(block);
    ensure(result, block);
    emit(node(result).isFinite ? Op::move : Op::moveFinite, to, reg(result));
  }

  void writeIf(Id id, uint32_t block) {
    const Node& n = node(id);
    ensure(n.a, block);
    const uint32_t test = emit(Op::jumpUnlessPositive, 0, reg(n.a));
    const uint32_t first = placed(id).firstBlock;
    writeBranch(first, n.b, reg(id));
    const uint32_t skip = emit(Op::jump);
    program_->code_[test].b = here();
    writeBranch(first + 1, n.c, reg(id));
    program_->code_[skip].a = here();
  }

  void writeSelect(Id id, uint32_t block) {
    const Node& n = node(id);
    ensure(n.list[0], block);
    const auto choices = static_cast<uint32_t>(n.list.size() - 1);
    const auto list = static_cast<uint32_t>(program_->lists_.size());
    program_->lists_.resize(list + choices + 1);
    emit(Op::choose, 0, reg(n.list[0]), list, choices);
    std::vector<uint32_t> jumps;
    program_->lists_[list] = emit(Op::zeroRange, reg(id));
    jumps.push_back(emit(Op::jump));
    for (uint32_t k = 0; k < choices; ++k) {
      program_->lists_[list + 1 + k] = here();
      writeBranch(placed(id).firstBlock + k, n.list[k + 1], reg(id));
      jumps.push_back(emit(Op::jump));
    }
    for (uint32_t jump : jumps) program_->code_[jump].a = here();
  }

  void writeHostCall(Id id, uint32_t block) {
    const Node& n = node(id);
    for (Id operand : n.list) ensure(operand, block);
    const auto list = static_cast<uint32_t>(program_->lists_.size());
    for (Id operand : n.list) program_->lists_.push_back(reg(operand));
    emit(Op::host, reg(id), n.a, list, static_cast<uint32_t>(n.list.size()));
  }

  // Writes three entries for each argument: its register, the code that computes it (kDone if none is
  // needed), and its cell in the caller's frame (kNoCell if there is none).
  void writeCall(Id id, uint32_t block) {
    const Node& n = node(id);
    for (Id operand : n.list) {
      if (!isThunk(node(operand))) ensure(operand, block);
    }
    const auto list = static_cast<uint32_t>(program_->lists_.size());
    program_->lists_.resize(list + 3 * n.list.size());
    uint32_t inner = placed(id).firstBlock;
    for (size_t i = 0; i < n.list.size(); ++i) {
      const Id operand = n.list[i];
      const auto entry = list + 3 * static_cast<uint32_t>(i);
      program_->lists_[entry] = reg(operand);
      program_->lists_[entry + 1] = Program::kDone;
      program_->lists_[entry + 2] = Program::kNoCell;
      if (!isThunk(node(operand))) continue;
      const Placement& p = placed(operand);
      const bool hasCell = p.isCell || node(operand).op == Op::parameter;
      const bool isThere = hasCell ? isEnsured(operand, block) : p.block != inner;
      if (!isThere) postponed_.push_back({inner, operand, entry + 1, false});
      if (hasCell) program_->lists_[entry + 2] = p.cell;
      ++inner;
    }
    emit(Op::call, reg(id), n.a, list);
  }

  // Records the inputs that the code may read, and whether its values are constant.
  void summarize() {
    program_->constant_ = true;
    for (const Instruction& i : program_->code_) {
      if (i.op == Op::input && i.a < 64) program_->inputs_ |= uint64_t{1} << i.a;
      if (i.op == Op::host) program_->inputs_ |= program_->hosts_[i.a].needs;
      const bool isOpen = i.op == Op::input || i.op == Op::argument || i.op == Op::realArgument ||
                          i.op == Op::host || (i.op == Op::fail && &i != program_->code_.data());
      if (isOpen) program_->constant_ = false;
    }
  }

  std::deque<FrameGraph> frames_;
  std::shared_ptr<Program> program_ = std::make_shared<Program>();
  std::unordered_map<Id, std::pair<uint32_t, uint32_t>> globals_;  // cells and registers of the first frame

  // Of the frame being written:
  const Graph* graph_ = nullptr;
  Layout layout_;
  std::vector<std::vector<Id>> ensured_;  // by block: cells and parameters that its code has evaluated
  std::vector<Postponed> postponed_;
};

std::shared_ptr<const Program> writeProgram(Expansion expansion) {
  return CodeWriter(std::move(expansion)).write();
}

}  // namespace rad::calc
