#pragma once
// The hit of a ray, as seen by materials. Values that most hits do not need are computed only when a material
// requests them.
#include "scene/scene.h"
#include "shade/scattering.h"
#include "shade/surface_functions.h"

namespace rsphere {

// The options that affect materials; see rtrace(1).
struct MaterialOptions {
  bool backFacesVisible = true;    // -bv
  bool sourcesVisible = true;      // -dv
  double specularThreshold = .15;  // -st
  double specularSampling = 1;     // -ss
  double directJitter = 0;         // -dj
  bool basicRadiance = false;      // radiance over n^2 is transported; see scatter(const Dielectric&, ...)
  Medium medium{};                 // of the space outside mist and dielectrics (-me -ma -mg)
};

// How a ray arrived at a surface.
struct Arrival {
  unsigned kinds = kPrimary;  // of the ray and its ancestors
  double cosine = 1;          // -normal . direction; negative from behind
  double length = 0;          // of the ray (world units)
  double pathLength = 0;      // of its ancestors
  SurfaceId surface = kNone;  // the surface that was hit
  // For a shadow ray: the surface of the light source at which it is aimed, or kNone. atImage: the source is
  // virtual, and `target` is the mirror or prism that forms its image. image: number of the image in a prism.
  SurfaceId target = kNone;
  bool atImage = false;
  int image = 0;

  bool isShadow() const { return kinds & kShadow; }
  bool isAimed() const { return target != kNone; }
  bool isAimedHere() const { return isAimed() && target == surface; }
};

// What materials need in addition to the hit. scratch: memory of one thread.
struct MaterialContext {
  const Scene& scene;
  const SurfaceFunctions& functions;
  MaterialOptions options;
  FunctionScratch scratch{};
};

class MaterialHit {
 public:
  // Keeps a reference to the context. modifiers: the modifiers of the material.
  MaterialHit(const Arrival& arrival, ModifierId modifiers, MaterialContext& context)
      : arrival_(arrival), context_(context), modifiers_(modifiers) {}

  const Arrival& arrival() const { return arrival_; }
  const Scene& scene() const { return context_.scene; }
  const MaterialOptions& options() const { return context_.options; }
  const SurfaceFunctions& functions() const { return context_.functions; }
  FunctionScratch& scratch() const { return context_.scratch; }

  ModifierId modifiers() const { return modifiers_; }
  // Whether the ray passes through, because it hit an invisible back face (-bv-).
  bool passesBack() const { return arrival_.cosine < 0 && !options().backFacesVisible; }

  // Applies the modifiers of the material, so that interaction() contains their patterns and textures. Throws
  // rad::Error if one of them is a material.
  void modify() {
    if (modifiers_ != kNone) applyModifiers();
  }
  // Turns a hit from behind into a hit from the front, including point() and the tracer's record of the hit.
  void turnRound() {
    if (arrival_.cosine < 0) turnToFront();
  }
  virtual Interaction interaction() const = 0;
  // The factor of all patterns applied.
  virtual const Color& pattern() const = 0;
  // The hit with the patterns and textures of a chain of modifiers (kNone: an empty chain), in addition to
  // those applied by modify(). Does not change the hit itself.
  virtual Interaction interactionAfter(ModifierId modifiers) const = 0;
  virtual FunctionPoint point() const = 0;
  // The medium that the ray travels through.
  virtual const Medium& medium() const = 0;
  // The direction (unit) to the light source at whose image the ray is aimed. REQUIRES Arrival::atImage.
  virtual V3d towardsSource() const = 0;
  // The number of samples for this ray, if `wanted` is the number for a ray of weight 1.
  virtual int samplesOf(double wanted) const = 0;

 protected:
  ~MaterialHit() = default;

 private:
  virtual void applyModifiers() = 0;
  virtual void turnToFront() = 0;

  Arrival arrival_;
  MaterialContext& context_;
  ModifierId modifiers_;
};

}  // namespace rsphere
