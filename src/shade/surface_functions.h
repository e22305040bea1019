#pragma once
// Evaluates patterns, textures, mixtures and the functions of materials at a surface point: function files,
// data, pictures and text.
//
// A modifier's files are read and compiled at its first evaluation, and shared by all threads without a lock.
// Threads may evaluate at the same time, each with a separate FunctionScratch.
#include <array>
#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "base/colorimetry.h"
#include "rad_parser/calc/library.h"
#include "rad_parser/rayinit/interface.h"
#include "rad_parser/tables/data_file.h"
#include "rad_parser/tables/font_file.h"
#include "rad_parser/transforms/xform.h"
#include "scene/scene.h"
#include "shade/bsdf.h"
#include "shade/function_file.h"
#include "shade/picture.h"

namespace rsphere {

// A hit, as seen by function files, in world coordinates.
struct FunctionPoint {
  V3d direction{0, 0, -1};    // of the ray, unit
  V3d normal{0, 0, 1};        // unperturbed, unit, not turned towards the ray
  double cosine = 1;          // -normal . direction
  V3d point{0, 0, 0};         // of the hit; the ray's origin if the hit is infinitely far
  double distance = 0;        // T: from the hit to the eye, along the ray and its ancestors
  double shadowDistance = 0;  // Ts: along the ray and those ancestors that are shadow rays
  double u = 0, v = 0;        // local coordinates
  PlacementPath path{};       // the placement of the modifiers' coordinates in the world
  // For reflection(), transmission() and distribution():
  V3d perturbedNormal{0, 0, 1};  // unit, on the ray's side
  double perturbedCosine = 1;    // -perturbedNormal . direction
  Color color{1, 1, 1};          // of the material with its pattern; for BRTDfunc, of the pattern
  V3d toTarget{0, 0, 0};         // for redirection(): to the light source at which the ray is aimed (unit),
                                 // or 0
};

// Working memory for evaluations by one thread.
struct FunctionScratch {
  rad::calc::State state;
  std::array<double, rad::calc::kInputs> inputs{};
  Placement placement;
  std::vector<double> spectrum;
};

class SurfaceFunctions {
 public:
  // Keeps a reference to the scene. sampling: the bands of a spectral run. Null in a run of three channels,
  // whose spectra are computed within `limits`. warn: called once for each modifier with a value that cannot
  // be computed (division by zero and the like), from any thread, but never by two at once. definitions:
  // visible to all function files, instead of those of rayinit.cal. Throws rad::Error if a definition is
  // missing or invalid.
  SurfaceFunctions(const Scene& scene, const SpectralSampling* sampling, rad::Warn warn = {},
                   std::span<const SharedDefinitions> definitions = {}, const WavelengthLimits& limits = {});

  // Each of these functions takes a modifier. If a value cannot be computed, the neutral value is returned.
  // They throw rad::Error, with the modifier's place in the scene file, in two cases:
  // - At first use, something is missing or invalid: function files, data, pictures, fonts or texts
  //   (Status::system if the file does not exist), their contents, a transform, or the number of arguments.
  // - An expression uses a name that does not exist.

  // The factor on the color of the modified material. Neutral value: (1, 1, 1). For a spectral pattern
  // (spectrum, specfile, specfunc, specdata, specpict), the color has bands in a spectral run; in a run of
  // three channels it is RADIANCE's conversion of the spectrum to red, green and blue.
  Color pattern(ModifierId modifier, const FunctionPoint& at, FunctionScratch& scratch) const;
  // The product of the patterns of a chain, which contains nothing else.
  Color patterns(ModifierId first, const FunctionPoint& at, FunctionScratch& scratch) const;
  // Whether a pattern is the same for all rays that hit the same place.
  bool dependsOnPlaceAlone(ModifierId pattern) const;
  // Whether a pattern depends on the distance that the rays have travelled.
  bool dependsOnDistance(ModifierId pattern) const;
  // The perturbation that is added to the surface's normal, in the world. Neutral value: (0, 0, 0).
  V3d texture(ModifierId modifier, const FunctionPoint& at, FunctionScratch& scratch) const;
  // The share of the foreground, 0 to 1. Negative if it cannot be computed, which means that the mixture is
  // ignored.
  double mixture(ModifierId modifier, const FunctionPoint& at, FunctionScratch& scratch) const;

