#pragma once
// What patterns, textures, mixtures and the functions of materials compute at a surface point: function
// files, data, pictures and text.
//
// Nothing is read until a modifier is first asked for; from then on it is compiled, shared by all threads and
// asked without a lock. Threads: any number may ask at once, each with a FunctionScratch of its own.
#include <array>
#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "rad_parser/calc/library.h"
#include "rad_parser/data_file.h"
#include "rad_parser/font_file.h"
#include "rad_parser/rayinit/interface.h"
#include "rad_parser/xform.h"
#include "scene/scene.h"
#include "shade/bsdf.h"
#include "shade/picture.h"
#include "shade/shared_definitions.h"

namespace rsphere {

// A hit as function files see it, in the world.
struct FunctionPoint {
  V3d direction{0, 0, -1};    // of the ray, unit
  V3d normal{0, 0, 1};        // the surface's own, unit, not turned to the ray
  double cosine = 1;          // -normal . direction
  V3d point{0, 0, 0};         // of the hit; the ray's origin where it is infinitely far
  double distance = 0;        // T: from there to the eye, along the ray and its ancestors
  double shadowDistance = 0;  // Ts: along the ray, and those of its ancestors that are shadow rays
  double u = 0, v = 0;        // local coordinates
  PlacementPath path{};       // what places the modifiers' coordinates in the world
  // For scattering(), light() and distribution():
  V3d perturbedNormal{0, 0, 1};  // unit, on the ray's side
  double perturbedCosine = 1;    // -perturbedNormal . direction
  Rgb color{1, 1, 1};            // of the material with its pattern; of BRTDfunc, the pattern's
  V3d toTarget{0, 0, 0};         // for redirection(): to the light source that the ray is for (unit), or 0
};

// What one thread needs for its evaluations.
struct FunctionScratch {
  rad::calc::State state;
  std::array<double, rad::calc::kInputs> inputs{};
  Placement placement;
};

class SurfaceFunctions {
 public:
  // Keeps a reference to the scene. warn: gets a line, once for each modifier, where a value can't be
  // computed (division by zero and the like); from any thread, one at a time. definitions: shared by all
  // function files, instead of those of rayinit.cal; throws rad::Error where they are missing or wrong.
  explicit SurfaceFunctions(const Scene& scene, rad::Warn warn = {},
                            std::span<const SharedDefinitions> definitions = {});

  // Each takes the index in Scene::modifiers of what it is named after, and answers what leaves things as
  // they are where a value can't be computed. Each throws rad::Error with its place when it is first asked
  // for something that is missing or wrong: function files, data, pictures, fonts, texts (Status::system
  // where there is no such file), their contents, a transform, a number of arguments; and whenever an
  // expression asks for something that does not exist.

  // What the colour of what is behind it is multiplied by: (1, 1, 1).
  Rgb pattern(int32_t modifier, const FunctionPoint& at, FunctionScratch& scratch) const;
  // What is added to the surface's own normal, in the world: (0, 0, 0).
  V3d texture(int32_t modifier, const FunctionPoint& at, FunctionScratch& scratch) const;
  // The foreground's share, 0 to 1; negative where it can't be computed: the mixture is then passed over.
  double mixture(int32_t modifier, const FunctionPoint& at, FunctionScratch& scratch) const;

  // The same for materials, 0 where a value can't be computed.

  // The direction in the world that highlights are oriented by (ux uy uz), of any length: plastic2, metal2,
  // trans2, ashik2, WGMDfunc.
  V3d orientation(int32_t modifier, const FunctionPoint& at, FunctionScratch& scratch) const;
  // BSDF, aBSDF: the direction in the world that is up, of any length.
  V3d up(int32_t modifier, const FunctionPoint& at, FunctionScratch& scratch) const;
  // BSDF: the thickness of what it hides, in the world, positive behind its front.
  double thickness(int32_t modifier, const FunctionPoint& at, FunctionScratch& scratch) const;
  // BSDF, aBSDF: the file's data.
  const BsdfData& bsdf(int32_t modifier) const;
  // BRTDfunc: the coefficients of what is sharply reflected and transmitted. WGMDfunc: share, roughness along
  // and across of the reflected and the transmitted lobe.
  std::array<double, 3> reflection(int32_t modifier, const FunctionPoint& at, FunctionScratch& scratch) const;
  std::array<double, 3> transmission(int32_t modifier, const FunctionPoint& at,
                                     FunctionScratch& scratch) const;
  // plasfunc and its kin, BRTDfunc: per steradian, the share of the light of a source that fills solidAngle
  // (sr) in direction toSource (unit, world) that is scattered towards the ray.
  Rgb distribution(int32_t modifier, const FunctionPoint& at, const V3d& toSource, double solidAngle,
                   FunctionScratch& scratch) const;

