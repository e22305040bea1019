#pragma once
#include <cstdint>
#include <vector>

#include "rad_parser/calc/graph.h"

// Assigns each node of a frame to the block of code that computes it, and to the place of its value. For
// code_writer.h.
//
// Blocks are nested: the root is always evaluated, and each branch of an if() or select() is a block within
// the block of that operation. A node is placed in the innermost block that contains all its uses. If no use
// is certain, and the node costs more than a test, it becomes a cell: a separate block that is evaluated
// once, when its value is first needed. An argument of a call is also a separate block, evaluated by the
// called frame when it needs the parameter.
namespace rad::calc {

struct Block {
  uint32_t parent = kNone;
  uint32_t depth = 0;
  bool isInline = true;   // its code is part of its parent's code; false for cells and arguments
  std::vector<Id> nodes;  // operands before the operations that use them
};

struct Placement {
  uint32_t block = kNone;  // kNone: the node is not used
  bool isCell = false;
  uint32_t cell = 0;  // of a cell or parameter: its number among the frame's cells
  uint32_t reg = 0;   // register of its value, counted from the frame's first register
  // if(), select(), calls: the block of the first branch or postponed argument; the others are the following
  // blocks.
  uint32_t firstBlock = kNone;
};

struct Layout {
  static constexpr uint32_t kRoot = 0;  // index of the root in blocks

  std::vector<Block> blocks;
  std::vector<Placement> nodes;  // by Id
  // The first registers hold constants, the next ones parameters, and the remaining ones all other nodes.
  std::vector<double> constants;
  uint32_t registers = 0;
  uint32_t cells = 0;  // the first ones belong to the parameters
};

Layout layOut(const FrameGraph& frame);

// Whether a call passes this argument as code instead of a value. It does so if the argument is expensive,
// may fail, or is a parameter of the caller, which may itself be code that has not run yet.
bool isThunk(const Node& argument);

}  // namespace rad::calc
