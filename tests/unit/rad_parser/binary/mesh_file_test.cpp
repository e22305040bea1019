#include "rad_parser/binary/mesh_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "tests/unit/rad_parser/binary/binary_data.h"
#include "tests/unit/rad_parser/scene_text.h"

namespace {

using Imath::V2d;
using Imath::V3d;
using rad::Mesh;
using rad::Status;

std::string fixture(const std::string& name) { return RSPHERE_TESTS "/scenes/octree/" + name; }

constexpr double kUnit = 1. / 4294967296.;  // step of a coordinate, as a fraction of the cube's size

// A mesh of two patches. The first has three vertices with normals and a triangle; the second has two
// vertices with (u,v), and triangles with one and with two vertices in the first.
struct MeshData {
  std::string header = "#?RADIANCE\nobj2mesh by hand\nFORMAT=Radiance_tmesh\n\n";
  std::string bounds = std::string(
      "0\0"
      "0\0"
      "0\0"
      "4\0",
      8);
  std::string materials = std::string("plastic\0sphere\0\0", 16) + material("m") + '\xff';
  int64_t patches = 2;
  int64_t soleMaterial = 0, joint = 0 << 8 | 2, localVertex = 1;

  static std::string material(std::string_view name) {
    return BinaryData().integer(0, 1).integer(-1, 4).string(name).integer(0, 2).integer(0, 2).bytes;
  }
  std::string bytes() const {
    BinaryData d;
    d.bytes = header;
    d.integer(319 + 4, 2);
    d.bytes += bounds;
    d.real(-1073741823, 1).real(1073741823, 1).real(-1073741823, 1).real(1073741823, 2);
    d.integer(0, 1);
    d.bytes += materials;
    d.integer(patches, 4);
    d.integer(1 | 2, 1).integer(3, 2);
    for (const int64_t x : {0, 0, 0, 1 << 30, 0, 0, 0, 1 << 30, 0}) d.integer(x, 4);
    for (const int64_t n : {0, 0x10, 0x14}) d.integer(n, 4);
    d.integer(1, 2).integer(0, 1).integer(localVertex, 1).integer(2, 1);
    d.integer(1, 2).integer(soleMaterial, 2).integer(0, 2).integer(0, 2);
    d.integer(1 | 4, 1).integer(2, 2);
    for (const int64_t x : {-1, -1, -1, 7, 8, 9}) d.integer(x, 4);
    for (const int64_t x : {0, 5, 0x7fffffff, -1}) d.integer(x, 4);
    d.integer(0, 2).integer(1, 2).integer(77, 2);
    d.integer(1, 2).integer(joint, 4).integer(0, 1).integer(1, 1).integer(0, 2);
    d.integer(1, 2).integer(0, 4).integer(1 << 8, 4).integer(1, 1).integer(0, 2);
    return d.bytes;
  }
};

Mesh readBytes(std::string_view bytes) {
  const TestFolder folder;
  return rad::readMesh(folder.write("t.rtm", bytes));
}
std::string errorOfBytes(std::string_view bytes) {
  const TestFolder folder;
  const std::string path = folder.write("t.rtm", bytes);
  const std::string error = errorOf([&] { rad::readMesh(path); });
  return error.starts_with(path) ? error.substr(path.size() - 5) : error;
}

// The triangles of box.obj in any order, each with its lowest vertex first.
TEST(MeshFile, APyramidOfTwoMaterials) {
  const Mesh mesh = rad::readMesh(fixture("box.rtm"));
  ASSERT_EQ(mesh.materials.primitives.size(), 2u);
  EXPECT_EQ(mesh.materials.primitives.at(0).name, "brick");
  EXPECT_EQ(mesh.materials.at(mesh.materials.primitives.at(1).place), fixture("box.rtm") + ": object 2");
  EXPECT_EQ(mesh.materials.header[1], "obj2mesh -a box.mat box.obj");
  ASSERT_EQ(mesh.triangles.size(), 6u);

  struct Corner {
    V3d at;
    V3d normal{0};
    V2d uv{0};
  };
  struct Facet {
    std::string material;
    std::vector<Corner> corners;
  };
  const V3d v1(0, 0, 0), v2(2, 0, 0), v3(2, 1, 0), v4(0, 1, 0), v5(1, .5, 3);
  const V3d n1(0, 0, 1), n2(0, -1, 0), n3(-.6, 0, .8), n4(.48, .6, -.64);
  const V2d t1(0, 0), t3(1, .5), t2(1, 0), t4(-.25, .5);
  std::vector<Facet> facets = {{"brick", {{v1, n1, t1}, {v4, n2, t4}, {v3, n3, t3}}},
                               {"brick", {{v1, n1, t1}, {v3, n3, t3}, {v2, n4, t2}}},
                               {"tile", {{v1}, {v2}, {v5}}},
                               {"tile", {{v2}, {v3}, {v5}}},
                               {"tile", {{v3}, {v4}, {v5}}},
                               {"tile", {{v4}, {v1}, {v5}}}};
  const double near = mesh.materials.cube->size * kUnit;
  const auto matches = [&](const Facet& facet, const Mesh::Triangle& t, int turned) {
    for (int i = 0; i < 3; ++i)
      if ((mesh.position(t.vertices[(i + turned) % 3]) - facet.corners[i].at).length() > near) return false;
    return true;
  };
  for (const Mesh::Triangle& t : mesh.triangles) {
    bool found = false;
    for (auto facet = facets.begin(); !found && facet != facets.end();)
      for (int turned = 0; turned < 3 && !found; ++turned) {
        if (!matches(*facet, t, turned)) {
          if (turned == 2) {
            ++facet;
            break;
          }
          continue;
        }
        found = true;
        EXPECT_EQ(mesh.materials.primitives.at(t.material).name, facet->material);
        const bool smooth = facet->material == "brick";
        for (int i = 0; i < 3; ++i) {
          const uint32_t v = t.vertices[(i + turned) % 3];
          ASSERT_EQ(mesh.normal(v).has_value(), smooth);
          ASSERT_EQ(mesh.uv(v).has_value(), smooth);
          if (!smooth) continue;
          EXPECT_NEAR(mesh.normal(v)->length(), 1, 1e-15);
          EXPECT_LT((*mesh.normal(v) - facet->corners[i].normal).length(), .006 * M_PI / 180);
          EXPECT_LT((*mesh.uv(v) - facet->corners[i].uv).length(), 2 * kUnit);
        }
        facets.erase(facet);
        break;
      }
    EXPECT_TRUE(found);
  }
  EXPECT_TRUE(facets.empty());
}

// wave.rtm has two patches and triangles that join them. It has 18 x 18 vertices at (i, j, (i j mod 7) / 8)
// with (u,v) = (i, j) / 17, two triangles in each square, and the material brick in every third row:
//   awk 'BEGIN { n = 18
//     for (i = 0; i < n; i++) for (j = 0; j < n; j++)
//       printf "v %d %d %.3f\nvt %g %g\n", i, j, (i*j%7)/8, i/(n-1), j/(n-1)
//     for (i = 0; i+1 < n; i++) { print i%3 ? "usemtl tile" : "usemtl brick"
//       for (j = 0; j+1 < n; j++) { a = i*n+j+1; b = a+n
//         printf "f %d/%d %d/%d %d/%d\nf %d/%d %d/%d %d/%d\n",
//           a,a, b,b, b+1,b+1, a,a, b+1,b+1, a+1,a+1 } } }'
//     > wave.obj; obj2mesh -a box.mat wave.obj > wave.rtm
TEST(MeshFile, PatchesAreJoined) {
  const Mesh mesh = rad::readMesh(fixture("wave.rtm"));
  EXPECT_EQ(mesh.positions.size(), 324u);
  EXPECT_TRUE(mesh.normals.empty());
  ASSERT_EQ(mesh.triangles.size(), 578u);
  const double near = mesh.materials.cube->size * kUnit;
  std::set<std::vector<int>> seen;
  for (const Mesh::Triangle& t : mesh.triangles) {
    std::vector<int> grid;
    for (const uint32_t v : t.vertices) {
      const V3d p = mesh.position(v);
      const int i = static_cast<int>(std::lround(p.x)), j = static_cast<int>(std::lround(p.y));
      EXPECT_LT((p - V3d(i, j, i * j % 7 / 8.)).length(), near);
      EXPECT_LT((*mesh.uv(v) - V2d(i / 17., j / 17.)).length(), 5e-6);  // wave.obj gives six digits
      grid.push_back(i * 18 + j);
    }
    std::rotate(grid.begin(), std::min_element(grid.begin(), grid.end()), grid.end());
    const int a = grid[0], b = a + 18;
    EXPECT_TRUE(grid == std::vector({a, b, b + 1}) || grid == std::vector({a, b + 1, a + 1})) << a;
    EXPECT_TRUE(seen.insert(grid).second);
    EXPECT_EQ(mesh.materials.primitives.at(t.material).name, a / 18 % 3 ? "tile" : "brick");
  }
}

TEST(MeshFile, VerticesWithAndWithoutNormals) {
  const Mesh mesh = readBytes(MeshData().bytes());
  ASSERT_EQ(mesh.positions.size(), 5u);
  ASSERT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(mesh.triangles[0].vertices, (std::array{0u, 1u, 2u}));
  EXPECT_EQ(mesh.triangles[1].vertices, (std::array{2u, 3u, 4u}));
  EXPECT_EQ(mesh.triangles[2].vertices, (std::array{0u, 3u, 4u}));
  EXPECT_EQ(mesh.position(1), V3d(1 + 2 * kUnit, 2 * kUnit, 2 * kUnit));
  EXPECT_EQ(mesh.position(3), V3d(4 - 2 * kUnit));
  EXPECT_FALSE(mesh.normal(0));
  EXPECT_EQ(*mesh.normal(1), V3d(1, 0, 0));
  EXPECT_FALSE(mesh.normal(3));
  EXPECT_FALSE(mesh.uv(1));
  EXPECT_FALSE(mesh.uv(3));
  EXPECT_NEAR(mesh.uv(4)->x, 0, 1e-9);
  EXPECT_NEAR(mesh.uv(4)->y, 2, 1e-9);
}

// Directions on a lattice over the sphere, encoded by the definition, are decoded within the error bound of
// the header. Codes that represent no direction are also decoded to unit vectors.
TEST(MeshFile, DirectionsOfAllOctants) {
  constexpr double kScale = 11584.5;
  constexpr int kDirections = 20000;
  double worst = 0;
  for (int i = 0; i < kDirections; ++i) {
    const double z = 1 - (2 * i + 1.) / kDirections, a = i * 2.399963229728653, r = std::sqrt(1 - z * z);
    const V3d d(r * std::cos(a), r * std::sin(a), z);
    uint32_t c[3], code = 0;
    for (int k = 0; k < 3; ++k) {
      c[k] = static_cast<uint32_t>(std::abs(d[k]) * kScale + .5);
      code |= d[k] < 0 ? 1u << k : 0;
    }
    const bool xFirst = c[0] <= c[1];
    const uint32_t other = std::max(c[0], c[1]);
    code |= xFirst ? 8 | c[0] << 5 : c[1] << 5;
    code |= c[2] <= other ? 16 | c[2] << 18 : other << 18;
    worst = std::max(worst, (rad::decodeDirection(code) - d).length());
  }
  EXPECT_LT(worst, .006 * M_PI / 180);
  EXPECT_GT(worst, .004 * M_PI / 180);
  std::mt19937 random(1);
  for (int i = 0; i < 10000; ++i) {
    const uint32_t code = random();
    EXPECT_NEAR(rad::decodeDirection(code).length(), code ? 1 : 0, 1e-15);
  }
  EXPECT_NEAR(rad::decodeDirection(0xffffffff).length(), 1, 1e-15);
}

TEST(MeshFile, DamagedMeshes) {
  const auto error = [](auto change) {
    MeshData data;
    change(data);
    return errorOfBytes(data.bytes());
  };
  const auto contains = [](const std::string& text, const char* part) {
    return text.find(part) != text.npos;
  };
  EXPECT_EQ(error([](MeshData&) {}), "");
  EXPECT_TRUE(
      contains(error([](MeshData& d) { d.soleMaterial = 1; }), "damaged mesh: material 2 of 1 at byte"));
  EXPECT_TRUE(
      contains(error([](MeshData& d) { d.soleMaterial = -1; }), "damaged mesh: material 0 of 1 at byte"));
  EXPECT_TRUE(contains(error([](MeshData& d) { d.localVertex = 3; }), "vertex 4 of 3 in a patch at byte"));
  EXPECT_TRUE(contains(error([](MeshData& d) { d.joint = 3; }), "no vertex 4 in a patch 1 at byte"));
  EXPECT_TRUE(contains(error([](MeshData& d) { d.joint = 2 << 8; }), "no vertex 1 in a patch 3 at byte"));
  EXPECT_TRUE(contains(error([](MeshData& d) { d.joint = -1; }), "damaged mesh: no vertex 256 in a patch"));
  EXPECT_TRUE(contains(error([](MeshData& d) { d.patches = 3; }), "truncated mesh at byte"));
  EXPECT_TRUE(contains(error([](MeshData& d) { d.patches = 0x7fffffff; }), "truncated mesh at byte"));
  EXPECT_TRUE(contains(error([](MeshData& d) { d.patches = -1; }), "damaged mesh: -1 patches"));
  EXPECT_TRUE(contains(error([](MeshData& d) { d.bounds[6] = '0'; }), "damaged bounds"));
  EXPECT_TRUE(contains(error([](MeshData& d) {
                         d.bounds = std::string(
                             "0\0"
                             "9e307\0"
                             "0\0"
                             "1.7e308\0",
                             18);
                       }),
                       "damaged bounds"));
  EXPECT_TRUE(contains(error([](MeshData& d) { d.materials[d.materials.size() - 12] = 1; }), "mesh"));
  EXPECT_EQ(errorOfBytes("void plastic m"), "t.rtm: not a mesh");
  EXPECT_EQ(errorOfBytes(""), "t.rtm: not a mesh: 0 bytes (did the program that makes it fail?)");
  EXPECT_EQ(errorOfBytes(bytesOf(fixture("frozen.oct"))),
            "t.rtm: not a mesh: its header says FORMAT=Radiance_octree");
  EXPECT_EQ(errorOf([] { rad::readMesh("none.rtm"); }, Status::system),
            "none.rtm: cannot find mesh file" + rad::FileAccess().remark("none.rtm", true));
}

TEST(MeshFile, TheNumberBehindTheHeaderTellsAMesh) {
  for (const char* header : {"obj2mesh\nFORMAT=Radiance_tmesh\n\n", "obj2mesh\n\n", "FORMAT=ascii\n\n"}) {
    MeshData data;
    data.header = header;
    EXPECT_EQ(readBytes(data.bytes()).positions.size(), readBytes(MeshData().bytes()).positions.size())
        << header;
  }
}

TEST(MeshFile, AMeshWithoutMaterialsHasNone) {
  MeshData data;
  data.materials = std::string("plastic\0\0\xff", 10);
  EXPECT_NE(errorOfBytes(data.bytes()), "");
  data.soleMaterial = -1;
  std::string bytes = data.bytes();
  bytes[bytes.size() - 2] = bytes[bytes.size() - 1] = '\xff';    // of the last triangle
  bytes[bytes.size() - 15] = bytes[bytes.size() - 14] = '\xff';  // of the triangle before it
  const Mesh mesh = readBytes(bytes);
  for (const Mesh::Triangle& t : mesh.triangles) EXPECT_EQ(t.material, Mesh::kNoMaterial);
}

TEST(MeshFile, TruncatedAnywhereIsAnError) {
  const TestFolder folder;
  const std::string wave = bytesOf(fixture("wave.rtm"));
  for (const std::string& whole : {bytesOf(fixture("box.rtm")), MeshData().bytes(), wave}) {
    const size_t header = whole.find("\n\n") + 2;
    for (size_t length = 0; length < whole.size(); length += whole.size() == wave.size() ? 61 : 1) {
      const std::string path = folder.write("t.rtm", whole.substr(0, length));
      const std::string error = errorOf([&] { rad::readMesh(path); });
      ASSERT_NE(error, "") << length;
      if (length >= header) {
        EXPECT_EQ(error, fmt::format("{}: truncated mesh at byte {}", path, length));
      }
    }
  }
}

TEST(MeshFile, FlippedBytesAreReadOrRefused) {
  const TestFolder folder;
  std::mt19937_64 random(6);
  int refused = 0;
  for (const std::string& whole : {bytesOf(fixture("box.rtm")), MeshData().bytes()}) {
    for (int trial = 0; trial < 3000; ++trial) {
      std::string bytes = whole;
      for (int k = static_cast<int>(random() % 3); k >= 0; --k)
        bytes[random() % bytes.size()] = static_cast<char>(random());
      const std::string path = folder.write("t.rtm", bytes);
      try {
        const Mesh mesh = rad::readMesh(path);
        for (const Mesh::Triangle& t : mesh.triangles) {
          for (const uint32_t v : t.vertices) ASSERT_LT(v, mesh.positions.size());
          ASSERT_LT(t.material, static_cast<int32_t>(mesh.materials.primitives.size()));
        }
        ASSERT_TRUE(mesh.normals.empty() || mesh.normals.size() == mesh.positions.size());
        ASSERT_TRUE(mesh.uvs.empty() || mesh.uvs.size() == mesh.positions.size());
      } catch (const rad::Error& error) {
        ++refused;
        EXPECT_NE(std::string(error.what()).find("t.rtm"), std::string::npos) << error.what();
      }
    }
  }
  EXPECT_GT(refused, 1000);
}

}  // namespace
