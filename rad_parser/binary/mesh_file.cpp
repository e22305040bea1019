#include "rad_parser/binary/mesh_file.h"

#include <fmt/format.h>

#include <cmath>

#include "rad_parser/binary/binary_scene.h"
#include "rad_parser/open_file.h"
#include "rad_parser/printable.h"

namespace rad {
namespace {

constexpr int kMeshMagic = 319;  // the format number minus the width of object numbers

// A vertex number consists of the number of its patch, and 8 bits for its number within the patch.
constexpr uint32_t kPatchVertices = 256;
constexpr uint32_t kPatchTriangles = 512, kPatchJoiners = 256;

constexpr double kSteps = 4294967296.;  // 2^32: steps along the cube's edge, and in the ranges of u and v

// Bits of a patch's first byte: the kinds of data of its vertices.
constexpr int kHasPosition = 1, kHasNormal = 2, kHasUv = 4;

class MeshReader {
 public:
  MeshReader(BinaryReader& input, const Warn& warn) : input_(input), warn_(warn) {}

  Mesh read() {
    BinaryReader::Header header = input_.header();
    // As in rtrace, the number after the header decides, even if the header contains a different format.
    const bool named = header.format == "Radiance_tmesh";
    const int width = readIndexWidth(input_, kMeshMagic, named ? "" : header.format);
    const Cube cube = readCube(input_);
    if (cube.size <= 0) throw input_.fault("damaged bounds");
    for (int i = 0; i < 2; ++i) {
      mesh_.uvLow[i] = input_.real();
      mesh_.uvHigh[i] = input_.real();
    }
    passOverCells(input_, width, [](int64_t) {});

    DescriptionBuilder builder;
    const uint32_t file = builder.addFile(input_.name());
    builder.description().files[file].numbered = true;
    readPrimitives(input_, width, file, builder, warn_);
    mesh_.materials = builder.take();
    mesh_.materials.header = std::move(header.lines);
    mesh_.materials.cube = cube;
    for (const Primitive& p : mesh_.materials.primitives)
      if (isSurface(p.type))
        throw Error(mesh_.materials.at(p.place) + ": a surface among a mesh's materials");

    const int64_t patches = input_.integer(4);
    if (patches < 0) throw input_.fault(fmt::format("damaged mesh: {} patches", patches));
    for (int64_t i = 0; i < patches; ++i) patch();
    joinPatches();
    if (mesh_.triangles.empty() && warn_)
      warn_(fmt::format("{}: no triangles in mesh", printable(input_.name(), kLongestName)));
    return std::move(mesh_);
  }

 private:
  void patch() {
    firstVertex_.push_back(static_cast<uint32_t>(mesh_.positions.size()));
    const int has = input_.byte();
    if (!(has & kHasPosition) || (has & ~(kHasPosition | kHasNormal | kHasUv)) != 0)
      throw input_.fault(fmt::format("damaged mesh: a patch with flags {}", has));
    if (has & kHasUv && (mesh_.uvHigh.x <= mesh_.uvLow.x || mesh_.uvHigh.y <= mesh_.uvLow.y))
      throw input_.fault("damaged mesh: (u,v) without a range");
    patchVertices_ = count(kPatchVertices, "vertices");
    if (patchVertices_ == 0) throw input_.fault("damaged mesh: a patch without vertices");
    if (mesh_.positions.size() + patchVertices_ > std::numeric_limits<uint32_t>::max())
      throw input_.fault("too many vertices");
    vertices(has);
    localTriangles();
    for (uint32_t n = count(kPatchJoiners, "joining triangles"); n > 0; --n) joiner(1);
    for (uint32_t n = count(kPatchJoiners, "doubly joining triangles"); n > 0; --n) joiner(2);
  }

  uint32_t count(uint32_t most, std::string_view what) {
    const uint32_t n = input_.count16();
    if (n > most) throw input_.fault(fmt::format("damaged mesh: a patch with {} {}", n, what));
    return n;
  }

  uint32_t word() { return static_cast<uint32_t>(input_.integer(4)); }

  // If a patch has no normals or no (u,v), zeros are stored for its vertices. A zero means that the vertex
  // has none, because neither a normal nor a u has the code 0.
  void vertices(int has) {
    const size_t before = mesh_.positions.size(), after = before + patchVertices_;
    for (uint32_t i = 0; i < patchVertices_; ++i) {
      const uint32_t x = word(), y = word(), z = word();
      mesh_.positions.push_back({x, y, z});
    }
    if (has & kHasNormal) {
      mesh_.normals.resize(before);
      for (uint32_t i = 0; i < patchVertices_; ++i) mesh_.normals.push_back(word());
    } else if (!mesh_.normals.empty()) {
      mesh_.normals.resize(after);
    }
    if (has & kHasUv) {
      mesh_.uvs.resize(before);
      for (uint32_t i = 0; i < patchVertices_; ++i) {
        const uint32_t u = word(), v = word();
        mesh_.uvs.push_back({u, v});
      }
    } else if (!mesh_.uvs.empty()) {
      mesh_.uvs.resize(after);
    }
  }

  uint32_t localVertex() {
    const uint32_t v = input_.byte();
    if (v >= patchVertices_)
      throw input_.fault(fmt::format("damaged mesh: vertex {} of {} in a patch", v + 1, patchVertices_));
    return firstVertex_.back() + v;
  }