  // prism1, prism2: the share of what is seen by way of an image (0 or 1), and the direction (world, unit)
  // that the ray goes on in.
  struct Redirection {
    double coefficient = 0;
    V3d direction{0, 0, 0};
  };
  Redirection redirection(int32_t modifier, int image, const FunctionPoint& at,
                          FunctionScratch& scratch) const;

  // Warns of something wrong with a modifier, of the first such thing only.
  void warn(int32_t modifier, std::string_view problem) const;

 private:
  using ProgramPointer = std::shared_ptr<const rad::calc::Program>;

  // One or three numbers, by type.
  struct Values {
    ProgramPointer program;
  };
  // A named function of one value, or of all three.
  struct Correction {
    ProgramPointer program;
    bool ofAll = false;
  };
  struct Data {
    ProgramPointer coordinates;
    std::vector<std::shared_ptr<const rad::DataFile>> tables;
    std::vector<Correction> corrections;
  };
  struct Image {
    ProgramPointer coordinates;
    std::shared_ptr<const Picture> picture;
    std::vector<Correction> corrections;
  };
  struct Text {
    std::shared_ptr<const rad::FontFile> font;
    rad::TextLayout layout;
    V3d anchor, right, down;  // right and down: of the plane, their product with a motion vector is 1 or 0
    std::array<double, 3> foreground, background;
  };

  // Of a material; null for what its type does not have.
  struct Scatterer {
    ProgramPointer orientation, reflection, transmission;  // of three numbers each
    ProgramPointer thickness;
    std::shared_ptr<const BsdfData> bsdf;
    // One for each channel, or the first for all: of the direction to a source and its solid angle, with a
    // table's value before these where there is one.
    std::array<ProgramPointer, 3> distribution;
    bool gray = true;
    std::shared_ptr<const rad::DataFile> table;
    std::vector<ProgramPointer> coordinates;  // of the same four arguments
  };

  // A coefficient and a direction for each image.
  struct Redirector {
    std::array<ProgramPointer, 2> programs;
  };

  // A modifier made ready.
  struct Function {
    std::variant<Values, Data, Image, Text, Scatterer, Redirector> what;
    size_t results = 1;   // 1 or 3
    uint64_t needs = 0;   // inputs, by bits
    bool moved = false;   // whether it has a transform
    Placement placement;  // by that
    mutable std::atomic<bool> warned = false;
  };

  // A thing of each name, made when it is first asked for.
  template <class T>
  using Cache = std::map<std::string, std::shared_ptr<const T>, std::less<>>;

  const Function& ready(int32_t modifier) const {
    const Function* f = ready_[static_cast<size_t>(modifier)].load(std::memory_order_acquire);
    return f ? *f : prepare(modifier);
  }
  const Function& prepare(int32_t modifier) const;
  std::span<const double> realsOf(int32_t modifier) const;
  // What places the function's own coordinates in the world, kept in scratch where it is made for this; null
  // where they are the world's.
  const Placement* placementOf(const Function& f, const FunctionPoint& at, FunctionScratch& scratch) const;
  void setInputs(const Function& f, const FunctionPoint& at, FunctionScratch& scratch) const;
  // Whether nothing went wrong since the faults were cleared; warns where it did.
  bool computed(int32_t modifier, const FunctionScratch& scratch) const;
  std::array<double, 3> three(int32_t modifier, ProgramPointer Scatterer::*program, const FunctionPoint& at,
                              FunctionScratch& scratch) const;
  // The function's numbers; false where they can't be computed, which is warned of.
  bool evaluate(int32_t modifier, const Function& f, const FunctionPoint& at, FunctionScratch& scratch,
                std::array<double, 3>& out) const;

  class Maker;

  const Scene& scene_;
  rad::Warn warn_;
  mutable std::vector<std::atomic<const Function*>> ready_;  // by modifier
  mutable std::mutex mutex_;                                 // of all that follows
  mutable std::vector<std::unique_ptr<Function>> functions_;
  mutable rad::calc::Library library_;
  mutable Cache<rad::DataFile> data_;
  mutable Cache<Picture> pictures_;
  mutable Cache<rad::FontFile> fonts_;
  mutable Cache<BsdfData> bsdfs_;
};

}  // namespace rsphere
