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
  ModifierId modifier;     // the modifier in Scene::modifiers
  ModifierId material;     // the first material of the chain that starts with `modifier`; if there is none,
                           // the mixture that ends it. It decides between coincident surfaces, and which
                           // surfaces are light sources
  uint64_t clip = 0;       // the modifier's bit in Antimatter::clips; 0: no antimatter clips it
  bool goal = false;       // its surfaces emit importance from their fronts, in addition to their material
  Radiance importance{1};  // emitted by its goals
  bool sensor = false;     // its surface belongs to a sensor: only rays aimed at it hit it (sensors.h)
  // Whether the modifier is called "Phong", the customary name of textures that smooth a surface by
  // interpolating normals. As in rtrace, such a texture does not deflect rays that pass straight through a
  // thin surface (trans, glass and the like), but dielectric and interface refract by the perturbed normal.
  bool smoothed = false;
  std::string name = "void";  // of the modifier
};

// A polygon and the index of its finish. For other shapes the polygon has no area, and firstVertex is the
// index among the shapes that are not polygons.
struct Face : Polygon {
  uint32_t finish = 0;
};
static_assert(sizeof(Face) == 48, "takes the padding of Polygon");

// A surface, put together from the list. It refers to the list, which must outlive it unchanged.
struct Surface {
  SurfaceId id;
  ShapeRef shape;
  const Finish& finish;
  ModifierId modifier, material;
  uint64_t clip;
  bool goal, smoothed;
};

// The surfaces of a scene: 48 bytes each, plus 88 if it is not a polygon.
class SurfaceList {
 public:
  class Iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = Surface;
    using difference_type = std::ptrdiff_t;
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

  // The primitive in Scene::description with the surface's name and place in its file. The time is
  // logarithmic in the number of runs of consecutive surfaces.
  PrimitiveId primitiveOf(SurfaceId id) const;

  // By index (Face).
  const std::vector<Finish>& finishes() const { return finishes_; }
  std::vector<Finish>& finishes() { return finishes_; }

  // Appends a surface. A surface whose primitive follows that of the previous one needs no memory for its
  // primitive.
  void push_back(const Shape& shape, uint32_t finish, PrimitiveId primitive);
  void reserve(size_t more);

 private:
  // Surfaces starting with `surface`, whose primitives are consecutive.
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