  int32_t material() {
    const int64_t m = input_.integer(2);
    const auto materials = static_cast<int64_t>(mesh_.materials.primitives.size());
    if (materials == 0 ? m != Mesh::kNoMaterial : m < 0 || m >= materials)
      throw input_.fault(fmt::format("damaged mesh: material {} of {}", m + 1, materials));
    return static_cast<int32_t>(m);
  }

  // Next is either one material for all triangles, or one for each.
  void localTriangles() {
    const uint32_t n = count(kPatchTriangles, "triangles");
    const size_t first = mesh_.triangles.size();
    for (uint32_t i = 0; i < n; ++i) {
      const uint32_t a = localVertex(), b = localVertex(), c = localVertex();
      mesh_.triangles.push_back({{a, b, c}, Mesh::kNoMaterial});
    }
    if (input_.integer(2) > 1) {
      for (size_t i = first; i < mesh_.triangles.size(); ++i) mesh_.triangles[i].material = material();
    } else if (n > 0) {
      const int32_t sole = material();
      for (size_t i = first; i < mesh_.triangles.size(); ++i) mesh_.triangles[i].material = sole;
    } else {
      input_.integer(2);  // the material of zero triangles
    }
  }

  // A triangle whose first `away` vertices belong to other patches, which may follow later. Their numbers are
  // stored until joinPatches() replaces them by indices.
  void joiner(size_t away) {
    Mesh::Triangle t;
    for (size_t i = 0; i < away; ++i) {
      joints_.push_back({mesh_.triangles.size(), static_cast<uint32_t>(i), input_.offset()});
      t.vertices[i] = word();
    }
    for (size_t i = away; i < 3; ++i) t.vertices[i] = localVertex();
    t.material = material();
    mesh_.triangles.push_back(t);
  }

  void joinPatches() {
    firstVertex_.push_back(static_cast<uint32_t>(mesh_.positions.size()));
    for (const Joint& joint : joints_) {
      uint32_t& vertex = mesh_.triangles[joint.triangle].vertices[joint.corner];
      const uint32_t patch = vertex / kPatchVertices, local = vertex % kPatchVertices;
      if (patch + 1 >= firstVertex_.size() || local >= firstVertex_[patch + 1] - firstVertex_[patch])
        throw Error(fmt::format("{}: damaged mesh: no vertex {} in a patch {} at byte {}",
                                printable(input_.name(), kLongestName), local + 1, patch + 1, joint.offset));
      vertex = firstVertex_[patch] + local;
    }
  }

  struct Joint {
    size_t triangle;
    uint32_t corner;
    uint64_t offset;
  };

  BinaryReader& input_;
  const Warn& warn_;
  Mesh mesh_;
  std::vector<uint32_t> firstVertex_;  // of each patch, as an index of positions
  uint32_t patchVertices_ = 0;         // in the current patch
  std::vector<Joint> joints_;
};

}  // namespace

Imath::V3d decodeDirection(uint32_t code) {
  if (code == 0) return Imath::V3d(0);
  constexpr double kScale = 11584.5;  // (2^13 - 1/2) sqrt 2, rounded as in the format
  constexpr uint32_t kMagnitude = 0x1fff;
  const double first = (code >> 5 & kMagnitude) / kScale, second = (code >> 18 & kMagnitude) / kScale;
  // Both are at most 8191 / 11584.5, so the argument of the root is never negative.
  const double largest = std::sqrt(1 - first * first - second * second);
  const bool firstIsX = code >> 3 & 1, secondIsZ = code >> 4 & 1;
  Imath::V3d d;
  d[firstIsX ? 0 : 1] = first;
  d[firstIsX ? 1 : 0] = secondIsZ ? largest : second;
  d.z = secondIsZ ? second : largest;
  for (int i = 0; i < 3; ++i)
    if (code >> i & 1) d[i] = -d[i];
  return d;
}

Imath::V3d Mesh::position(uint32_t vertex) const {
  const std::array<uint32_t, 3>& p = positions[vertex];
  const Cube& cube = *materials.cube;
  Imath::V3d at;
  for (int i = 0; i < 3; ++i) at[i] = cube.origin[i] + (p[i] + .5) * (cube.size / kSteps);
  return at;
}

std::optional<Imath::V3d> Mesh::normal(uint32_t vertex) const {
  if (normals.empty() || normals[vertex] == 0) return {};
  return decodeDirection(normals[vertex]);
}

std::optional<Imath::V2d> Mesh::uv(uint32_t vertex) const {
  if (uvs.empty() || uvs[vertex][0] == 0) return {};
  const auto at = [&](int i) { return uvLow[i] + (uvHigh[i] - uvLow[i]) * ((uvs[vertex][i] + .5) / kSteps); };
  return Imath::V2d(at(0), at(1));
}

Mesh readMesh(const std::string& name, const Warn& warn, const FileAccess& access) {
  const std::optional<std::string> path = findFile(name, libraryPath(), {}, access);
  if (!path)
    throw Error(fmt::format("{}: cannot find mesh file{}", printableName(name), access.remark(name, true)),
                Status::system);
  const OpenFile file(*path);
  if (file.descriptor() < 0) throw systemError(printableName(*path) + ": cannot open mesh file");
  BinaryReader input(file.descriptor(), *path, "mesh");
  Mesh mesh = MeshReader(input, warn).read();
  file.requireUnchanged(*path);
  return mesh;
}

}  // namespace rad
