#include "area.h"

#include <Imath/ImathBox.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "rad_parser/error.h"
#include "rad_parser/nearest_name.h"
#include "rad_parser/printable.h"
#include "scene/shape.h"

namespace grid {
namespace {

using rad::Description;
using rad::Primitive;

double distance(const V2d& p, const Edge& edge) {
  const V2d along = edge.to - edge.from;
  const double t = std::clamp((p - edge.from).dot(along) / along.dot(along), 0., 1.);
  return (p - edge.from - along * t).length();
}

double sizeOf(const std::vector<Ring>& rings) {
  Imath::Box2d box;
  for (const Ring& ring : rings)
    for (const V2d& p : ring) box.extendBy(p);
  return box.size().length();
}

// The edges of the rings, cut where a vertex lies on them; each place is covered once.
std::vector<Edge> piecesOf(const std::vector<Ring>& rings, double samePlace) {
  std::vector<V2d> vertices;
  // By x, so that the corners of circles and coast lines, tens of thousands, are not all compared.
  std::multimap<double, size_t> alongX;
  const auto visit = [&](const V2d& from, const V2d& to, const auto& use) {
    const auto [low, high] = std::minmax({from.x, to.x});
    const auto end = alongX.upper_bound(high + 2 * samePlace);
    for (auto at = alongX.lower_bound(low - 2 * samePlace); at != end; ++at) use(at->second);
  };
  const auto indexOf = [&](const V2d& p) {
    size_t first = vertices.size();
    visit(p, p, [&](size_t v) {
      if ((p - vertices[v]).length() <= samePlace) first = std::min(first, v);
    });
    if (first < vertices.size()) return first;
    alongX.emplace(p.x, first);
    vertices.push_back(p);
    return first;
  };
  std::vector<std::pair<size_t, size_t>> edges;
  for (const Ring& ring : rings)
    for (size_t i = 0, k = ring.size() - 1; i < ring.size(); k = i++) {
      const size_t from = indexOf(ring[k]), to = indexOf(ring[i]);
      if (from != to) edges.emplace_back(from, to);
    }

  std::set<std::pair<size_t, size_t>> pieces;
  for (const auto& [from, to] : edges) {
    const V2d along = vertices[to] - vertices[from];
    std::vector<std::pair<double, size_t>> cuts;
    visit(vertices[from], vertices[to], [&](size_t v) {
      if (v == from || v == to || distance(vertices[v], {vertices[from], vertices[to]}) <= samePlace)
        cuts.emplace_back((vertices[v] - vertices[from]).dot(along), v);
    });
    std::sort(cuts.begin(), cuts.end());
    for (size_t i = 1; i < cuts.size(); ++i) pieces.insert(std::minmax(cuts[i - 1].second, cuts[i].second));
  }
  std::vector<Edge> answer;
  for (const auto& [from, to] : pieces) answer.push_back({vertices[from], vertices[to]});
  return answer;
}

std::vector<V3d> verticesOf(const Description& scene, const Primitive& p) {
  const std::span<const double> reals = scene.reals(p);
  if (reals.size() < 9 || reals.size() % 3)
    throw rad::Error(fmt::format("{}: a polygon needs at least 9 coordinates in threes", scene.at(p.place)));
  std::vector<V3d> vertices;
  for (size_t i = 0; i < reals.size(); i += 3) vertices.emplace_back(reals[i], reals[i + 1], reals[i + 2]);
  return vertices;
}

rsphere::Polygon faceOf(const std::vector<V3d>& vertices) {
  return rsphere::makePolygon(vertices, 0, static_cast<uint32_t>(vertices.size()));
}

bool hasModifier(const Description& scene, const Primitive& p, std::string_view name) {
  if (p.modifier == rad::PrimitiveId(rad::kVoid)) return false;
  const Primitive modifier = scene.primitives[p.modifier];
  return modifier.name == name ||
         (modifier.type == rad::Type::alias && scene.primitives[modifier.aliased].name == name);
}

// Up to five names of polygons and of their modifiers that resemble this one; if none does, the horizontal
// polygons that are largest.
std::string namesLike(const Description& scene, std::string_view wanted) {
  std::set<std::pair<double, std::string>> near, largest;
  const auto consider = [&](const std::string& name) {
    const size_t changes = rad::editDistance(wanted, name);
    const bool part = name.find(wanted) != name.npos || (name.size() > 2 && wanted.find(name) != wanted.npos);
    if (part || changes <= 1 + wanted.size() / 4)
      near.emplace(part ? .5 : static_cast<double>(changes), name);
  };
  for (const Primitive& p : scene.primitives) {
    if (p.type != rad::Type::polygon) continue;
    consider(p.name);
    if (p.modifier != rad::PrimitiveId(rad::kVoid)) consider(scene.primitives[p.modifier].name);
    const std::vector<V3d> vertices = verticesOf(scene, p);
    const rsphere::Polygon face = faceOf(vertices);
    const double area = areaOf(face, vertices);
    if (area > 0 && std::abs(face.normal.z) > .9999) largest.emplace(-area, p.name);
  }
  const auto& chosen = near.empty() ? largest : near;
  if (chosen.empty()) return "the scene has no horizontal polygon";
  std::vector<std::string> words;
  for (const auto& [rank, name] : chosen)
    if (const std::string word = rad::printable(name);
        std::find(words.begin(), words.end(), word) == words.end())
      if (words.push_back(word); words.size() == 5) break;
  return fmt::format("{}: {}", near.empty() ? "the largest horizontal polygons are" : "similar names are",
                     fmt::join(words, ", "));
}

std::vector<Primitive> polygonsNamed(const Description& scene, const std::string& name) {
  std::vector<Primitive> named, modified;
  std::optional<rad::Type> other;
  for (const Primitive& p : scene.primitives) {
    if (p.type == rad::Type::polygon) {
      if (p.name == name) named.push_back(p);
      if (hasModifier(scene, p, name)) modified.push_back(p);
    } else if (rad::isSurface(p.type) && p.name == name) {
      other = p.type;
    }
  }
  if (!named.empty()) return named;
  if (!modified.empty()) return modified;
  if (other)
    throw rad::Error(fmt::format("\"{}\" is a {}; only polygons can have a grid", rad::printable(name),
                                 rad::typeName(*other)));
  throw rad::Error(fmt::format("no polygon and no modifier of a polygon is named \"{}\"; {}",
                               rad::printable(name), namesLike(scene, name)));
}

std::string quoted(std::span<const std::string> names) {
  std::string answer;
  for (const std::string& name : names)
    answer += fmt::format("{}\"{}\"", answer.empty() ? "" : ", ", rad::printable(name));
  return answer;
}

Plane planeOf(const rsphere::Polygon& face) {
  Plane plane;
  plane.normal = face.normal;
  if (plane.horizontal()) {
    plane.origin = V3d(0, 0, face.offset / face.normal.z);
    plane.right = (V3d(1, 0, 0) - face.normal * face.normal.x).normalized();
    plane.up = face.normal.cross(plane.right) * (face.normal.z > 0 ? 1 : -1);
  } else {
    plane.origin = face.normal * face.offset;
    plane.right = V3d(0, 0, 1).cross(face.normal).normalized();
    plane.up = face.normal.cross(plane.right);
  }
  return plane;
}

bool facesUp(const Description& scene, const Primitive& p) {
  return faceOf(verticesOf(scene, p)).normal.z > .99999;
}

// Polygons in one plane, of those that are not.
std::string howToChoose(size_t up, size_t all) {
  if (up > 0 && up < all)
    return up == 1 ? "-u takes the one that faces up" : fmt::format("-u takes the {} that face up", up);
  return "name those of one plane, each by -s";
}

}  // namespace

V3d Plane::at(const V2d& p, double height) const { return origin + right * p.x + up * p.y + normal * height; }

V2d Plane::project(const V3d& p) const { return {(p - origin).dot(right), (p - origin).dot(up)}; }

// A slope of less than a quarter of a degree is drainage or rounding.
bool Plane::horizontal() const { return std::abs(normal.z) > .99999; }

Area::Area(const Plane& plane, const std::vector<Ring>& rings) : plane_(plane) {
  for (const Ring& ring : rings) rings_.emplace_back(ring);
  const double size = sizeOf(rings);
  // An edge is part of the boundary if the area lies on one of its sides only.
  for (const Edge& piece : piecesOf(rings, 1e-6 * size)) {
    const V2d along = piece.to - piece.from, middle = (piece.from + piece.to) / 2;
    const V2d left = V2d(-along.y, along.x).normalized() * (1e-5 * size);
    const bool onLeft = contains(middle + left), onRight = contains(middle - left);
    if (onLeft && !onRight) edges_.push_back(piece);
    if (onRight && !onLeft) edges_.push_back({piece.to, piece.from});
  }
}

bool Area::contains(const V2d& p) const {
  return std::any_of(rings_.begin(), rings_.end(), [&](const Rows& rows) { return rows.contain(p); });
}

Area::Rows::Rows(const Ring& ring)
    : rows_(static_cast<size_t>(std::sqrt(static_cast<double>(ring.size()))) + 1) {
  double high = -low_;
  for (const V2d& p : ring) {
    low_ = std::min(low_, p.y);
    high = std::max(high, p.y);
  }
  step_ = (high - low_) / static_cast<double>(rows_.size());
  for (size_t i = 0, k = ring.size() - 1; i < ring.size(); k = i++) {
    const V2d &a = ring[i], &b = ring[k];
    if (a.y == b.y) continue;  // never crossed
    for (size_t row = rowAt(std::min(a.y, b.y)); row <= rowAt(std::max(a.y, b.y)); ++row)
      rows_[row].push_back({a, b});
  }
}

size_t Area::Rows::rowAt(double y) const {
  return step_ > 0
             ? static_cast<size_t>(std::clamp((y - low_) / step_, 0., static_cast<double>(rows_.size() - 1)))
             : 0;
}

bool Area::Rows::contain(const V2d& p) const {
  bool odd = false;
  for (const auto& [a, b] : rows_[rowAt(p.y)])
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) odd = !odd;
  return odd;
}

