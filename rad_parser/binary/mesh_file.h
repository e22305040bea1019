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

// A compiled triangle mesh (.rtm), as written by obj2mesh(1). A scene contains it as
//   mod mesh id
//   1+n meshfile transform
//   0
//   0
// meshfile is searched along RAYPATH. The n words of transform are options of xform (readTransform(),
// xform.h). They transform vertices and normals from the mesh's coordinates to those of the scene; mirroring
// does not reverse the triangles. mod is the material of all triangles; if it is void, each triangle has the
// material in the mesh file. The normal of a triangle follows from the order of its vertices, in the mesh's
// coordinates, by the right-hand rule. If all three vertices have normals, the surface is smoothed: its
// normal is interpolated with barycentric weights. (u,v) is interpolated in the same way; it is (0,0) at a
// vertex without texture coordinates. Source: RADIANCE reference manual, "Mesh"; obj2mesh(1).
//
// Coordinates have the precision of the format: 32 bits over the cube or the range of (u,v). Normals are
// stored as codes of 32 bits. This takes at most half the memory of doubles. The corners of `triangles` are
// indices of positions. normals and uvs have the length of positions, or length 0 if no vertex has any.
struct Mesh {
  static constexpr int32_t kNoMaterial = -1;

  struct Triangle {
    std::array<uint32_t, 3> vertices;
    int32_t material;  // index in materials.primitives, or kNoMaterial
  };

  Description materials;  // modifiers, header and cube; places are numbers of primitives
  Imath::V2d uvLow, uvHigh;
  std::vector<std::array<uint32_t, 3>> positions;
  std::vector<uint32_t> normals;
  std::vector<std::array<uint32_t, 2>> uvs;
  std::vector<Triangle> triangles;

  // In the mesh's coordinates. The error of a coordinate from compiling the mesh is at most 2^-33 of the
  // cube's size.
  Imath::V3d position(uint32_t vertex) const;

  // Of unit length. The error from compiling the mesh is at most 0.006 degrees. Empty if the vertex has none.
  std::optional<Imath::V3d> normal(uint32_t vertex) const;

  // u and v. Their errors from compiling the mesh are at most 2^-33 of the range. Empty if the vertex has
  // none.
  std::optional<Imath::V2d> uv(uint32_t vertex) const;
};

// The unit vector represented by a code of 32 bits; zero for the code 0. Bits 0 to 2 are the signs of x, y
// and z. Bits 5 to 17 and 18 to 30 are the two smaller magnitudes of the three, times (2^13-1/2)*sqrt(2). The
// first is the smaller one of x and y (x if bit 3 is set). The second is the smaller one of z and the other
// of x and y (z if bit 4 is set). Source: RADIANCE's encoding in its source file dircode.c; mean error 0.0022
// degrees.
Imath::V3d decodeDirection(uint32_t code);

// Reads a mesh. name is searched along RAYPATH like in findFile(). Throws Error with Status::system if the
// file is not found or cannot be read, and with Status::input if it is not a mesh, or is truncated or
// damaged; the latter errors contain the byte at which they were noticed. Warns of a mesh without triangles
// and of unknown types. Memory is in proportion to the actual data (16 bytes a triangle, 12 to 24 a vertex),
// not to the numbers of elements that the file states.
Mesh readMesh(const std::string& name, const Warn& warn = {}, const FileAccess& access = {});

}  // namespace rad
