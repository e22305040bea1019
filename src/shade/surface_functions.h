#pragma once
// What patterns, textures and mixtures compute at a surface point: function files, data, pictures and text.
//
// Nothing is read until a modifier is first asked for; from then on it is compiled, shared by all threads and
// asked without a lock. Threads: any number may ask at once, each with a FunctionScratch of its own.
#include <array>
#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <variant>
#include <vector>

#include "rad_parser/calc_library.h"
#include "rad_parser/calc_scene.h"
#include "rad_parser/data_file.h"
#include "rad_parser/font_file.h"
#include "rad_parser/xform.h"
#include "scene/scene.h"
#include "shade/picture.h"

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
};

// What one thread needs for its evaluations.
struct FunctionScratch {
  rad::calc::State state;
  std::array<double, rad::calc::kInputs> inputs{};
};

class SurfaceFunctions {
 public:
  // Keeps a reference to the scene. warn: gets a line, once for each modifier, where a value can't be
  // computed (division by zero and the like); from any thread, one at a time.
  explicit SurfaceFunctions(const Scene& scene, rad::Warn warn = {});

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

  // A modifier made ready.
  struct Function {
    std::variant<Values, Data, Image, Text> what;
    size_t results = 1;   // 1 or 3
    uint64_t needs = 0;   // inputs, by bits
    bool moved = false;   // whether it has a transform
    Imath::M44d own;      // world to the primitive's own coordinates
    double ownScale = 1;  // of lengths, positive
    Imath::M44d world;    // and back
    double worldScale = 1;
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
  void setInputs(const Function& f, const FunctionPoint& at, FunctionScratch& scratch) const;
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
};

}  // namespace rsphere