double Area::distanceToEdge(const V2d& p) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Edge& edge : edges_) nearest = std::min(nearest, distance(p, edge));
  return nearest;
}

Area findArea(const Description& scene, std::span<const std::string> names, bool reversed, bool upOnly) {
  std::vector<Primitive> polygons;
  size_t up = 0;
  for (const std::string& name : names)
    for (Primitive& p : polygonsNamed(scene, name)) {
      const bool isUp = facesUp(scene, p);
      up += isUp ? 1 : 0;
      if (isUp || !upOnly) polygons.push_back(std::move(p));
    }
  if (polygons.empty()) throw rad::Error(fmt::format("no polygon of {} faces up (-u)", quoted(names)));

  // The largest polygon decides which side is the front.
  std::vector<std::vector<V3d>> vertices;
  std::optional<size_t> largest;
  double area = 0;
  for (const Primitive& p : polygons) {
    vertices.push_back(verticesOf(scene, p));
    const double here = areaOf(faceOf(vertices.back()), vertices.back());
    if (!largest || here > area) area = here, largest = vertices.size() - 1;
  }
  if (!(area > 0)) throw rad::Error(fmt::format("polygon \"{}\" has no area", rad::printable(names[0])));

  const rsphere::Polygon face = faceOf(vertices[*largest]);
  Plane plane = planeOf(face);
  const double tolerance = std::max(1e-4 * std::sqrt(area), thicknessOf(face, vertices[*largest]) * 1.01);
  std::vector<Ring> rings;
  for (size_t i = 0; i < polygons.size(); ++i) {
    Ring& ring = rings.emplace_back();
    for (const V3d& p : vertices[i]) {
      if (std::abs(face.normal.dot(p) - face.offset) > tolerance)
        throw rad::Error(
            fmt::format("the {} polygons of {} are not all in one plane, \"{}\" and \"{}\" for instance; {}",
                        polygons.size(), quoted(names), rad::printable(polygons[*largest].name),
                        rad::printable(polygons[i].name), howToChoose(up, polygons.size())));
      ring.push_back(plane.project(p));
    }
  }
  if (!plane.horizontal()) {
    V2d corner = rings[0][0];
    for (const Ring& ring : rings)
      for (const V2d& p : ring) corner = V2d(std::min(corner.x, p.x), std::min(corner.y, p.y));
    for (Ring& ring : rings)
      for (V2d& p : ring) p -= corner;
    plane.origin = plane.at(corner);
  }
  if (reversed) plane.normal = V3d(0, 0, 0) - plane.normal;  // without negative zeros
  return Area(plane, rings);
}

std::vector<Ring> findOutlines(const Description& scene, std::span<const std::string> names,
                               const Plane& plane) {
  std::vector<Ring> outlines;
  for (const std::string& name : names)
    for (const Primitive& p : polygonsNamed(scene, name)) {
      Ring& ring = outlines.emplace_back();
      for (const V3d& vertex : verticesOf(scene, p)) ring.push_back(plane.project(vertex));
    }
  return outlines;
}

std::vector<PolygonCorners> allPolygons(const Description& scene) {
  std::vector<PolygonCorners> polygons;
  for (const Primitive& p : scene.primitives) {
    if (p.type != rad::Type::polygon) continue;
    const bool none = p.modifier == rad::PrimitiveId(rad::kVoid);
    polygons.push_back({rad::printable(p.name),
                        none ? "void" : rad::printable(scene.primitives[p.modifier].name),
                        verticesOf(scene, p)});
  }
  return polygons;
}

}  // namespace grid
