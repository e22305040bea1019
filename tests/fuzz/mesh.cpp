// Reads meshes of any bytes; see octree.cpp.
#include <cmath>
#include <cstdlib>

#include "memory_file.h"
#include "rad_parser/binary/mesh_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const MemoryFile file(data, size);
  try {
    const rad::Mesh mesh = rad::readMesh(file.path());
    for (const rad::Mesh::Triangle& t : mesh.triangles) {
      if (t.material >= static_cast<int32_t>(mesh.materials.primitives.size())) std::abort();
      for (const uint32_t v : t.vertices) {
        const Imath::V3d at = mesh.position(v);
        if (!std::isfinite(at.x) || !std::isfinite(at.y) || !std::isfinite(at.z)) std::abort();
        if (const auto n = mesh.normal(v); n && std::abs(n->length() - 1) > 1e-9) std::abort();
        if (const auto uv = mesh.uv(v); uv && !std::isfinite(uv->x + uv->y)) std::abort();
      }
    }
  } catch (const rad::Error&) {
  }
  return 0;
}
