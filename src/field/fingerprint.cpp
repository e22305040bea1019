#include "field/fingerprint.h"

#include <cstring>
#include <unordered_set>

#include "base/overloaded.h"
#include "rad_parser/open_file.h"
#include "rad_parser/scene_file.h"

namespace rsphere {

void Fingerprint::add(std::string_view text) {
  add(text.size());
  for (size_t i = 0; i < text.size(); i += 8) {
    uint64_t piece = 0;
    std::memcpy(&piece, text.data() + i, std::min<size_t>(8, text.size() - i));
    add(piece);
  }
}

void addFile(Fingerprint& print, std::string_view name, const rad::FileAccess& access) {
  const auto path = rad::findFile(name, rad::libraryPath(), {}, access);
  const rad::OpenFile file(path.value_or(""));
  // The name may be a folder: "." stands for no function file, and is also a folder on RAYPATH.
  const bool isOpen = file.descriptor() >= 0 && file.isRegular();
  print.add(uint64_t{isOpen});
  if (isOpen) print.add(file.contents(*path));
}

namespace {

void add(Fingerprint& print, const V3d& v) {
  for (int c = 0; c < 3; ++c) print.add(v[c]);
}

void add(Fingerprint& print, const OneOf<double, uint64_t> auto& x) { print.add(x); }
void addAll(Fingerprint& print, const auto&... values) { (add(print, values), ...); }

// Only the defining values of shapes, not those computed from them.
void add(Fingerprint& print, const Polygon& polygon, const Scene& scene) {
  print.add(uint64_t{polygon.vertices});
  for (uint32_t i = 0; i < polygon.vertices; ++i) add(print, scene.vertices[polygon.firstVertex + i]);
}
void add(Fingerprint& print, const Sphere& s, const Scene&) {
  addAll(print, s.center, s.radius, uint64_t{s.inward});
}
void add(Fingerprint& print, const Cone& c, const Scene&) {
  addAll(print, c.base, c.axis, c.length, c.radius0, c.radius1, uint64_t{c.inward});
}
void add(Fingerprint& print, const Ring& r, const Scene&) {
  addAll(print, r.center, r.normal, r.inner, r.outer);
}
void add(Fingerprint& print, const Distant& d, const Scene&) { addAll(print, d.direction, d.halfAngle); }
// Their placements are string arguments in the description.
void add(Fingerprint&, const NestedShape auto&, const Scene&) {}

void add(Fingerprint& print, const rad::Mesh& mesh) {
  for (const auto& vertex : mesh.positions)
    for (const uint32_t x : vertex) print.add(uint64_t{x});
  for (const uint32_t normal : mesh.normals) print.add(uint64_t{normal});
  for (const auto& uv : mesh.uvs)
    for (const uint32_t x : uv) print.add(uint64_t{x});
  for (const auto& triangle : mesh.triangles) {
    for (const uint32_t vertex : triangle.vertices) print.add(uint64_t{vertex});
    print.add(static_cast<uint64_t>(triangle.material));
  }
}

}  // namespace

uint64_t fingerprint(const Scene& scene) {
  Fingerprint print;
  const rad::Description& d = scene.description;
  std::unordered_set<uint64_t> seen;
  for (const rad::Primitive& p : d.primitives) {
    print.add(static_cast<uint64_t>(p.type));
    print.add(uint64_t{static_cast<uint32_t>(p.modifier.number())} << 32 |
              static_cast<uint32_t>(p.aliased.number()));
    print.add(p.name);
    if (!rad::isSurface(p.type))  // the numbers of shapes are added with the surfaces
      for (const double x : d.reals(p)) print.add(x);
    for (size_t i = 0; i < p.strings; ++i) {
      print.add(d.string(p, i));
      // The contents of octrees and meshes are already part of the scene. The same name may be that of
      // another file in another scene file.
      if (rad::isSurface(p.type)) continue;
      if (!seen.insert(uint64_t{p.place.file} << 32 | d.stringArgs[p.firstString + i]).second) continue;
      addFile(print, rad::nameOfFile(d, p.place, d.string(p, i), scene.files), scene.files);
    }
  }
  for (const Surface& s : scene.surfaces) {
    print.add(uint64_t{static_cast<uint32_t>(s.modifier.number())} << 1 | static_cast<uint64_t>(s.goal));
    visit([&](const auto& shape) { add(print, shape, scene); }, s.shape);
  }
  for (const Mesh& mesh : scene.meshes) add(print, mesh.data);
  addFile(print, "rayinit.cal", scene.files);
  return print.value();
}

}  // namespace rsphere
