#include "rays/presumed_shadows.h"

#include <algorithm>
#include <cmath>

namespace rsphere {
namespace {

constexpr int kShadowCells = 20;  // cells along a side; twice this for distant sources; as in RADIANCE

// Divides the range from -1 to 1 into `count` cells. Returns the middle of the cell that contains x.
double middle(double x, int count) {
  const double cell = std::clamp(std::floor((x + 1) * count / 2), 0., count - 1.);
  return 2 * (cell + .5) / count - 1;
}

int largestAxis(const V3d& v) {
  int axis = 2;  // the last axis if two are equal
  for (int i = 1; i >= 0; --i)
    if (std::abs(v[i]) > std::abs(v[axis])) axis = i;
  return axis;
}

}  // namespace

PresumedShadows::PresumedShadows(const Scene& scene, const Tracer& tracer, const LightSources& lights)
    : scene_(scene), tracer_(tracer), lights_(lights) {
  if (const auto& cube = scene.description.cube) {
    corner_ = V3d(cube->origin[0], cube->origin[1], cube->origin[2]);
    size_ = cube->size;
  } else if (const Box3d& box = tracer.bounds(); !box.isEmpty()) {
    const V3d extent = box.size();
    size_ = std::max({extent.x, extent.y, extent.z});
    corner_ = box.center() - V3d(size_ / 2);
  }
}

bool PresumedShadows::isOpaque(const Hit& hit) const {
  if (hit.path.count > 0 || hit.surface.index() >= scene_.outermost().size()) return false;
  const Surface& surface = scene_.surfaces[hit.surface];
  const Material* material = scene_.materialOf(surface);
  // Mirrors and prisms also block shadow rays, but rtrace does not use them here.
  return isPlain(surface.shape) && material && imagesMadeBy(*material) == 0 &&
         tracer_.stopsShadows(hit.surface, hit.cosine > 0);
}

// Sets the line from a source through the middle of a shadow ray's cell; false if the ray has no cell.
bool PresumedShadows::middleOfCell(const LightSource& light, const V3d& point, const V3d& direction,
                                   V3d& origin, V3d& onward) const {
  if (light.isDistant()) {
    // The grid lies in the plane of the cube's face that faces the source most. It extends beyond that face,
    // so that every ray from the cube to the source crosses it.
    const V3d& to = light.center;
    const int axis = largestAxis(to), a = (axis + 1) % 3, b = (axis + 2) % 3;
    const double along = std::abs(to[axis]);
    origin = corner_;
    if (to[axis] > 0) origin[axis] += size_;
    const double t = (origin[axis] - point[axis]) / to[axis];
    if (!(t > scene_.samePlace)) return false;
    for (const int i : {a, b}) {
      const double slope = to[i] / along, width = size_ * (1 + std::abs(slope)) / (2 * kShadowCells);
      const double low = corner_[i] + std::min(0., size_ * slope);
      const double cell = std::floor((point[i] + t * to[i] - low) / width);
      if (cell < 0 || cell >= 2 * kShadowCells) return false;
      origin[i] = low + (cell + .5) * width;
    }
    onward = -to;
    return true;
  }
  // A face of a cube of directions, which is aligned with the source if that is plane.
  V3d axes[3] = {V3d(1, 0, 0), V3d(0, 1, 0), V3d(0, 0, 1)};
  static_assert(kLightForms == 8, "Which axes has its cube of directions?");
  const auto* plane = light.as<PlaneLight>();
  if (plane) {
    axes[2] = plane->normal;
    axes[0] = plane->u.normalized();
    axes[1] = axes[2].cross(axes[0]);
  }
  const V3d from(-direction.dot(axes[0]), -direction.dot(axes[1]), -direction.dot(axes[2]));
  const int axis = largestAxis(from);
  onward = V3d(0, 0, 0);
  for (int i = 0; i < 3; ++i)
    onward +=
        (i == axis ? std::copysign(1., from[i]) : middle(from[i] / std::abs(from[axis]), kShadowCells)) *
        axes[i];
  onward.normalize();
  // The line starts just in front of the source, because the source's center may lie inside it.
  constexpr double kBefore = .01;
  origin = light.center + light.radius * (plane ? kBefore * plane->normal : (1 + 5 * kBefore) * onward);
  return true;
}

bool PresumedShadows::hide(LightId source, const V3d& point, const V3d& direction, double distance) const {
  const LightSource& light = lights_.all()[source];
  if (light.isVirtual() || light.reach > 0 || light.spot) return false;
  V3d origin, onward;
  if (!(size_ > 0) || !middleOfCell(light, point, direction, origin, onward)) return false;
  Hit first;
  for (double passed = 0;;) {
    first = tracer_.nearest(origin + passed * onward, onward);
    if (first.surface == kNone) return false;
    if (first.surface != light.surface && isOpaque(first)) {
      // For a distant source, the line starts on a face of the scene's cube (middleOfCell()). rtrace misses
      // surfaces this near to that face, because it searches on the other side of the face.
      constexpr double kLost = 1;  // world units
      if (light.isDistant() && passed + first.distance <= kLost) return false;
      break;
    }
    passed += first.distance + 10 * scene_.samePlace;
  }
  ShapeHit hit;
  return intersect(scene_.surfaces[first.surface].shape, scene_.vertices, point, direction, distance, hit,
                   scene_.samePlace);
}

}  // namespace rsphere
