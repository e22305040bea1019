#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "base/radiometry.h"
#include "base/spectral_sampling.h"
#include "shade/function_file.h"
#include "shade/scattering.h"

namespace rsphere {

// The options of rtrace that control paths; rtrace(1) explains them. The defaults are rtrace's; sphere mode
// has others (modeDefaults() in cli/option_table.h).
struct RayOptions {
  // -cs, -cw  The bands of a spectral run; null: three channels.
  const SpectralSampling* sampling = nullptr;
  WavelengthLimits wavelengths;  // -cw  Also with three channels, spectra are 0 outside these limits.
  // direct light
  double directThreshold = .03;      // -dt  fraction of the direct light that may remain untested for shadows
  double directCertainty = .75;      // -dc
  double directJitter = 0;           // -dj  0 to 1
  double sourceSubstructuring = .2;  // -ds  largest size of a source's part per distance; 0: not divided
  int directRelays = 2;              // -dr  kAllBounces: as many as it takes
  int chosenSources = 0;             // -Ss  number of random sources sampled at a surface; 0: all
  int directPretest = 512;           // -dp
  bool sourcesVisible = true;  // -dv  whether sources show their radiance to primary rays, instead of black
  // -Sgc  Whether a lamp at the ray's origin also lights by caustics: by light that a polished surface
  // reflects first. The shadow rays of the places that it lights would not find it, except by a flat mirror.
  bool caustics = true;
  // specular reflection
  double specularSampling = 1;     // -ss
  double specularThreshold = .15;  // -st
  // indirect light
  int ambientBounces = 0;         // -ab
  double ambientAccuracy = .1;    // -aa
  int ambientResolution = 256;    // -ar
  int ambientDivisions = 1024;    // -ad
  int ambientSuperSamples = 512;  // -as
  int firstRays = 1;              // -Sh  0: depends on -ab
  Radiance ambientValue;          // -av
  int ambientWeight = 0;          // -aw
  // The number of rays of a patch of the coarse solution is computed as if -ad + -as were at least this. If
  // it is not 0, patches are also used at the first diffuse surface (FirstBounce::fromPatches). Not an
  // option: sphere mode sets it, because each of its directions has a small -ad, and all share one coarse
  // solution.
  int leastForPatches = 0;
  // If it is not 0, used instead of -ad + -as for the number of rays of a patch. Not an option: set for -Sa.
  double raysForPatches = 0;
  // Whether patches need no more rays than the records of the irradiance cache, which alone look them up
  // (caches.cpp). Not an option: set where light is interpolated at the first surface, as in pictures.
  bool patchesForRecords = false;
  int solutions = 1;        // FieldOptions::solutions. Not an option: more than one where errors are stated
  int coarserLinks = 0;     // FieldOptions::coarserLinks. Not an option: set for pictures
  std::string ambientFile;  // -af
  double fieldMemory = 0;   // -Sm  MB; 0: no limit
  std::vector<std::string> ambientExcluded, ambientIncluded;  // -ae -aE, -ai -aI; at least one is empty
  // The number of diffuse bounces, or of reflections, after which no light is left: even of .99 reflected,
  // 4e-5 remains.
  static constexpr int kAllBounces = 1000;
  // limits
  int reflectionLimit = -10;  // -lr  absolute value: limit, 0: none; not above 0: Russian roulette below -lw
  double weightLimit = 1e-4;  // -lw
  // medium
  Color mediumExtinction{0, 0, 0};  // -me  per unit length
  Color mediumAlbedo{0, 0, 0};      // -ma
  double mediumEccentricity = 0;    // -mg
  double mediumSampling = 0;        // -ms  length (world units) for each sample; 0: one sample per ray
  // others
  std::vector<SharedDefinitions> definitions;  // -e -f, in their order
  bool backFacesVisible = true;                // -bv
  // random numbers
  bool uncorrelated = true;  // -u  has no effect here; see AnswerOptions::numberedRays
  uint64_t rotation = 0;     // -Sr

  // The medium outside of mist and dielectrics (-me -ma -mg).
  Medium medium() const { return {mediumExtinction, mediumAlbedo, mediumEccentricity}; }
  // Whether there is any indirect light (-ab, -ad).
  bool hasIndirectLight() const { return ambientBounces > 0 && ambientDivisions > 0; }
};

// Whether the result for a ray is radiance or irradiance, and where.
enum class IrradianceAt : uint8_t {
  none,     // radiance along the ray
  surface,  // -i  irradiance on the surface that the ray hits
  point     // -I  irradiance on a sensor at the ray's origin
};

}  // namespace rsphere
