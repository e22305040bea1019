#pragma once
#include <Imath/ImathVec.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rad_parser/description.h"
#include "rad_parser/error.h"
#include "rad_parser/file_path.h"

namespace rad {

// A compiled triangle mesh (.rtm) as obj2mesh(1) writes it, and as a scene names it:
//   mod mesh id
//   1+n meshfile transform
//   0
//   0
// meshfile is found along RAYPATH. The n words of transform are xform's options (readTransform(), xform.h)
// and take the mesh's coordinates to those of the scene, vertices and normals alike; a mirroring one turns no
// triangle round. mod is the material of every triangle; where it is void, each has its own. The normal of a
// side follows the right-hand rule in the order of the vertices (in the mesh's coordinates). Where all three
// vertices have a normal, the surface is smoothed: its normal is interpolated with barycentric weights;
// likewise (u,v), which is (0,0) where a vertex has none. Source: RADIANCE reference manual, "Mesh";
// obj2mesh(1).
//
// Coordinates are kept in the format's own precision, 32 bits in the cube or in the range of (u,v), and
// normals as a code of 32 bits: half or less of the memory that doubles would take. Every corner of
// `triangles` is an index of positions; normals and uvs have the length of positions, or 0 where no vertex
// has any.
struct Mesh {
  static constexpr int32_t kNoMaterial = -1;

  struct Triangle {
    std::array<uint32_t, 3> vertices;
    int32_t material;  // index of materials.primitives, or kNoMaterial
  };

  Description materials;  // modifiers only; header and cube too. Places are their numbers
  Imath::V2d uvLow, uvHigh;
  std::vector<std::array<uint32_t, 3>> positions;
  std::vector<uint32_t> normals;
  std::vector<std::array<uint32_t, 2>> uvs;
  std::vector<Triangle> triangles;

  // In units of the mesh; within 2^-33 of the cube's size, in each coordinate, of what was compiled.
  Imath::V3d position(uint32_t vertex) const;

  // Unit length, within 0.006 degrees of what was compiled. Empty where the vertex has none.
  std::optional<Imath::V3d> normal(uint32_t vertex) const;

  // Within 2^-33 of the range of each. Empty where the vertex has none.
  std::optional<Imath::V2d> uv(uint32_t vertex) const;
};

// The direction that a code of 32 bits stands for, of unit length; zero for 0. Bits 0 to 2 are the signs of
// x, y and z; bits 5 to 17 and 18 to 30 are the two smallest magnitudes of the three, times (2^13 - 1/2) sqrt
// 2: of x and y the smaller comes first (bit 3: it is x), then the smaller of z and the other (bit 4: it is
// z). Source: RADIANCE's own encoding (settled by its source, dircode.c), mean error 0.0022 degrees.
Imath::V3d decodeDirection(uint32_t code);

// Reads a mesh. name is looked for along RAYPATH, as findFile() has it. Throws Error: Status::system where it
// is not found or cannot be read, Status::input for what is no mesh, or is truncated or damaged, with the
// byte where it was noticed. Warns where there are no triangles, and of unknown types. Memory is in
// proportion to the data (16 bytes a triangle, 12 to 24 a vertex), not to the counts that they announce.
Mesh readMesh(const std::string& name, const Warn& warn = {}, const FileAccess& access = {});

}  // namespace rad
