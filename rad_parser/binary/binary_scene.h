#pragma once
#include <cstdint>

#include "rad_parser/binary/binary_reader.h"
#include "rad_parser/description_builder.h"

namespace rad {

// Reads the parts that octrees and meshes have in common. Errors contain the byte at which they were noticed.

// Reads the width of object numbers, 1 to 8 bytes: the format number minus `magic`. Throws if it is out of
// range. otherFormat: the format named in the header, if it differs from the expected one; the error then
// gives it as the reason.
int readIndexWidth(BinaryReader& input, int magic, std::string_view otherFormat = {});

// The cube that encloses all surfaces. It is stored as four numbers in text.
Cube readCube(BinaryReader& input);

// Reads the cells of an octree in file order, without storing them. Calls object(n) for each entry of each
// leaf, where n is the number of an object (in a mesh, of a triangle). The entries of a leaf are in ascending
// order. Takes constant memory, and time in proportion to the data.
template <class Object>
void passOverCells(BinaryReader& input, int width, Object object) {
  for (uint64_t open = 1; open > 0; --open) {  // cells not yet read
    switch (input.byte()) {
      case 0: break;
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
      case 2: open += 8; break;
      default: throw input.fault("damaged octree");
    }
  }
}

// Reads binary primitives into the builder, as primitives of file `file`; their places are their numbers.
// Modifiers refer to earlier primitives of the same data, which must be the first in the builder's
// description. An unknown type name causes a warning, and an error if a primitive has this type. Returns the
// number of primitives.
//
// An alias with the same modifier as another primitive refers to it by number, any other alias by name. In
// the former case the name of that primitive becomes the string argument of the alias, which may differ from
// the name in the original text.
int64_t readPrimitives(BinaryReader& input, int width, uint32_t file, DescriptionBuilder& builder,
                       const Warn& warn);

}  // namespace rad
