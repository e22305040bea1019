#pragma once
// The hit of a ray as materials see it. Some values are stored; others are computed only when a material asks
// for them, because most hits need few of these.
#include "scene/scene.h"
#include "shade/scattering.h"
#include "shade/surface_functions.h"

namespace rsphere {

// The options that materials depend on; see rtrace(1).
struct MaterialOptions {
  bool backFacesVisible = true;    // -bv
  bool sourcesVisible = true;      // -dv
  double specularThreshold = .15;  // -st
  double specularSampling = 1;     // -ss
  double directJitter = 0;         // -dj
  bool basicRadiance = false;      // radiance over n^2 is transported; see scatter(const Dielectric&, ...)
  Medium medium{};                 // of the space outside of mist and dielectrics (-me -ma -mg)
};

// How a ray arrived at a surface.
struct Arrival {
  unsigned kinds = kPrimary;  // of the ray and its ancestors
  double cosine = 1;          // -normal . direction; negative from behind
  double length = 0;          // of the ray (world units)
  double pathLength = 0;      // of its ancestors
  SurfaceId surface = kNone;  // that it hit
  // Of a shadow ray: the surface of the light source that it is aimed at, or kNone. atImage: that source is
  // virtual, and target is the surface of the mirror or prism that produces the image. image: which of a
  // prism's images.
  SurfaceId target = kNone;
  bool atImage = false;
  int image = 0;

  bool isShadow() const { return kinds & kShadow; }
  bool isAimed() const { return target != kNone; }
  bool isAimedHere() const { return isAimed() && target == surface; }
};

// What materials need besides the hit. scratch: belongs to one thread.
struct MaterialContext {
  const Scene& scene;
  const SurfaceFunctions& functions;
  MaterialOptions options;
  FunctionScratch scratch{};
};

class MaterialHit {
 public:
  // Keeps a reference to the context. modifiers: the material's own.
  MaterialHit(const Arrival& arrival, ModifierId modifiers, MaterialContext& context)
      : arrival_(arrival), context_(context), modifiers_(modifiers) {}

  const Arrival& arrival() const { return arrival_; }
  const Scene& scene() const { return context_.scene; }
  const MaterialOptions& options() const { return context_.options; }
  const SurfaceFunctions& functions() const { return context_.functions; }
  FunctionScratch& scratch() const { return context_.scratch; }

  ModifierId modifiers() const { return modifiers_; }
  // Whether the ray passes because it hit a back face, and these are invisible (-bv-).
  bool passesBack() const { return arrival_.cosine < 0 && !options().backFacesVisible; }

  // Applies the material's own modifiers, whose patterns and textures interaction() then contains. Throws
  // rad::Error if one of them is a material.
  void modify() {
    if (modifiers_ != kNone) applyModifiers();
  }
  // Turns a hit from behind into a hit from the front, also for point() and the tracer.
  void turnRound() {
    if (arrival_.cosine < 0) turnToFront();
  }
  virtual Interaction interaction() const = 0;
  // The factor of the patterns that were applied.
  virtual const Color& pattern() const = 0;
  // The hit with the patterns and textures of a chain of modifiers (kNone: an empty chain) in addition to
  // those that modify() has applied. Does not change the hit itself.
  virtual Interaction interactionAfter(ModifierId modifiers) const = 0;
  virtual FunctionPoint point() const = 0;
  // The medium that the ray travels through.
  virtual const Medium& medium() const = 0;
  // The direction (unit) to the light source whose image the ray is aimed at. REQUIRES Arrival::atImage.
  virtual V3d towardsSource() const = 0;
  // The number of samples for this ray, if a ray of weight 1 takes `wanted` of them.
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
