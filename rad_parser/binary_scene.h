#pragma once
#include <cstdint>

#include "rad_parser/binary_reader.h"
#include "rad_parser/description_builder.h"

namespace rad {

// The parts that octrees and meshes have in common. What is wrong is thrown with the byte where it was
// noticed.

// The width in bytes of object numbers, 1 to 8, from the format number: what it exceeds `magic` by.
// otherFormat: what the header says where that is not the format of these data; the reason that is thrown for
// a number out of range.
int readIndexWidth(BinaryReader& input, int magic, std::string_view otherFormat = {});

// The cube that encloses everything: four numbers, as text.
Cube readCube(BinaryReader& input);

// Passes over the cells of an octree, in the order of the file, without keeping any: object(n) for each entry
// of each leaf, where n is object number or, in a mesh, triangle number. Entries of a leaf ascend. Time and
// data are in proportion, memory is none.
template <class Object>
void passOverCells(BinaryReader& input, int width, Object object) {
  for (uint64_t open = 1; open > 0; --open) {  // cells announced and not yet met
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

// Primitives in binary, to the builder's file `file`, whose places are their numbers. Their modifiers are
// earlier ones of the same data, which begin the builder's description. The names of unknown types are
// warnings until a primitive has one. Returns how many there were.
//
// An alias names by number what it stands for where it shares that one's modifier; it gets its name for an
// argument, which may be another than the alias was written with.
int64_t readPrimitives(BinaryReader& input, int width, uint32_t file, DescriptionBuilder& builder,
                       const Warn& warn);

}  // namespace rad
