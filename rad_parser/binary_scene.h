#pragma once
#include <cstdint>

#include "rad_parser/binary_reader.h"
#include "rad_parser/description_builder.h"

namespace rad {

// The parts that octrees and meshes have in common. Errors are thrown with the byte at
// which they were noticed.

// The width of object numbers, 1 to 8 bytes: the difference between the format number and `magic`.
// otherFormat: the format that the header names, if it is not the format of these data. It is given as the
// reason in the error that is thrown for a width out of range.
int readIndexWidth(BinaryReader& input, int magic, std::string_view otherFormat = {});

// The cube that encloses all surfaces. It is stored as four numbers in text.
Cube readCube(BinaryReader& input);

// Reads the cells of an octree in the order of the file, without keeping them. Calls object(n) for each entry
// of each leaf, where n is an object number, or a triangle number in a mesh. The entries of a leaf ascend.
// Takes time in proportion to the data, and constant memory.
template <class Object>
void passOverCells(BinaryReader& input, int width, Object object) {
  for (uint64_t open = 1; open > 0; --open) {  // cells that are still to come
    switch (input.byte()) {
      case 0:
        break;
      case 1: {
        const int64_t n = input.integer(width);
        if (n < 0) throw input.fault("damaged octree: a leaf of negative size");
        int64_t last = INT64_MIN;
        for (int64_t i = 0; i < n; ++i) {
          const int64_t entry = input.integer(width);
          if (entry <= last) throw input.fault("damaged octree: a leaf out of order");
          last = entry;
          object(entry);
        }
        break;
      }
      case 2:
        open += 8;
        break;
      default:
        throw input.fault("damaged octree");
    }
  }
}

// Reads binary primitives into the builder, as primitives of its file `file`. Their places are their
// numbers. Their modifiers are earlier primitives of the same data, which must begin the builder's
// description. An unknown type name causes a warning, and an error once a primitive has this type. Returns
// the number of primitives.
//
// An alias refers to another primitive by number if both have the same modifier; otherwise by name. In the
// former case the name of that primitive becomes the alias's string argument, which may differ from the name
// that the alias was written with.
int64_t readPrimitives(BinaryReader& input, int width, uint32_t file, DescriptionBuilder& builder,
                       const Warn& warn);

}  // namespace rad