  // The functions of materials; the neutral value is 0.

  // plastic2, metal2, trans2, ashik2, WGMDfunc: the direction ux uy uz that orients highlights, in the world,
  // of any length.
  V3d orientation(ModifierId modifier, const FunctionPoint& at, FunctionScratch& scratch) const;
  // BSDF, aBSDF: the up direction in the world, of any length.
  V3d up(ModifierId modifier, const FunctionPoint& at, FunctionScratch& scratch) const;
  // BSDF: the thickness of the hidden geometry, in world units; positive if it lies behind the surface's
  // front.
  double thickness(ModifierId modifier, const FunctionPoint& at, FunctionScratch& scratch) const;
  // BSDF, aBSDF: the file's data.
  const BsdfData& bsdf(ModifierId modifier) const;
  // BRTDfunc: the coefficients of sharp reflection and transmission. WGMDfunc: for the reflected and the
  // transmitted lobe, share, roughness along and roughness across.
  std::array<double, 3> reflection(ModifierId modifier, const FunctionPoint& at,
                                   FunctionScratch& scratch) const;
  std::array<double, 3> transmission(ModifierId modifier, const FunctionPoint& at,
                                     FunctionScratch& scratch) const;
  // plasfunc and the like, BRTDfunc: the scattering function (1/sr) towards the ray's origin, for light from
  // a source that fills solidAngle (sr) in direction toSource (unit, world).
  Color distribution(ModifierId modifier, const FunctionPoint& at, const V3d& toSource, double solidAngle,
                     FunctionScratch& scratch) const;

  // prism1, prism2: for an image (0 or 1), the coefficient of the redirected ray and its direction (world,
  // unit).
  struct Redirection {
    double coefficient = 0;
    V3d direction{0, 0, 0};
  };
  Redirection redirection(ModifierId modifier, int image, const FunctionPoint& at,
                          FunctionScratch& scratch) const;

  // Warns of a problem with a modifier, but only of the first for each modifier.
  void warn(ModifierId modifier, std::string_view problem) const;

 private:
  using ProgramPointer = std::shared_ptr<const rad::calc::Program>;

  // brightfunc, mixfunc: one number; colorfunc, texfunc: three.
  struct Values {
    ProgramPointer program;
  };
  // A named function of one channel's value, or of all three.
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
    // right, down: the basis of the text's plane that is dual to the motion vectors.
    V3d anchor, right, down;
    std::array<double, 3> foreground, background;
  };

  // spectrum, specfile: the same at every hit.
  struct ConstantSpectrum {
    Color color;
  };
  // specfunc: a function of the wavelength. Its mean over each bin is estimated from two wavelengths. As in
  // RADIANCE, the spectrum is spread over the whole range, although the last bin may end earlier, by at most
  // one step.
  struct SpectralFunction {
    ProgramPointer program;
    double longest = 0, shortest = 0;  // nm
    double step = 0;                   // nm, from bin to bin
    size_t bins = 0;                   // 0: outside the wavelengths of the run
  };
  // specdata: a table over coordinates and wavelength. specpict: a picture of spectra. The correction is a
  // function of a value and its wavelength.
  struct SpectralData {
    ProgramPointer coordinates, correction;
    std::shared_ptr<const rad::DataFile> table;      // of specdata
    std::shared_ptr<const SpectralPicture> picture;  // of specpict
    size_t count = 0;                                // number of wavelengths
    double firstWavelength = 0, lastWavelength = 0;  // nm, of the middles of their bins
    std::vector<double> unevenWavelengths;           // nm; empty if they are evenly spaced
  };

