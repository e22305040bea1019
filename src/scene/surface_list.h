#pragma once
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <vector>

#include "base/radiometry.h"
#include "scene/ids.h"
#include "scene/shape.h"

namespace rsphere {

// Properties that all surfaces with the same modifier share.
struct Finish {
  PrimitiveId described;   // the modifier in Scene::description; kNone: void
  ModifierId modifier;     // the same in Scene::modifiers
  ModifierId material;     // the first material of the chain that modifier begins, or else the mixture that
                           // ends it. Decides ties between surfaces, and which are light sources
  uint64_t clip = 0;       // the bit of its modifier in Antimatter::clips; 0: not clipped by any
  bool goal = false;       // its surfaces emit importance from their fronts, in addition to their material
  Radiance importance{1};  // that its goals emit
  bool sensor = false;     // its surface is the goal of a sensor, which only aimed rays meet (sensors.h)
  // Whether its modifier is called "Phong", the customary name of textures that smooth a surface by
  // interpolated normals. As in rtrace, such a texture does not deflect rays that pass straight through a
  // thin surface (trans, glass and the like). Refraction by dielectric and interface follows the perturbed
  // normal even so.
  bool smoothed = false;
  std::string name = "void";  // of the modifier
};

// A polygon and the number of its finish. For another shape the polygon has no area, and firstVertex is the
// shape's index among the shapes that are not polygons.
struct Face : Polygon {
  uint32_t finish = 0;
};
static_assert(sizeof(Face) == 48, "takes the padding of Polygon");

// A surface as the list shows it: it refers to the list, which must outlive it unchanged.
struct Surface {
  SurfaceId id;
  ShapeRef shape;
  const Finish& finish;
  ModifierId modifier, material;
  uint64_t clip;
  bool goal, smoothed;
};

// The surfaces of a scene: 48 bytes each, and for shapes other than polygons 88 more.
class SurfaceList {
 public:
  class Iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = Surface;
    using difference_type = std::ptrdiff_t;
    using pointer = void;
    using reference = Surface;

    Iterator(const SurfaceList& list, size_t at) : list_(&list), at_(at) {}
    Surface operator*() const { return (*list_)[SurfaceId(at_)]; }
    Iterator& operator++() {
      ++at_;
      return *this;
    }
    bool operator==(const Iterator& other) const { return at_ == other.at_; }

   private:
    const SurfaceList* list_;
    size_t at_;
  };
  // The first surfaces.
  struct Beginning {
    const SurfaceList& list;
    size_t count;
    size_t size() const { return count; }
    Iterator begin() const { return {list, 0}; }
    Iterator end() const { return {list, count}; }
  };

  size_t size() const { return faces_.size(); }
  bool empty() const { return faces_.empty(); }
  IdRange<SurfaceId> ids() const { return {0, size()}; }
  // REQUIRES: not empty.
  SurfaceId last() const { return SurfaceId(size() - 1); }
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, size()}; }
  Beginning first(size_t count) const { return {*this, count}; }

  Surface operator[](SurfaceId id) const {
    const Face& face = faces_[id.index()];
    const Finish& finish = finishes_[face.finish];
    const bool goal = finish.goal && !shapeOf(face).as<Distant>();
    return {id, shapeOf(face), finish, finish.modifier, finish.material, finish.clip, goal, finish.smoothed};
  }
  Surface at(size_t i) const { return (*this)[SurfaceId(i)]; }
  const Face& face(SurfaceId id) const { return faces_[id.index()]; }
  ShapeRef shapeOf(const Face& face) const {
    return face.hasArea ? ShapeRef(static_cast<const Polygon&>(face)) : ShapeRef(others_[face.firstVertex]);
  }

  // The primitive in Scene::description that has the surface's name and place. Takes time logarithmic in the
  // number of runs of consecutive surfaces.
  PrimitiveId primitiveOf(SurfaceId id) const;

  // By number.
  const std::vector<Finish>& finishes() const { return finishes_; }
  std::vector<Finish>& finishes() { return finishes_; }

  // Appends a surface. For surfaces of consecutive primitives, the numbers of the primitives take no memory.
  void push_back(const Shape& shape, uint32_t finish, PrimitiveId primitive);
  void reserve(size_t more);

 private:
  // Surfaces from `surface` on, whose primitives are consecutive.
  struct Run {
    SurfaceId surface;
    PrimitiveId primitive;
  };

  std::vector<Face> faces_;
  std::vector<Shape> others_;
  std::vector<Finish> finishes_;
  std::vector<Run> runs_;
};

}  // namespace rsphere
