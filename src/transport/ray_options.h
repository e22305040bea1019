#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "base/radiometry.h"
#include "base/spectral_sampling.h"
#include "shade/scattering.h"
#include "shade/shared_definitions.h"

namespace rsphere {

// The options that steer the path of a ray. They are rtrace's, and rtrace(1) explains them. The defaults here
// are rtrace's too; sphere mode has others (modeDefaults() in cli/option_table.h).
struct RayOptions {
  // -cs, -cw  The division of the spectrum in a spectral run; null: three channels.
  const SpectralSampling* sampling = nullptr;
  WavelengthLimits wavelengths;  // -cw  In three channels too, spectra are 0 beyond these.
  // direct light
  double directThreshold = .03;      // -dt  share of the direct light that may be left untested for shadows
  double directCertainty = .75;      // -dc
  double directJitter = 0;           // -dj  0 to 1
  double sourceSubstructuring = .2;  // -ds  largest size/distance of a part of a source; 0: not divided
  int directRelays = 2;              // -dr
  int chosenSources = 0;             // -Ss  sources tested at a surface, drawn at random; 0: all of them
  int directPretest = 512;           // -dp
  bool sourcesVisible = true;  // -dv  whether a directly seen source shows its radiance instead of black
  // specular reflection
  double specularSampling = 1;     // -ss
  double specularThreshold = .15;  // -st
  // indirect light
  int ambientBounces = 0;         // -ab
  double ambientAccuracy = .1;    // -aa
  int ambientResolution = 256;    // -ar
  int ambientDivisions = 1024;    // -ad
  int ambientSuperSamples = 512;  // -as
  int firstRays = 1;              // -Sh  0: chosen by -ab
  Radiance ambientValue;          // -av
  int ambientWeight = 0;          // -aw
  // The number of rays of patches of the coarse solution is computed as if -ad + -as were at least this, and
  // patches serve the first diffuse surface too (FirstBounce::fromPatches). Not an option: sphere mode sets
  // it, because each of its directions has a small -ad and all share one solution. 0: no minimum, and patches
  // do not serve the first surface.
  int leastForPatches = 0;
  int coarserLinks = 0;     // FieldOptions::coarserLinks. Not an option: pictures set it
  std::string ambientFile;  // -af
  double fieldMemory = 0;   // -Sm  MB; 0: no bound
  std::vector<std::string> ambientExcluded, ambientIncluded;  // -ae -aE, -ai -aI; one or both are empty
  // limits
  int reflectionLimit = -10;  // -lr  limit: absolute value, 0: none; not positive: Russian roulette below -lw
  double weightLimit = 1e-4;  // -lw
  // medium
  Color mediumExtinction{0, 0, 0};  // -me  per unit length
  Color mediumAlbedo{0, 0, 0};      // -ma
  double mediumEccentricity = 0;    // -mg
  double mediumSampling = 0;        // -ms  length (world units) for each sample; 0: one sample a ray
  // others
  std::vector<SharedDefinitions> definitions;  // -e -f, in their order
  bool backFacesVisible = true;                // -bv
  // random numbers
  bool uncorrelated = true;  // -u  changes nothing by itself; see AnswerOptions::numberedRays
  uint64_t rotation = 0;     // -Sr

  // The medium of the space outside of mist and dielectrics (-me -ma -mg).
  Medium medium() const { return {mediumExtinction, mediumAlbedo, mediumEccentricity}; }
  // Whether there is indirect light at all (-ab, -ad).
  bool hasIndirectLight() const { return ambientBounces > 0 && ambientDivisions > 0; }
};

// Whether the answer for a ray is radiance or irradiance, and of which surface.
enum class IrradianceAt : uint8_t {
  none,     // radiance
  surface,  // -i  irradiance of the surface that it hits
  point     // -I  irradiance of a sensor at its origin
};

}  // namespace rsphere