  // The functions of a material; null if its type has no such function.
  struct Scatterer {
    ProgramPointer orientation, reflection, transmission;  // of three numbers each
    ProgramPointer thickness;
    std::shared_ptr<const BsdfData> bsdf;
    // One for each channel, or only the first for all channels. The arguments are the table's value, if there
    // is a table, then the direction to a source and its solid angle.
    std::array<ProgramPointer, 3> distribution;
    bool gray = true;
    std::shared_ptr<const rad::DataFile> table;
    std::vector<ProgramPointer> coordinates;  // coordinates in the table, as functions of the same four
                                              // arguments
  };

  // A coefficient and a direction for each image.
  struct Redirector {
    std::array<ProgramPointer, 2> programs;
  };

  // A modifier, compiled.
  struct Function {
    std::variant<Values, Data, Image, Text, Scatterer, Redirector, ConstantSpectrum, SpectralFunction,
                 SpectralData>
        what;
    size_t results = 1;   // 1, 3, or 0 for a spectrum
    uint64_t needs = 0;   // one bit for each input that it reads
    bool moved = false;   // whether it has a transform
    Placement placement;  // placement by its transform
    mutable std::atomic<bool> warned = false;
  };

  // Objects by name. Each is created at first use.
  template <class T>
  using Cache = std::map<std::string, std::shared_ptr<const T>, std::less<>>;

  const Function& ready(ModifierId modifier) const {
    const Function* f = ready_[modifier.index()].load(std::memory_order_acquire);
    return f ? *f : prepare(modifier);
  }
  const Function& prepare(ModifierId modifier) const;
  std::span<const double> realsOf(ModifierId modifier) const;
  // The placement of the function's coordinates in the world; null if these are world coordinates. scratch:
  // stores the result if placements must be composed.
  const Placement* placementOf(const Function& f, const FunctionPoint& at, FunctionScratch& scratch) const;
  // Prepares an evaluation: sets inputs, and forgets earlier faults.
  void setInputs(const Function& f, const FunctionPoint& at, FunctionScratch& scratch) const;
  // Whether all values are finite and no fault was recorded since setInputs(); otherwise warns.
  bool computed(ModifierId modifier, const FunctionScratch& scratch, std::span<const double> values) const;
  std::array<double, 3> three(ModifierId modifier, ProgramPointer Scatterer::*program,
                              const FunctionPoint& at, FunctionScratch& scratch) const;
  // Computes the function's numbers. If that fails, warns and returns false.
  bool evaluate(ModifierId modifier, const Function& f, const FunctionPoint& at, FunctionScratch& scratch,
                std::array<double, 3>& out) const;

  Color spectralPattern(ModifierId modifier, const Function& f, const FunctionPoint& at,
                        FunctionScratch& scratch) const;
  // Both set scratch.spectrum, unless a fault occurs.
  void evaluateSpectrum(const SpectralFunction& f, rad::calc::Point& point, FunctionScratch& scratch) const;
  void evaluateSpectrum(const SpectralData& data, rad::calc::Point& point, FunctionScratch& scratch) const;
  Color colorOf(const Spectrum& spectrum) const;
  Color colorOf(const SpectralCurve& curve) const;

  class Maker;

  const Scene& scene_;
  const SpectralSampling* sampling_;  // of the bands, or null
  WavelengthLimits limits_;
  rad::Warn warn_;
  mutable std::vector<std::atomic<const Function*>> ready_;  // by modifier
  mutable std::mutex mutex_;                                 // guards all members that follow
  mutable std::vector<std::unique_ptr<Function>> functions_;
  mutable rad::calc::Library library_;
  mutable Cache<rad::DataFile> data_;
  mutable Cache<Picture> pictures_;
  mutable Cache<SpectralPicture> spectralPictures_;
  mutable Cache<rad::FontFile> fonts_;
  mutable Cache<BsdfData> bsdfs_;
};

}  // namespace rsphere
